#include "fdd/examination/coil_examination.h"

#include <algorithm>
#include <cmath>

#include "fdd/examination/fault_hypotheses.h"
#include "fdd/measurement/motion_uncertainty.h"

namespace ambrig {

namespace {

constexpr double kCertainLead = 12;    // certain: e^-6 against the next hypothesis
constexpr double kLeastOffset = 0.09;  // [A]

/// True when the current went to zero at the bridge's pace, not at once.
bool Decayed(const DetectorSettings& s, const std::vector<const KeptPeriod*>& periods,
             std::size_t onset, int j) {
  std::vector<double> i;
  for (std::size_t n = onset > 0 ? onset - 1 : 0; n < periods.size(); ++n)
    for (int k = 0; k < s.sampling.samples; ++k)
      i.push_back(periods[n]->adc[static_cast<std::size_t>(k)][j]);
  std::size_t zero = i.size();
  while (zero > 0 && i[zero - 1] < kZeroCurrent) --zero;  // first sample of the last run of zeros
  if (zero < 7 || zero == i.size()) return false;
  const double last = i[zero - 1], before = i[zero - 7];
  return last < 0.25 && before > last + 0.08;
}

/// Largest step of the suspect's reading that its circuit cannot explain [A], periods around the
/// onset.
double UnexplainedStep(const LinkageModel& m, const DetectorSettings& s,
                       const std::vector<const KeptPeriod*>& periods, std::size_t onset, int j) {
  double most = 0, last_lambda = 0, last_reading = 0;
  bool known = false;
  for (std::size_t n = onset > 1 ? onset - 2 : 0; n <= onset + 1 && n < periods.size(); ++n) {
    PeriodSlopes now;
    const KeptPeriod& p = *periods[n];
    if (!p.in.comparable) {
      known = false;
      continue;
    }
    ComputePeriodSlopes(m, s.sampling, p.in, &now);
    const bool radial = m.coupling == Coupling::kFloatingRotor;
    const double own = m.SelfInductance(j, now.permeance.middle, radial ? now.permeance.total : 1);
    const double moved = LinkageUncertainty(m, now, 1)[j];
    for (int k = 0; k < s.sampling.samples; ++k) {
      const Lane& i = p.adc[static_cast<std::size_t>(k)];
      const double at = static_cast<double>(k) / s.sampling.samples;
      const auto permeance = [&](int q) {
        return now.permeance.start[q] + at * now.permeance.change[q];
      };
      double top = 0, total = 0;
      for (int q = 0; q < m.coils; ++q) {
        top += permeance(q) * m.n[q] * i[q];
        total += permeance(q);
      }
      const double partner = m.coupling == Coupling::kSides ? m.n[j ^ 1] * i[j ^ 1] : 0;
      const double lambda =
          m.n[j] * permeance(j) * (m.n[j] * i[j] + partner - (radial ? top / total : 0)) +
          m.leakage[j] * i[j];
      if (k > 0 || known) {
        const double t = (k - 1) * s.sampling.step;
        const double on = k == 0 ? 0 : std::clamp(now.edge[j] - t, 0.0, s.sampling.step);
        const double driven =
            on * now.phase[0].voltage[j] + (s.sampling.step - on) * now.phase[1].voltage[j];
        const double uncertainty = moved * (k == 0 ? p.in.uncertainty.position
                                                   : p.in.uncertainty.velocity * s.sampling.step);
        double step = (std::abs(lambda - last_lambda - driven) - uncertainty) / own;
        // A step of the other reading on the same core looks the same, but for this reading.
        if (m.coupling == Coupling::kSides) step = std::min(step, std::abs(i[j] - last_reading));
        if (i[j] > kZeroCurrent) most = std::max(most, step);
      }
      last_lambda = lambda;
      last_reading = i[j];
      known = true;
    }
  }
  return most;
}

std::size_t FindOnset(const LinkageModel& m, const DetectorSettings& s,
                      const std::vector<const KeptPeriod*>& periods, std::size_t calm, int j) {
  PhaseWindows w;
  // What was calm stays out: before an earlier fault was accepted, the model of now does not hold.
  for (std::size_t n = calm; n < periods.size(); ++n) {
    w.clear();
    AddWindows(m, s, *periods[n], j, &w);
    // one onset for both
    if (m.coupling == Coupling::kSides) AddWindows(m, s, *periods[n], j ^ 1, &w);
    for (const PhaseWindow& one : w)
      if (one.Applies() && !(one.mean < 2 * kZeroCurrent && one.e > 0) &&
          std::abs(one.e) > 5 * one.sd_e)
        return n;
  }
  // many small residuals, no gross one
  return std::max(calm, periods.size() > 8 ? periods.size() - 8 : 0);
}

/// Two windings on one core: the other one is healthy, so its equation must hold when the suspect's
/// ampere-turns are `factor` times what its reading and its nominal turns say. `most`: what a
/// window may cost, where shorted turns may carry a current of their own.
double PartnerCost(const LinkageModel& m, const DetectorSettings& s,
                   const std::vector<const KeptPeriod*>& periods, std::size_t first, int j,
                   double factor, double most) {
  if (m.coupling != Coupling::kSides) return 0;
  const int k = j ^ 1;
  double cost = 0, i[64];
  PhaseWindows windows;
  for (std::size_t n = first; n < periods.size(); ++n) {
    const KeptPeriod& p = *periods[n];
    windows.clear();
    AddWindows(m, s, p, k, &windows);
    PeriodSlopes now;
    ComputePeriodSlopes(m, s.sampling, p.in, &now);
    for (int q = 0; q < s.sampling.samples; ++q) i[q] = p.adc[static_cast<std::size_t>(q)][j];
    for (const PhaseWindow& w : windows) {
      if (!w.Applies()) continue;
      const int on = static_cast<int>(now.phase[0].samples[k]),
                count = static_cast<int>(now.phase[w.phase].samples[k]);
      const double slope = SlopeOf(i, w.phase == 0 ? 0 : on, count, s.sampling.step);
      cost += std::min(
          Cost((w.e + (factor - 1) * m.n[k] * now.permeance.middle[k] * m.n[j] * slope) / w.sd_e),
          most);
    }
  }
  return cost;
}

}  // namespace

Examination ExamineCoil(const LinkageModel& model, const DetectorSettings& settings,
                        const std::vector<const KeptPeriod*>& periods, std::size_t calm, int coil,
                        bool last) {
  Examination out;
  const std::size_t onset = FindOnset(model, settings, periods, calm, coil);
  PhaseWindows all;
  const std::size_t first = std::max(onset + 1, periods.size() > 6 ? periods.size() - 6 : 0);
  for (std::size_t n = first; n < periods.size(); ++n)
    AddWindows(model, settings, *periods[n], coil, &all);
  if (periods.size() < first + 2 || all.size() < 2) return out;

  double turns_left = 1, sensed = 1;
  const auto partner = [&](double factor, double most = kClip) {
    return PartnerCost(model, settings, periods, first, coil, factor, most);
  };
  const double as_read = partner(1), shorted = BestShort(all, &turns_left);
  const double gain = model.coupling != Coupling::kNone ? SensorCost(all, &sensed) : 1e30;
  struct Entry {
    FaultClass cls;
    double cost;
  };
  std::vector<Entry> entries = {
      {FaultClass::kNone, HealthyCost(all) + as_read},
      {FaultClass::kOpen, OpenCost(all) + 1 + as_read},
      {FaultClass::kAmplifierOff, WrongVoltageCost(all, 0) + 2 + as_read},
      {FaultClass::kSwitchStuckOn, WrongVoltageCost(all, 1) + 2 + as_read},
      {FaultClass::kPartialShort, shorted + partner(turns_left, kFreeVoltage)},
      {FaultClass::kCurrentSensor, std::min(FrozenCost(all), gain + partner(sensed))},
  };
  std::stable_sort(entries.begin(), entries.end(),
                   [](const Entry& a, const Entry& b) { return a.cost < b.cost; });
  const auto vanished = [](FaultClass c) {
    return c == FaultClass::kOpen || c == FaultClass::kAmplifierOff;
  };
  std::size_t second = 1;
  if (vanished(entries[0].cls) && vanished(entries[1].cls)) second = 2;
  FaultClass best = entries[0].cls;
  const double lead = entries[second].cost - entries[0].cost;
  out.cost = entries[0].cost;
  if (vanished(best) && second == 2)
    best =
        Decayed(settings, periods, onset, coil) || entries[1].cost - entries[0].cost > kCertainLead
            ? (entries[1].cost - entries[0].cost > kCertainLead ? best : FaultClass::kAmplifierOff)
            : FaultClass::kOpen;
  if (best == FaultClass::kNone) {
    if (UnexplainedStep(model, settings, periods, onset, coil) < kLeastOffset) return out;
    best = FaultClass::kCurrentSensor;  // right before and after, but another offset
  }
  const bool offset = best == FaultClass::kCurrentSensor && entries[0].cls == FaultClass::kNone;
  out.decided = lead > kCertainLead || last || (offset && periods.size() >= first + 3);
  out.diagnosis.coil = coil;
  out.diagnosis.cls = best;
  out.diagnosis.onset = periods[onset]->in.t;
  out.diagnosis.confidence = 1 / (1 + std::exp(-0.5 * lead));
  if (best == FaultClass::kPartialShort) {
    out.diagnosis.fraction = 1 - turns_left;
    out.closed_loop = LoopCarriesCurrent(all, turns_left);
  }
  return out;
}

}  // namespace ambrig
