#pragma once
/// Where a rig is linearised: levitated at rest, every sensor reads zero, the coils carry what
/// holds the weight. What turns with the shaft is no part of it; speed enters the derivatives only.
/// Source: docs/theory/base_model.md sections 3 and 4.
#include <memory>
#include <string>
#include <vector>

#include "analysis/linear_bearing.h"
#include "simulation/sampled/sampled_data_loop.h"

namespace ambrig {

/// One coil at the operating point.
struct CoilPoint {
  double current = 0;     // set-point [A]
  double duty = 0;        // that holds it [-]
  bool commanded = true;  // false: its set-point is at a limit and does not follow the force
};

struct OperatingPoint {
  std::unique_ptr<SampledDataLoop> sampled;  // plant, maps, amplifiers as a run would start
  MotionState motion;
  std::vector<double> force;                  // per axis [N]
  std::vector<std::vector<CoilPoint>> coils;  // per bearing
  std::vector<LinearBearing> bearings;
  std::vector<std::string> notes;  // what of this rig the linear model leaves out, one line each

  const RigParameters& rig() const { return sampled->rig; }
  Plant& plant() const { return sampled->plant; }
  std::vector<std::string> Axes() const;
};

OperatingPoint FindOperatingPoint(const RigParameters& rig);

}  // namespace ambrig
