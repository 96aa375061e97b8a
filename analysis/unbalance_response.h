#pragma once
/// Synchronous response of the closed loop, exact at the controller's ticks (the unbalance acts
/// continuously): order 1 over speed, its peaks and their amplification.
///
/// Unbalance of API 617: U = 6350 W/N per plane [g mm, kg, rpm], W the static load of the plane, N
/// the rated speed: `static` in phase at the bearings, `couple` opposed there, `middle` all of it
/// at the centre of mass. Amplification factor AF = N_c/(N_2 - N_1) at 0.707 of the peak. Source:
/// API 617 8th ed.; docs/theory/published_values.md 4.
#include "analysis/closed_loop.h"

namespace ambrig {

struct PlaneUnbalance {
  double z = 0;
  double magnitude = 0;  // [kg m]
  double phase = 0;      // from x at t = 0 [rad]
};

struct UnbalanceCase {
  std::string name;
  std::vector<PlaneUnbalance> planes;
};

/// The three cases at this rated speed [rad/s]; the weight counts at rest, shared by the bearings.
std::vector<UnbalanceCase> StandardUnbalance(const OperatingPoint& point, double rated);

struct ResponsePeak {
  double speed = 0;          // N_c [rad/s]
  double amplitude = 0;      // half the orbit's long axis [m]
  double amplification = 0;  // AF
  bool bound = false;        // a half-power point was not reached: AF is smaller than this
};

/// Maxima of amplitude over rising speed with both neighbours lower, the top refined by a parabola.
std::vector<ResponsePeak> FindPeaks(const std::vector<double>& speed,
                                    const std::vector<double>& amplitude);

/// Amplitude (long half axis of the orbit at the sensors) and phase over speed, per radial bearing.
struct OrderTrack {
  std::string bearing;
  std::vector<double> amplitude, phase;  // [m], of x [rad]
  std::vector<double> force;             // long half axis of the magnets' force [N]
  std::vector<ResponsePeak> peaks;
};

struct UnbalanceSweep {
  UnbalanceCase unbalance;
  std::vector<double> speed;  // [rad/s]
  std::vector<OrderTrack> tracks;
};

/// Outputs of `loop` at its own speed.
Eigen::VectorXcd UnbalanceAt(const OperatingPoint& point, const ClosedLoop& loop,
                             const UnbalanceCase& unbalance);

/// All cases over the same loops (rising speeds).
std::vector<UnbalanceSweep> SweepUnbalance(const OperatingPoint& point,
                                           const std::vector<ClosedLoop>& loops,
                                           const std::vector<UnbalanceCase>& cases);

}  // namespace ambrig
