#include "simulation/commissioning/commission.h"

#include <fmt/format.h>

#include "fdd/commissioned/healthy_bands.h"
#include "fdd/detectors/detection_feed.h"
#include "fdd/learning/commissioning_file.h"
#include "fdd/learning/commissioning_fit.h"
#include "simulation/commissioning/excess_scatter.h"
#include "simulation/commissioning/other_machine.h"
#include "simulation/switching/switching_engine.h"

namespace ambrig {

namespace {

/// Keeps what the controller measures; acts on nothing.
class MeasurementLogger : public Supervisor {
 public:
  explicit MeasurementLogger(const NominalRig& nominal) : feed_(nominal) {
    for (std::size_t k = 0; k < nominal->bearings.size(); ++k)
      logs_.emplace_back(nominal->samples_per_period());
  }
  void AfterPeriod(const PeriodMeasurement& m, const std::vector<BearingControl>& control,
                   SupervisorOutput&) override {
    feed_.Read(m);
    for (std::size_t k = 0; k < logs_.size(); ++k) {
      MeasuredPeriod in = feed_.Period(k, m);
      in.set_point = &control[k].commanded;
      logs_[k].Add(in);
    }
  }
  const CommissioningLog& log(std::size_t bearing) const { return logs_[bearing]; }

 private:
  DetectionFeed feed_;
  std::vector<CommissioningLog> logs_;
};

}  // namespace

CommissioningResult Commission(const RigParameters& rig, const CommissioningOptions& options) {
  const Scenario scenario = CommissioningScenario(rig, options.plan);
  const NominalRig nominal(rig);
  MeasurementLogger logger(nominal);
  EngineOptions engine;
  engine.record = false;
  engine.supervisor = &logger;
  engine.stop = options.stop;
  if (options.progress) engine.progress = [&](double done) { options.progress(0.3 * done); };
  CommissioningResult out;
  out.run = SwitchingEngine(rig, scenario, engine).Run();
  for (const RunEvent& e : out.run.events) {
    if (e.kind != "touchdown") continue;
    // Lost while the loop settled: no signal has moved it yet.
    if (e.t * rig.controller.rate < 1)
      throw InputError(
          fmt::format("{}: the rotor touches before the signals of its commissioning run begin "
                      "({}): its loop does not hold it, allowed: one that ambrig analyze calls "
                      "stable, with force for the weight",
                      rig.file, e.target));
    throw InputError(
        fmt::format("{}: the rotor touches in its commissioning run at t = {:.4f} s "
                    "of {} s ({}), allowed: smaller signals (--circle, --pulse, "
                    "--chirp) or a lower --speed",
                    rig.file, e.t, scenario.duration, e.target));
  }
  out.model.machine = MachineOfFile(rig.file);
  for (std::size_t k = 0; k < rig.bearings.size(); ++k) {
    if (options.stop && options.stop->load()) throw Interrupted();
    const LinkageModel model = LinkageModelOf(nominal->bearings[k]);
    const CoilDetectorSetup setup{model, DetectorSettingsOf(nominal, rig.bearings[k], model)};
    const ExcessSettings settings{setup.settings.current_noise, setup.settings.adc_limit};
    CommissionedBearing found = FitCommissioning(rig.bearings[k].name, model,
                                                 setup.settings.sampling, settings, logger.log(k));
    if (!found.learnt)
      throw InputError(
          fmt::format("{}: amplifier.adc_samples_per_period = {}: hardly a phase of bearing {} has "
                      "the three samples that its slope needs, allowed: more samples (the first "
                      "two of a period and the one after an edge do not count)",
                      rig.file, rig.samples_per_period(), found.name));
    found.learnt_on = ContentHashOf(model, rig.amplifier);
    AddHealthyBands(setup, logger.log(k), &found);
    out.scatter.push_back(ScatterOf(setup, logger.log(k), found));
    out.model.bearings.push_back(std::move(found));
    if (options.progress)
      options.progress(0.3 +
                       0.7 * static_cast<double>(k + 1) / static_cast<double>(rig.bearings.size()));
  }
  return out;
}

}  // namespace ambrig
