#include "design/point.h"

#include <algorithm>
#include <cmath>

#include "analysis/linear/control_plant.h"
#include "core/base/toml_edit.h"
#include "core/record/channels.h"
#include "design/linear_figures.h"
#include "rig/parameters/bearing_kind.h"
#include "rig/rig_file.h"
#include "simulation/sampled/controller_setup.h"

namespace ambrig {

namespace {

/// One line without separators, whatever an error says.
std::string OneLine(std::string text) {
  for (char& ch : text)
    if (ch == '\n' || ch == '\r' || ch == '\t') ch = ' ';
  return text;
}

void Worse(double& worst, double value) {
  if (std::isnan(value)) value = kInfinity;
  worst = std::max(worst, value);
}

std::vector<std::size_t> AllAxes(const RigParameters& rig) {
  std::vector<std::size_t> axes(AxisNames(rig).size());
  for (std::size_t k = 0; k < axes.size(); ++k) axes[k] = k;
  return axes;
}

std::vector<double> SensorNoise(const RigParameters& rig) {
  std::vector<double> noise;
  for (const BearingParameters& b : rig.bearings)
    noise.insert(noise.end(), b.Axes().size(), b.sensor.noise);
  return noise;
}

double RunFigure(const FigureSpec& f, const RigParameters& rig, const RunResult& r) {
  double orbit = 0, used = 0;
  for (const BearingParameters& b : rig.bearings) {
    if (b.kind->axial) continue;
    const auto it = r.metrics.max_orbit.find(b.name);
    const double most = it == r.metrics.max_orbit.end() ? 0 : it->second;
    orbit = std::max(orbit, most);
    if (b.auxiliary) used = std::max(used, most / b.auxiliary->clearance);
  }
  switch (f.info->kind) {
    case FigureKind::kOrbit:
      return orbit;
    case FigureKind::kSettledOrbit:
      return r.metrics.settled_orbit;
    case FigureKind::kPlaneOrbit:
      return std::ranges::max(PlaneDistance(r.record, f.plane));
    case FigureKind::kClearanceUsed:
      return used;
    case FigureKind::kPeakCurrent:
      return r.metrics.peak_current;
    case FigureKind::kCopperLoss:
      return r.metrics.copper_loss;
    case FigureKind::kContact:
      return r.metrics.longest_contact;
    case FigureKind::kTouchdown:
      return r.touchdown ? 1 : 0;
    case FigureKind::kDrop:
      return r.drop ? 1 : 0;
    case FigureKind::kDetectionDelay:
      return r.metrics.detection_delay < 0 ? kInfinity : r.metrics.detection_delay;
    default:
      return 0;
  }
}

void AddLinear(const Study& study, const LinearFigures& f, Evaluation& out) {
  for (std::size_t k = 0; k < study.figures.size(); ++k) {
    const FigureKind kind = study.figures[k].info->kind;
    if (kind == FigureKind::kPeakSensitivity) Worse(out.figures[k], f.peak_sensitivity);
    if (kind == FigureKind::kSettlingTime) Worse(out.figures[k], f.settling_time);
    if (kind == FigureKind::kNoiseForce) Worse(out.figures[k], f.noise_force);
    if (kind == FigureKind::kAmplification) Worse(out.figures[k], f.amplification);
  }
}

/// False when the loop is unstable at some speed: no run is worth its time.
bool EvaluateLinear(const Study& study, const RigParameters& rig,
                    const PositionController& controller, Evaluation& out) {
  double top = 0;
  for (const double speed : study.speeds) top = std::max(top, std::abs(speed));
  for (const double error : study.frequency_errors) {
    RigParameters plant = *TrueRig(rig);
    for (BendingMode& mode : plant.modes) mode.omega *= 1 + error;
    const OperatingPoint point(TrueRig::AsDrawn(NominalRig(plant)), NominalRig(rig));
    for (const double speed : study.speeds) {
      const LinearFigures f = LinearFiguresOf(
          MakeControlPlant(point, AllAxes(rig), speed, CurrentModel::kCoils),
          controller.Linear(speed), SensorNoise(rig), speed, ControlledAxes(rig), top);
      if (!f.stable()) {
        out.note = "unstable at " + NumberText(speed) + " rad/s";
        if (error != 0)
          out.note += " with bending frequencies off by " + NumberText(100 * error) + " %";
        return false;
      }
      AddLinear(study, f, out);
    }
  }
  return true;
}

void EvaluateRuns(const Study& study, const RigParameters& rig, const std::atomic<bool>* stop,
                  Evaluation& out) {
  for (std::size_t s = 0; s < study.scenarios.size(); ++s) {
    bool wanted = false, record = false;
    for (const FigureSpec& f : study.figures) {
      if (!f.info->of_scenario || f.scenario != s) continue;
      wanted = true;
      record = record || f.info->kind == FigureKind::kPlaneOrbit;
    }
    if (!wanted) continue;
    SimulateOptions options;
    options.fidelity = study.fidelity;
    options.record = record;
    options.stop = stop;
    const RunResult r = Simulate(
        rig, ReadScenarioText(study.scenarios[s].text, study.scenarios[s].file, rig), options);
    for (std::size_t k = 0; k < study.figures.size(); ++k) {
      const FigureSpec& f = study.figures[k];
      if (f.info->of_scenario && f.scenario == s) Worse(out.figures[k], RunFigure(f, rig, r));
    }
  }
}

}  // namespace

std::string RigTextOfPoint(const DesignCandidate& c, const std::vector<double>& values) {
  Require(values.size() == c.variables.size(), "a value per variable");
  std::vector<TomlEdit> edits;
  for (std::size_t k = 0; k < values.size(); ++k)
    for (const std::string& path : c.variables[k].paths) edits.push_back({path, values[k]});
  return WithAbsoluteFiles(EditedToml(c.rig_text, c.rig_file, edits), c.rig_file);
}

RigParameters RigOfPoint(const DesignCandidate& c, const std::vector<double>& values) {
  return ReadRigText(RigTextOfPoint(c, values), c.rig_file);
}

RigParameters Drawn(RigParameters rig, const std::vector<double>& draw) {
  std::size_t k = 0;
  for (Tolerance& t : rig.tolerances) {
    if (!(t.sd > 0) || draw.empty()) continue;
    const double* value = ParameterAt(rig, t.path);
    double lo = 0, hi = 0;
    std::string unit;
    const bool ranged = ParameterRange(rig, t.path, &lo, &hi, &unit);
    const double z = draw[k++];
    if (!value) continue;
    const double drawn = (std::isnan(t.true_value) ? *value : t.true_value) + t.sd * z;
    t.true_value = ranged ? std::clamp(drawn, lo, hi) : drawn;
  }
  return rig;
}

Evaluation Evaluate(const Study& study, std::size_t candidate, const std::vector<double>& values,
                    const std::atomic<bool>* stop) {
  Evaluation out;
  out.figures.assign(study.figures.size(), 0.0);
  try {
    const RigParameters nominal = RigOfPoint(study.candidates[candidate], values);
    const auto controller = MakeController(NominalRig(nominal), nominal.controller);
    for (const std::vector<double>& draw : study.draws) {
      const RigParameters rig = Drawn(nominal, draw);
      if (!EvaluateLinear(study, rig, *controller, out)) {
        std::fill(out.figures.begin(), out.figures.end(), kInfinity);
        return out;
      }
      EvaluateRuns(study, rig, stop, out);
    }
  } catch (const Interrupted&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;  // of the machine, not of the point
  } catch (const std::exception& e) {
    out.note = OneLine(e.what());
    std::fill(out.figures.begin(), out.figures.end(), kInfinity);
  }
  return out;
}

std::vector<double> PlaneDistance(const Record& record, const std::string& plane) {
  const Channel *x = Find(record, {ChannelKind::kTruePosition, plane, 0}),
                *y = Find(record, {ChannelKind::kTruePosition, plane, 1});
  Require(x && y && !x->samples.empty(), "a plane that is recorded");
  std::vector<double> out;
  for (std::size_t k = 0; k < x->samples.size(); ++k)
    out.push_back(std::hypot(x->samples[k] - x->samples[0], y->samples[k] - y->samples[0]));
  return out;
}

bool MeetsLimits(const Study& study, const std::vector<double>& figures) {
  for (std::size_t k = 0; k < figures.size(); ++k)
    if (!std::isfinite(figures[k]) ||
        (study.figures[k].at_most && figures[k] > *study.figures[k].at_most))
      return false;
  return true;
}

}  // namespace ambrig
