#include "design/responses.h"

#include <algorithm>
#include <cmath>

#include "analysis/linear/control_plant.h"
#include "core/record/channels.h"
#include "design/linear_figures.h"
#include "design/pareto.h"
#include "design/point.h"
#include "rig/parameters/bearing_kind.h"
#include "simulation/sampled/controller_setup.h"

namespace ambrig {

namespace {

constexpr double kStepLength = 0.03;  // [s]
constexpr int kCurvePoints = 300;
constexpr double kLowestGrid = 1, kHighestGrid = 2000;  // [Hz]

ScenarioTrace TraceOf(const Study& study, std::size_t scenario, const RigParameters& rig,
                      RunResult result) {
  ScenarioTrace trace;
  for (std::size_t k = 0; k < result.record.rows(); ++k) trace.t.push_back(result.record.TimeAt(k));
  trace.orbit.assign(trace.t.size(), 0.0);
  for (const BearingParameters& b : rig.bearings) {
    if (b.kind->axial) continue;
    const Channel *x = Find(result.record, {ChannelKind::kReading, b.name, 0}),
                  *y = Find(result.record, {ChannelKind::kReading, b.name, 1});
    for (std::size_t k = 0; x && k < trace.orbit.size(); ++k)
      trace.orbit[k] = std::max(trace.orbit[k], std::hypot(x->samples[k], y ? y->samples[k] : 0.0));
  }
  for (const FigureSpec& f : study.figures)
    if (f.info->kind == FigureKind::kPlaneOrbit && f.scenario == scenario)
      trace.planes.emplace_back(f.plane, PlaneDistance(result.record, f.plane));
  trace.result = std::move(result);
  return trace;
}

}  // namespace

PointResponses ResponsesOf(const Study& study, const StudyResult& result, std::size_t point,
                           const std::atomic<bool>* stop) {
  const StudyPoint& p = result.points[point];
  const RigParameters rig = RigOfPoint(study.candidates[p.candidate], p.values);
  PointResponses out;
  out.point = point;
  std::vector<std::size_t> axes(AxisNames(rig).size());
  for (std::size_t k = 0; k < axes.size(); ++k) axes[k] = k;
  const double speed = study.speeds.front();
  const OperatingPoint at_rest = FindOperatingPoint(rig);
  const SampledPlant plant = MakeControlPlant(at_rest, axes, speed, CurrentModel::kCoils);
  const auto controller = MakeController(NominalRig(rig), rig.controller);
  const StateSpace K = controller->Linear(speed);
  const auto samples = static_cast<std::size_t>(kStepLength / plant.Ts);
  const Eigen::MatrixXd step = LoadStep(plant, K, 0, samples);
  for (std::size_t k = 0; k < samples; ++k) {
    out.step_t.push_back(static_cast<double>(k) * plant.Ts);
    out.step.push_back(step(0, static_cast<Eigen::Index>(k)));
  }
  for (int k = 0; k < kCurvePoints; ++k)
    out.hertz.push_back(kLowestGrid *
                        std::pow(std::min(kHighestGrid, 0.49 / plant.Ts) / kLowestGrid,
                                 static_cast<double>(k) / (kCurvePoints - 1)));
  out.sensitivity.assign(out.hertz.size(), 0.0);
  for (const double Omega : study.speeds) {
    const SampledPlant at = MakeControlPlant(at_rest, axes, Omega, CurrentModel::kCoils);
    const StateSpace loop = controller->Linear(Omega);
    for (const std::size_t axis : ControlledAxes(rig)) {
      const auto curve = SensitivityCurve(at, loop, axis, out.hertz);
      for (std::size_t k = 0; k < curve.size(); ++k)
        out.sensitivity[k] = std::max(out.sensitivity[k], curve[k]);
    }
  }
  for (std::size_t s = 0; s < study.scenarios.size(); ++s) {
    SimulateOptions options;
    options.fidelity = study.fidelity;
    options.stop = stop;
    const StudyScenario& given = study.scenarios[s];
    out.scenarios.push_back(TraceOf(
        study, s, rig, Simulate(rig, ReadScenarioText(given.text, given.file, rig), options)));
  }
  return out;
}

std::size_t RepresentativeOf(const Study& study, const StudyResult& result, std::size_t candidate) {
  std::vector<std::vector<double>> objectives;
  std::vector<std::size_t> front, feasible, finite;
  for (std::size_t k = 0; k < result.points.size(); ++k) {
    const StudyPoint& p = result.points[k];
    objectives.emplace_back();
    for (const std::size_t j : study.Objectives()) objectives.back().push_back(p.result.figures[j]);
    if (p.candidate != candidate) continue;
    if (p.front) front.push_back(k);
    if (p.feasible) feasible.push_back(k);
    finite.push_back(k);
  }
  return front.empty() && feasible.empty()
             ? finite.front()
             : Compromise(objectives, front.empty() ? feasible : front, result.scales);
}

}  // namespace ambrig
