#pragma once
/// Generalised bias-current linearisation of any stator after coil failures: W with
/// i = c0 b + W_v v such that F = k c0 v at the centre, lost rows zero.
///
/// The force is a quadratic form of the currents and a 1 for the magnets, u = (i, 1):
///
///   F_a = u'M_a u,   M_a = phi' diag(d_a/(2 mu0 A)) phi          phi: poles x (coils + 1)
///
/// so that with u_b = (b, 1/c0), u_w = (w, 0) and Q_a = M_a/(k/2) the equations are those of
/// force_forms.h, whatever poles and magnets there are:
///
///   u_b'Q u_b = 0,  u_w'Q u_w = 0 (three pairs),  u_b'Q_a u_w,c = 1 where c is along a, else 0
///
/// Twelve of them with two axes, three with one. They are solved by Levenberg and
/// Marquardt from many deterministic starts, with the amplifiers' range as one-sided residuals, for
/// the widest disc |v| <= rho c0; of the solutions at a share of that disc the one of least bias
/// and stiffness counts. Where the amplifiers' range leaves no such disc, the currents are
/// linearised about those that carry the load: u_b'Q_a u_b = 2 load_a/(k c0²), the gain the same,
/// the disc about the command of the load. Source: docs/theory/stators.md.
#include <Eigen/Dense>
#include <memory>

#include "actuators/magnetics/pole_network.h"
#include "faulttolerance/redistribution/distribution_solver.h"

namespace ambrig {

struct StatorProblem {
  std::shared_ptr<const PoleNetwork> network;
  int axes = 2;
  Eigen::MatrixXd healthy;     // W of the healthy stator, coils x 3
  Eigen::VectorXd turns_left;  // of each coil: 1 healthy, 0 lost
  double k = 0, c0 = 0;        // [N/A²], [A]
  double i_max = 0;            // [A]
  bool unipolar = true;
  Eigen::Vector2d load = Eigen::Vector2d::Zero();  // about which it is linearised [N]
};

struct StatorDistribution {
  SolvabilityClass cls = SolvabilityClass::kNone;
  Eigen::MatrixXd W;    // coils x 3, rows [b, wx, wy]; zero where there is none
  double residual = 0;  // largest equation error over k/2
  double rho = 0;       // currents within range on |v - v_load| <= rho c0
  Eigen::Matrix2d stiffness = Eigen::Matrix2d::Zero();  // dF/dr of the currents at the load [N/m]
  Eigen::Vector2d load = Eigen::Vector2d::Zero();       // about which it is linearised [N]
};

/// Exact, else linearised about the load, else about no force, else none. The load of the
/// answer says which.
StatorDistribution SolveStator(const StatorProblem& problem);

/// All figures of a given W, about the command of the problem's load.
StatorDistribution DescribeStator(const StatorProblem& problem, SolvabilityClass cls,
                                  const Eigen::MatrixXd& W);

/// Whether the equations can be met with currents of any sign and size up to 50 times
/// the healthy ones.
SolvabilityClass ClassifyStator(const StatorProblem& problem);

}  // namespace ambrig
