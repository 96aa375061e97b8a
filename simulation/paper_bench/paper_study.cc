#include "simulation/paper_bench/paper_study.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numeric>

#include "core/base/errors.h"
#include "rig/rig_file.h"
#include "simulation/simulate.h"

namespace ambrig {

namespace {

constexpr double kPaperCurrent = 0.5;  // i0 of its Eq. 9 [A]

double MeanOf(const std::vector<double>& v) {
  return std::accumulate(v.begin(), v.end(), 0.0) / static_cast<double>(v.size());
}

PaperRun ReadPaperRun(const std::string& folder, const char* name) {
  PaperRun run;
  const std::string file = (std::filesystem::path(folder) / name).string();
  if (!std::filesystem::is_regular_file(file))
    throw InputError(
        fmt::format("{}: no such file, allowed: a folder such as examples/paper with "
                    "step_2mH.toml, step_1mH.toml, healthy.toml, open.toml, short.toml",
                    file));
  run.rig = ReadRig(RigOfScenario(file));
  run.scenario = ReadScenario(file, run.rig);
  SingleCoil(run.rig);  // refused before the work
  return run;
}

class PaperWork {
 public:
  PaperWork(const PaperStudyOptions& options, int parts) : options_(options), parts_(parts) {}

  void Simulate(PaperRun& run) {
    Scenario scenario = run.scenario;
    Record(run, scenario);
    run.look = RunPaperDetector(run.rig, run.result.record, kPaperCycle, kPaperMargin);
    if (!scenario.faults.empty() && run.look.flagged > scenario.faults[0].time) {
      FaultSpec off = scenario.faults[0];
      off.kind = "amplifier-off";
      off.time = run.look.flagged;
      off.parameters.clear();
      scenario.faults.push_back(off);
      Record(run, scenario);
    }
    Done();
  }
  DiagnosisDelays Delays(const PaperRun& run) {
    const auto d = DelaysOverCycle(run.rig, run.scenario, kPaperCycle, kPaperMargin);
    Done();
    return d;
  }

 private:
  void Record(PaperRun& run, const Scenario& scenario) const {
    SimulateOptions simulate;
    simulate.stop = options_.stop;
    run.result = ambrig::Simulate(run.rig, scenario, simulate);
    run.slopes = SlopesOf(run.rig, run.result.record, kPaperMargin);
  }
  void Done() {
    if (options_.stop && *options_.stop) throw Interrupted();
    if (options_.progress) options_.progress(static_cast<double>(++done_) / parts_);
  }
  const PaperStudyOptions& options_;
  int parts_, done_ = 0;
};

/// The coil of the paper at rest: a stiff bus, no noise, no pulses, codes that round nothing.
PaperRun IdealCoil(const PaperRun& healthy) {
  PaperRun run = healthy;
  run.rig.effects.clear();
  run.rig.amplifier.adc_bits = 24;
  run.scenario.noise = false;
  std::erase_if(run.scenario.excitations, [](const Excitation& e) { return e.kind != "step"; });
  run.scenario.duration = 0.01;
  return run;
}

SlopeErrors ErrorsOf(const PaperRun& ideal, PaperWork& work) {
  const double k = MeanOf(ideal.slopes.increasing);
  const auto change = [&](double bus, double shift) {
    PaperRun run = ideal;
    run.rig.amplifier.bus_voltage += bus;
    run.scenario.clamp[run.rig.bearings[0].name] = {shift, 0};
    work.Simulate(run);
    return std::abs(MeanOf(run.slopes.increasing) - k);
  };
  SlopeErrors out;
  const OpposedStatorParameters& coil = ideal.rig.bearings[0].opposed;
  const double L = SingleCoil(ideal.rig).inductance;
  // L g = const. of Eq. 21, g the gap and what g_c adds to it.
  out.shift = (coil.gap + coil.gap_constant) * (1 - L / (L + kPaperInductanceChange));
  out.analogue = change(0.02, 0);
  out.bus = change(1, 0);
  out.gap = std::max(change(0, out.shift), change(0, -out.shift));
  return out;
}

ConverterRow RowOf(const PaperStudy& study, int bits, PaperWork& work) {
  ConverterRow row;
  row.bits = bits;
  PaperRun healthy = study.healthy, open = study.open, shorted = study.shorted;
  for (PaperRun* run : {&healthy, &open, &shorted}) run->rig.amplifier.adc_bits = bits;
  work.Simulate(healthy);
  const SlopeConverter converter = ConverterOf(healthy.rig);
  row.step = converter.Slope(0, 1);
  const std::vector<double>& k = healthy.slopes.increasing;
  const double mean = MeanOf(k);
  row.periods = k.size();
  for (std::size_t n = 0; n < k.size(); ++n) {
    row.rms += (k[n] - mean) * (k[n] - mean) / static_cast<double>(k.size());
    const SlopeRange range{healthy.slopes.low[n], healthy.slopes.high[n]};
    row.largest = std::max(row.largest, std::abs(k[n] - (range.low + range.high) / 2));
    row.outside += range.Contains(k[n]) ? 0 : 1;
  }
  row.rms = std::sqrt(row.rms);
  row.open = work.Delays(open);
  row.shorted = work.Delays(shorted);
  return row;
}

}  // namespace

PaperStudy RunPaperStudy(const std::string& folder, const PaperStudyOptions& options) {
  PaperStudy study;
  study.steps = {ReadPaperRun(folder, "step_2mH.toml"), ReadPaperRun(folder, "step_1mH.toml")};
  study.healthy = ReadPaperRun(folder, "healthy.toml");
  study.open = ReadPaperRun(folder, "open.toml");
  study.shorted = ReadPaperRun(folder, "short.toml");
  PaperWork work(options, 10 + 3 * static_cast<int>(options.bits.size()) + 2);
  for (PaperRun* run :
       {&study.steps[0], &study.steps[1], &study.healthy, &study.open, &study.shorted})
    work.Simulate(*run);
  study.open.delays = work.Delays(study.open);
  study.shorted.delays = work.Delays(study.shorted);

  study.theory = IncreasingRange(SingleCoil(study.healthy.rig), kPaperCurrent);
  PaperRun ideal = IdealCoil(study.healthy);
  work.Simulate(ideal);
  const int half = ideal.rig.samples_per_period() / 2;
  study.simulated = EndsOfOnPhase(ideal.rig, ideal.result.record, half);
  study.i0 = MeanOf(ideal.slopes.i0);
  study.errors = ErrorsOf(ideal, work);
  const std::vector<double>& k = study.healthy.slopes.increasing;
  const auto [low, high] = std::minmax_element(k.begin(), k.end());
  study.half_spread = (*high - *low) / 2;
  for (const double bus : study.healthy.result.record.Find("bus")->samples)
    study.bus_peak =
        std::max(study.bus_peak, std::abs(bus - study.healthy.rig.amplifier.bus_voltage));
  for (const int bits : options.bits) study.converters.push_back(RowOf(study, bits, work));
  return study;
}

}  // namespace ambrig
