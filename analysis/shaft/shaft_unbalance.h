#pragma once
/// Response of a shaft on its supports to an unbalance, over the speed:
///   (K - Omega² M + i Omega (D + Omega G)) q = Omega² U e^{i phase} (1, -i) at its plane,
/// the supports as they are at each speed; where and how much is free. Grades of ISO 21940-11: G is
/// the product of the permissible eccentricity and the service speed, so U = m G / Omega for the
/// whole rotor.
#include <complex>

#include "analysis/shaft/static_deflection.h"
#include "analysis/unbalance_response.h"

namespace ambrig {

/// A plane of the shaft or a housing, where motion is read.
struct ShaftProbe {
  std::string name;
  double z = 0;         // on the shaft [m]
  std::string housing;  // instead
};

struct ProbeOrbit {
  ShaftProbe probe;
  std::vector<std::complex<double>> x, y;  // x(t) = Re(x e^{i Omega t}) [m]
  std::vector<ResponsePeak> peaks;         // of the orbit's long half axis
};

struct SupportForce {
  std::string support;
  std::vector<std::complex<double>> x, y;  // on what it carries [N]
};

struct ShaftSweep {
  UnbalanceCase unbalance;
  std::vector<double> speed;  // [rad/s]
  std::vector<ProbeOrbit> probes;
  std::vector<SupportForce> forces;
};

/// The sides of an ellipse x = Re(X e^{it}), y = Re(Y e^{it}), and the angle of its long axis from
/// x.
double NodalAngle(std::complex<double> x, std::complex<double> y);

/// Displacement (x, y) of a probe over the dofs of Assemble; its transpose takes forces in.
Eigen::MatrixXd ProbeRows(const BeamRotor& beam, const ShaftProbe& probe);

/// Peaks of the orbits' long half axes over what was swept [rad/s].
void FindOrbitPeaks(const std::vector<double>& at, std::vector<ProbeOrbit>& probes);

std::vector<ShaftSweep> SweepShaft(const BeamRotor& beam, const std::vector<UnbalanceCase>& cases,
                                   const std::vector<ShaftProbe>& probes,
                                   const std::vector<double>& speeds);

/// A grade of ISO 21940-11 [m/s] at a service speed [rad/s], shared by the planes that carry the
/// shaft as they share its weight: `static` in phase, `couple` opposed from plane to plane.
std::vector<UnbalanceCase> GradeUnbalance(const BeamRotor& beam, const StaticDeflection& weight,
                                          double grade, double speed);

/// API 617: 6350 W/N g mm at each plane that carries W kg, N in rpm: `static`, `couple`, and
/// `middle`, all of it at the centre of mass.
std::vector<UnbalanceCase> ApiUnbalance(const BeamRotor& beam, const StaticDeflection& weight,
                                        double speed);

}  // namespace ambrig
