#include "simulation/continuous/averaged_engine.h"

#include <algorithm>
#include <cmath>

#include "simulation/continuous/continuous_run.h"

namespace ambrig {

namespace {

ContinuousRig::Drive MeanDrive(const CoilVoltage& v, double bus, double T) {
  const double length[3] = {v.t1, v.t2 - v.t1, T - v.t2};
  ContinuousRig::Drive out{.released = v.released};
  for (int q = 0; q < 3; ++q) {
    out.volts += length[q] / T * (v.gain[q] * bus + v.drop[q]);
    out.driven = out.driven || (length[q] > 0 && v.gain[q] > 0);
  }
  return out;
}

class AveragedRun : public ContinuousRun {
 public:
  AveragedRun(const RigParameters& rig, const Scenario& scenario, const AveragedOptions& options)
      : ContinuousRun(rig, scenario, options), mean_(rig_.bearings.size()) {
    Require(!options.sampled.supervisor, "no detector: averaged currents have no ripple");
    const double rate =
        options.sampled.record_rate > 0 ? options.sampled.record_rate : scenario.record_rate;
    if (rate * rig_.T > 1 + 1e-9)
      throw InputError(
          "a record_rate above the switching frequency needs --fidelity switching or reference");
    if (scenario.start == StartState::kLevitated) {
      const Equilibrium e = rig_.StartInEquilibrium();
      if (!e.usable())
        result_.notes.push_back("no unique equilibrium (" + e.message +
                                "): started from the centre");
    }
    for (SampledBearing& b : rig_.bearings) {
      b.measurement.noisy = false;
      b.measurement.samples = 1;
    }
    Settle();
  }

 private:
  void SetVoltages(double) override {
    for (const SampledBearing& b : rig_.bearings)
      for (int j = 0; j < rig_.control[b.index].coils; ++j)
        plant_->SetVoltage(b.index, j,
                           MeanDrive(voltage_[b.index][static_cast<std::size_t>(j)],
                                     rig_.plant.bus.voltage, rig_.T));
  }

  double Measure(long long n) override {
    double peak = 0;
    for (SampledBearing& b : rig_.bearings) {
      for (int j = 0; j < rig_.control[b.index].coils; ++j) {
        mean_[b.index][j] = plant_->MeanCurrent(b.index, j, rig_.T);
        peak = std::max(peak, std::abs(mean_[b.index][j]));
      }
      rig_.Measure(n, b, &mean_[b.index]);
    }
    return peak;
  }

  std::vector<Lane> mean_;
};

}  // namespace

AveragedOptions DefaultAveragedOptions() {
  AveragedOptions o;
  o.integrator.tolerance = 1e-7;
  o.integrator.order = 4;
  o.integrator.steps_a_period = 1000;
  return o;
}

RunResult RunAveraged(const RigParameters& rig, const Scenario& scenario,
                      const AveragedOptions& options) {
  return AveragedRun(rig, scenario, options).Run();
}

}  // namespace ambrig
