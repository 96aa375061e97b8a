#pragma once
/// Force of a heteropolar bearing with eight poles as quadratic forms of its coil currents, rotor
/// centred, ideal iron, all gaps meeting at the rotor (docs/theory/stator.md).
///
///   m_j = tau_j s_j i_j                 magnetomotive force of coil j over N; tau_j: its turns [-]
///   B_j = m_j - mean(m)                 flux density of pole j in units of mu0 N / g0
///   F   = (mu0 N^2 A / 2 g0^2) sum_j B_j^2 (cos gamma_j, sin gamma_j)
///
/// With i = c0 b + W_v v, W = [b wx wy], and k = 4 mu0 N^2 A / g0^2 the force is F = k c0 v exactly
/// if these 12 equations hold (Qx = forms.Q[0], Qy = forms.Q[1], scaled so that 1 is
/// the entry k/2):
///
///   b'Q b = 0,   w'Q w = 0 (three pairs),   for Q = Qx and Q = Qy
///   b'Qx wx = 1,  b'Qy wx = 0,  b'Qx wy = 0,  b'Qy wy = 1
///
/// Negative stiffness at v = 0, symmetric and never negative:
///
///   dF/dx = (k c0^2 / g0) [b'Rxx b, b'Rxy b; b'Rxy b, b'Ryy b]
///
/// The healthy W row [1, cos gamma, sin gamma] has the identity.
/// Leakage adds to the inductance, not to the forms.
#include <Eigen/Dense>
#include <array>

#include "actuators/magnetics/radial_stator.h"

namespace ambrig {

using CoilForm = Eigen::Matrix<double, 8, 8>;
using DistributionMatrix = Eigen::Matrix<double, 8, 3>;  // rows [b, wx, wy], without unit

/// The bearing whose currents are to be distributed, and what its amplifiers can give.
struct RedistributionProblem {
  CoilVector angle = CoilVector::Zero();  // gamma_j [rad]
  CoilVector sign = CoilVector::Ones();   // winding sense, +1 or -1
  CoilVector turns_left =
      CoilVector::Ones();        // 1 healthy, 0 failed, 1 - s with the fraction s shorted
  double turns = 50;             // N, per healthy coil
  double pole_area = 2.0372e-4;  // A [m2]
  double gap = 4e-4;             // g0 [m]
  double c0 = 2;                 // bias current of the healthy bearing [A]
  double i_max = 6;              // [A]
  int quadrants = 2;             // 2: currents never negative; 4: any sign
};

/// Geometry and winding of a healthy bearing, for amplifiers as the defaults say.
RedistributionProblem RedistributionProblemOf(const RadialStatorParameters& stator);

/// k = 4 mu0 N^2 A / g0^2 [N/A2].
double ForceFactor(const RedistributionProblem& problem);

struct ForceForms {
  std::array<CoilForm, 2> Q;  // x, y
  std::array<CoilForm, 3> R;  // xx, xy, yy
  CoilForm flux;              // B = flux * i
};
ForceForms MakeForceForms(const RedistributionProblem& problem);

/// Errors of the 12 equations over k/2: bb, bx, by (x and y force each), then xx, xy, yy.
Eigen::Vector<double, 12> EquationErrors(const ForceForms& forms, const DistributionMatrix& W);

/// [1, cos gamma, sin gamma].
DistributionMatrix HealthyDistribution(const RedistributionProblem& problem);

/// dF/dx at the centre with the bias currents alone [N/m].
Eigen::Matrix2d NegativeStiffness(const RedistributionProblem& problem, const ForceForms& forms,
                                  const DistributionMatrix& W);
double LargestEigenvalue(const Eigen::Matrix2d& symmetric);

/// Largest rho for which the currents stay within the amplifiers' range on all |v| <= rho c0;
/// 0 when not even the bias alone does.
double WorkingDisc(const RedistributionProblem& problem, const DistributionMatrix& W);
/// The same with the sign alone: b_j >= rho |w_j|; infinite for four quadrants.
double UnipolarDisc(const RedistributionProblem& problem, const DistributionMatrix& W);

/// Load capacity in all directions over the healthy bearing's, bias best scaled (b -> a b, w ->
/// w/a): max over t of 4 t / max_j(|b_j| + t |w_j|)^2, with t |w_j| <= b_j when quadrants = 2.
double CurrentCapacity(const RedistributionProblem& problem, const DistributionMatrix& W);
/// The same for the pole fluxes, limit per pole, signs free.
double FluxCapacity(const ForceForms& forms, const DistributionMatrix& W);

}  // namespace ambrig
