#include "simulation/paper_bench/slope_bench.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/errors.h"
#include "rig/parameters/bearing_kind.h"
#include "simulation/simulate.h"

namespace ambrig {

namespace {

const OpposedStatorParameters& OneCoil(const RigParameters& rig) {
  if (rig.bearings.size() != 1 || !rig.bearings[0].kind->alone || rig.bearings[0].coils() != 1)
    throw InputError(fmt::format(
        "{}: the bearings, allowed: one of kind = \"opposed\" with coils = 1", rig.file));
  return rig.bearings[0].opposed;
}

const std::vector<double>& EverySample(const RigParameters& rig, const Record& record) {
  const double wanted = rig.amplifier.switching_frequency * rig.samples_per_period();
  const Channel* c = record.Find(CoilCurrent(rig));
  if (!c || std::abs(record.rate - wanted) > 1e-6 * wanted)
    throw InputError(fmt::format("{}: record_rate = {} Hz, allowed: {} Hz, every sample", rig.file,
                                 record.rate, wanted));
  return c->samples;
}

}  // namespace

SlopeConverter ConverterOf(const RigParameters& rig) {
  SlopeConverter c;
  c.reference = 2 * rig.amplifier.adc_range;
  c.bits = static_cast<int>(rig.amplifier.adc_bits);
  c.period = 1 / (rig.amplifier.switching_frequency * rig.samples_per_period());
  return c;
}

SlopeCircuit SingleCoil(const RigParameters& rig) {
  const OpposedStatorParameters& coil = OneCoil(rig);
  const AmplifierParameters& a = rig.amplifier;
  SlopeCircuit c{
      a.bus_voltage, a.switch_drop, a.diode_drop, 0, coil.resistance, 1 / a.switching_frequency};
  c.inductance = coil.inductance_far + coil.inductance_near / (1 + coil.gap / coil.gap_constant);
  return c;
}

std::string CoilCurrent(const RigParameters& rig) {
  OneCoil(rig);
  return rig.bearings[0].name + ".i1";
}

SlopeSeries SlopesOf(const RigParameters& rig, const Record& record, double margin) {
  const std::vector<double>& i = EverySample(rig, record);
  const SlopeConverter converter = ConverterOf(rig);
  const SlopeCircuit circuit = SingleCoil(rig);
  const auto n = static_cast<std::size_t>(rig.samples_per_period());
  SlopeSeries out;
  std::vector<long> codes(n);
  for (std::size_t from = 0; from + n <= i.size(); from += n) {
    for (std::size_t k = 0; k < n; ++k) codes[k] = converter.Code(i[from + k]);
    const MeanSlopes k = MeanSlopesOf(converter, codes);
    const SlopeRange range = IncreasingRange(circuit, i[from], margin);
    out.t.push_back(record.TimeAt(from));
    out.i0.push_back(i[from]);
    out.increasing.push_back(k.increasing);
    out.decreasing.push_back(k.decreasing);
    out.low.push_back(range.low);
    out.high.push_back(range.high);
  }
  return out;
}

SlopeRange EndsOfOnPhase(const RigParameters& rig, const Record& record, int on) {
  const std::vector<double>& i = EverySample(rig, record);
  const auto n = static_cast<std::size_t>(rig.samples_per_period()),
             last = static_cast<std::size_t>(on);
  Require(on >= 2 && last < n, "an on-phase within the period");
  SlopeRange ends;
  double periods = 0;
  for (std::size_t from = 0; from + n <= i.size(); from += n, ++periods) {
    ends.high += (i[from + 1] - i[from]) * record.rate;
    ends.low += (i[from + last] - i[from + last - 1]) * record.rate;
  }
  return {ends.low / periods, ends.high / periods};
}

DetectorLooks RunPaperDetector(const RigParameters& rig, const Record& record, double cycle,
                               double margin) {
  const std::vector<double>& i = EverySample(rig, record);
  SlopeDetectorSettings s;
  s.converter = ConverterOf(rig);
  s.circuit = SingleCoil(rig);
  s.samples_per_period = rig.samples_per_period();
  s.margin = margin;
  s.cycle = cycle;
  SlopeDetector detector(s);
  const auto n = static_cast<std::size_t>(s.samples_per_period);
  for (std::size_t k = 0; k < i.size(); ++k)
    if (detector.Sample(s.converter.Code(i[k]), i[k - k % n]))
      return {record.TimeAt(k + 1), detector.fault_class()};
  return {};
}

DiagnosisDelays DelaysOverCycle(const RigParameters& rig, const Scenario& scenario, double cycle,
                                double margin) {
  if (scenario.faults.size() != 1)
    throw InputError(
        fmt::format("{}: {} faults, allowed: one", scenario.file, scenario.faults.size()));
  const double T = 1 / rig.amplifier.switching_frequency, first = scenario.faults[0].time;
  DiagnosisDelays out;
  for (int k = 0; k < std::lround(cycle / T); ++k) {
    Scenario s = scenario;
    s.fault_tolerant = false;  // the detector reads the record, nobody acts
    s.faults[0].time = first + k * T;
    s.duration = first + 3 * cycle;
    const RunResult run = Simulate(rig, s, {});
    const DetectorLooks look = RunPaperDetector(rig, run.record, cycle, margin);
    ++out.runs;
    if (look.flagged < 0) continue;
    const double delay = look.flagged - s.faults[0].time;
    if (delay <= 0) {
      ++out.too_early;
      continue;
    }
    out.least = out.found == 0 ? delay : std::min(out.least, delay);
    out.most = std::max(out.most, delay);
    out.mean += delay;
    ++out.found;
    out.named += ToText(look.cls) == s.faults[0].kind ? 1 : 0;
  }
  if (out.found > 0) out.mean /= out.found;
  return out;
}

}  // namespace ambrig
