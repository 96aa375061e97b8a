#include "fdd/coil_examination.h"

#include <algorithm>
#include <cmath>

#include "fdd/motion_doubt.h"

namespace ambrig {

namespace {

constexpr double kClip = 64;           // a window's largest cost: 8 sigma
constexpr double kMargin = 12;         // certain: e^-6 against the next hypothesis
constexpr double kFreeVoltage = 8;     // 2 ln(60 V / 1 V): a flux that the hypothesis leaves open
constexpr double kLeastOffset = 0.09;  // [A]
constexpr double kParameter = 4;       // per fitted quantity

/// One phase of the suspect in one period.
struct Window {
  int phase = 0;
  double v = 0, v_other = 0;  // of this phase and of the other one [V]
  double e = 0, F = 0;        // nominal residual, flux slope told by the other coils [V]
  double x_l = 0, x_r = 0;    // L_l di/dt, R i [V]
  double own = 0;             // L_jj di/dt [V]
  double mean = 0, least = 0; // current [A]
  double sd_e = 0, sd_f = 0, noise_l = 0, noise_own = 0;  // [V]
  double Rest() const { return e + v - own; }  // what the neighbours, motion and R i take [V]
};

double Cost(double z) { return std::min(z * z, kClip); }

/// N phi_j at every sample from the other coils' equations. [Wb]
void FluxFromOthers(const LinkageModel& m, const DetectorSettings& s, const KeptPeriod& p, const PeriodSlopes& now,
                    int j, double* flux) {
  const int count = s.sampling.samples;
  const double h = s.sampling.step;
  std::array<bool, kLanes> conducts{};
  Lane phi0, charge;
  double top = 0, total = 0;
  for (int k = 0; k < m.coils; ++k) {
    double least = 1e30;
    for (int q = 0; q < count; ++q) least = std::min(least, p.adc[static_cast<std::size_t>(q)][k]);
    conducts[static_cast<std::size_t>(k)] = k != j && least > kZeroCurrent && now.largest[k] < s.adc_limit;
    top += now.permeance.middle[k] * m.n[k] * p.adc[0][k];
    total += now.permeance.middle[k];
  }
  const bool radial = m.coupling == Coupling::kFloatingRotor;
  for (int k = 0; k < m.coils; ++k) {
    const double partner = m.coupling == Coupling::kSides ? m.n[k ^ 1] * p.adc[0][k ^ 1] : 0;
    phi0[k] = now.permeance.middle[k] * (m.n[k] * p.adc[0][k] + partner - (radial ? top / total : 0));
  }
  for (int q = 0; q < count; ++q) {
    const Lane& i = p.adc[static_cast<std::size_t>(q)];
    const double t = q * h;
    Lane phi;
    double U = 0, known = 0, sum = 0;
    for (int k = 0; k < m.coils; ++k) {
      if (q > 0) charge[k] += 0.5 * h * (i[k] + p.adc[static_cast<std::size_t>(q - 1)][k]);
      if (!conducts[static_cast<std::size_t>(k)]) continue;
      const double driven =
          now.phase[0].voltage[k] * std::min(t, now.edge[k]) + now.phase[1].voltage[k] * std::max(t - now.edge[k], 0.0);
      phi[k] = phi0[k] + (driven - m.resistance[k] * charge[k] - m.leakage[k] * (i[k] - p.adc[0][k])) / m.n[k];
      U += m.n[k] * i[k] - phi[k] / now.permeance.middle[k];
      known += 1;
      sum += phi[k];
    }
    if (m.coupling == Coupling::kNone || (m.coupling == Coupling::kSides && !conducts[static_cast<std::size_t>(j ^ 1)])) {
      const double partner = m.coupling == Coupling::kSides ? m.n[j ^ 1] * i[j ^ 1] : 0;
      flux[q] = m.n[j] * now.permeance.middle[j] * (m.n[j] * i[j] + partner);
    } else if (m.coupling == Coupling::kSides) {
      flux[q] = m.n[j] * phi[j ^ 1];
    } else {
      if (known > 0) U /= known;
      for (int k = 0; k < m.coils; ++k)
        if (k != j && !conducts[static_cast<std::size_t>(k)]) sum += now.permeance.middle[k] * (m.n[k] * i[k] - U);
      flux[q] = -m.n[j] * sum;
    }
  }
}

double SlopeOf(const double* y, int from, int count, double step) {
  double top = 0, bottom = 0;
  const double middle = 0.5 * (count - 1);
  for (int k = 0; k < count; ++k) {
    top += (k - middle) * y[from + k];
    bottom += (k - middle) * (k - middle);
  }
  return top / (bottom * step);
}

/// Windows of one period that may be used; appended.
void AddWindows(const LinkageModel& m, const DetectorSettings& s, const KeptPeriod& p, int j,
                std::vector<Window>* out) {
  if (!p.in.comparable) return;
  PeriodSlopes now;
  ComputePeriodSlopes(m, s.sampling, p.in, &now);
  Lane doubt[2];
  if (p.in.doubt.any()) ResidualDoubt(m, now, p.in.doubt, doubt);
  double flux[64];
  FluxFromOthers(m, s, p, now, j, flux);
  const bool radial = m.coupling == Coupling::kFloatingRotor;
  const double own = m.SelfInductance(j, now.permeance.middle, radial ? now.permeance.total : 1);
  for (int q = 0; q < 2; ++q) {
    const PhaseSlopes& a = now.phase[q];
    const int count = static_cast<int>(a.samples[j]), from = q == 0 ? 0 : static_cast<int>(now.phase[0].samples[j]);
    if (count < 4 || now.largest[j] >= s.adc_limit) continue;
    Window w;
    w.phase = q;
    w.v = a.voltage[j];
    w.v_other = now.phase[1 - q].voltage[j];
    w.e = a.residual[j];
    w.F = SlopeOf(flux, from, count, s.sampling.step);
    w.x_l = m.leakage[j] * a.current[j];
    w.x_r = m.resistance[j] * a.mean[j];
    w.own = own * a.current[j];
    w.mean = a.mean[j];
    w.least = a.least[j];
    const double per_amp = std::sqrt(SlopeVariance(count, s.sampling.step)) * s.current_noise;  // [A/s]
    const double shared = a.linkage[j] - w.x_l;
    const double leak = s.leakage_sd * a.current[j];
    w.noise_l = per_amp * m.leakage[j];
    w.noise_own = per_amp * own;
    w.sd_e = std::sqrt(std::pow(own * per_amp, 2) + std::pow(s.gap_sd * shared, 2) + leak * leak +
                       s.voltage_sd * s.voltage_sd + doubt[q][j] * doubt[q][j]);
    w.sd_f = std::sqrt((m.coils - 1) * w.noise_l * w.noise_l + std::pow(0.01 * w.F, 2) +
                       s.leakage_sd * s.leakage_sd * 4e8 + s.voltage_sd * s.voltage_sd);
    out->push_back(w);
  }
}

/// Off phases that reach zero current obey no equation.
bool Applies(const Window& w) { return w.phase == 0 || w.least > kZeroCurrent; }

double HealthyCost(const std::vector<Window>& all) {
  double cost = 0;
  for (const Window& w : all)
    if (Applies(w) && !(w.mean < 2 * kZeroCurrent && w.e > 0)) cost += Cost(w.e / w.sd_e);
  return cost;
}

double OpenCost(const std::vector<Window>& all) {
  double cost = 0;
  for (const Window& w : all) cost += Cost(w.mean / 0.015) + (w.phase == 0 ? kFreeVoltage : 0);
  return cost;
}

/// The bridge gives the wrong voltage in one phase; `phase`: which one.
double WrongVoltageCost(const std::vector<Window>& all, int phase) {
  double cost = 0;
  for (const Window& w : all) {
    if (phase == 0 && w.least < kZeroCurrent) {
      if (w.mean < 2 * kZeroCurrent) cost += Cost(w.mean / 0.015) + (w.phase == 0 ? kFreeVoltage : 0);
      continue;
    }
    if (phase == 1 && !Applies(w)) {
      cost += kClip;  // a bridge that always drives leaves no zero current
      continue;
    }
    cost += Cost((w.e + (w.phase == phase ? w.v - w.v_other : 0)) / w.sd_e);
  }
  return cost;
}

/// The flux equation must hold; the suspect's own one too, or its shorted turns carry a current.
double ShortCost(const std::vector<Window>& all, double a) {
  double cost = kParameter;
  for (const Window& w : all) {
    if (!Applies(w)) continue;
    const double sd = std::hypot(a * w.sd_f, a * a * w.noise_l);
    cost += Cost((a * w.F + a * a * w.x_l + a * w.x_r - w.v) / sd);
    cost += std::min(Cost((a * a * w.own + a * w.Rest() - w.v) / w.sd_e), kFreeVoltage);
  }
  return cost;
}

double BestShort(const std::vector<Window>& all, double* turns_left) {
  double best = 1e30;
  const auto scan = [&](double from, double to, double step) {
    for (double a = from; a <= to; a += step) {
      const double cost = ShortCost(all, a);
      if (cost < best) {
        best = cost;
        *turns_left = a;
      }
    }
  };
  scan(0.02, 0.985, 0.005);
  const double at = *turns_left;
  scan(at - 0.005, at + 0.005, 0.0005);
  return best;
}

/// Both equations must hold with the current c i instead of i.
double SensorCost(const std::vector<Window>& all, double* c_found) {
  double top = 0, bottom = 0;
  for (const Window& w : all) {
    if (!Applies(w)) continue;
    const double x = w.own + w.x_r, weight = 1 / (w.sd_e * w.sd_e);
    top += weight * x * (w.v - w.Rest() + w.x_r);
    bottom += weight * x * x;
  }
  const double c = bottom > 0 ? std::clamp(top / bottom, 0.0, 20.0) : 1;
  *c_found = c;
  double cost = kParameter;
  for (const Window& w : all) {
    if (!Applies(w)) continue;
    cost += Cost((c * (w.own + w.x_r) + w.Rest() - w.x_r - w.v) / w.sd_e);
    cost += Cost((w.F + c * (w.x_l + w.x_r) - w.v) / std::hypot(w.sd_f, c * w.noise_l));
  }
  return cost;
}

/// The reading stands still at a current that is not zero, while the bridge drives.
double FrozenCost(const std::vector<Window>& all) {
  double cost = kParameter;
  for (const Window& w : all)
    cost += w.mean < 2 * kZeroCurrent ? kClip : Cost(w.own / (1.2 * w.noise_own)) + kFreeVoltage;
  return cost;
}

/// True when the current went to zero at the bridge's pace, not at once.
bool Decayed(const DetectorSettings& s, const std::vector<const KeptPeriod*>& periods, std::size_t onset, int j) {
  std::vector<double> i;
  for (std::size_t n = onset > 0 ? onset - 1 : 0; n < periods.size(); ++n)
    for (int k = 0; k < s.sampling.samples; ++k) i.push_back(periods[n]->adc[static_cast<std::size_t>(k)][j]);
  std::size_t zero = i.size();
  while (zero > 0 && i[zero - 1] < kZeroCurrent) --zero;  // first sample of the last run of zeros
  if (zero < 7 || zero == i.size()) return false;
  const double last = i[zero - 1], before = i[zero - 7];
  return last < 0.25 && before > last + 0.08;
}

/// Largest step of the suspect's reading that its circuit cannot explain [A], periods around the onset.
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
    const double moved = LinkageDoubt(m, now, 1)[j];
    for (int k = 0; k < s.sampling.samples; ++k) {
      const Lane& i = p.adc[static_cast<std::size_t>(k)];
      const double at = static_cast<double>(k) / s.sampling.samples;
      const auto permeance = [&](int q) { return now.permeance.start[q] + at * now.permeance.change[q]; };
      double top = 0, total = 0;
      for (int q = 0; q < m.coils; ++q) {
        top += permeance(q) * m.n[q] * i[q];
        total += permeance(q);
      }
      const double partner = m.coupling == Coupling::kSides ? m.n[j ^ 1] * i[j ^ 1] : 0;
      const double lambda =
          m.n[j] * permeance(j) * (m.n[j] * i[j] + partner - (radial ? top / total : 0)) + m.leakage[j] * i[j];
      if (k > 0 || known) {
        const double t = (k - 1) * s.sampling.step;
        const double on = k == 0 ? 0 : std::clamp(now.edge[j] - t, 0.0, s.sampling.step);
        const double driven = on * now.phase[0].voltage[j] + (s.sampling.step - on) * now.phase[1].voltage[j];
        const double doubt = moved * (k == 0 ? p.in.doubt.position : p.in.doubt.velocity * s.sampling.step);
        double step = (std::abs(lambda - last_lambda - driven) - doubt) / own;
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

std::size_t FindOnset(const LinkageModel& m, const DetectorSettings& s, const std::vector<const KeptPeriod*>& periods,
                      std::size_t calm, int j) {
  std::vector<Window> w;
  // What was calm stays out: before an earlier fault was accepted, the model of now does not hold.
  for (std::size_t n = calm; n < periods.size(); ++n) {
    w.clear();
    AddWindows(m, s, *periods[n], j, &w);
    if (m.coupling == Coupling::kSides) AddWindows(m, s, *periods[n], j ^ 1, &w);  // one onset for both
    for (const Window& one : w)
      if (Applies(one) && !(one.mean < 2 * kZeroCurrent && one.e > 0) && std::abs(one.e) > 5 * one.sd_e) return n;
  }
  return std::max(calm, periods.size() > 8 ? periods.size() - 8 : 0);  // many small residuals, no gross one
}

/// Two windings on one core: the other one is healthy, so its equation must hold when the suspect's
/// ampere-turns are `factor` times what its reading and its nominal turns say. `most`: what a window
/// may cost, where shorted turns may carry a current of their own.
double PartnerCost(const LinkageModel& m, const DetectorSettings& s, const std::vector<const KeptPeriod*>& periods,
                   std::size_t first, int j, double factor, double most) {
  if (m.coupling != Coupling::kSides) return 0;
  const int k = j ^ 1;
  double cost = 0, i[64];
  std::vector<Window> windows;
  for (std::size_t n = first; n < periods.size(); ++n) {
    const KeptPeriod& p = *periods[n];
    windows.clear();
    AddWindows(m, s, p, k, &windows);
    PeriodSlopes now;
    ComputePeriodSlopes(m, s.sampling, p.in, &now);
    for (int q = 0; q < s.sampling.samples; ++q) i[q] = p.adc[static_cast<std::size_t>(q)][j];
    for (const Window& w : windows) {
      if (!Applies(w)) continue;
      const int on = static_cast<int>(now.phase[0].samples[k]), count = static_cast<int>(now.phase[w.phase].samples[k]);
      const double slope = SlopeOf(i, w.phase == 0 ? 0 : on, count, s.sampling.step);
      cost += std::min(Cost((w.e + (factor - 1) * m.n[k] * now.permeance.middle[k] * m.n[j] * slope) / w.sd_e), most);
    }
  }
  return cost;
}

/// Own equation with the fewer turns and the nominal circuit: far off when the shorted turns carry
/// a current of their own.
bool LoopCarriesCurrent(const std::vector<Window>& all, double a) {
  double sum = 0, count = 0;
  for (const Window& w : all) {
    if (!Applies(w)) continue;
    sum += Cost((a * a * w.own + a * w.Rest() - w.v) / w.sd_e);
    count += 1;
  }
  return count > 0 && sum / count > 16;
}

}  // namespace

Examination ExamineCoil(const LinkageModel& model, const DetectorSettings& settings,
                        const std::vector<const KeptPeriod*>& periods, std::size_t calm, int coil, bool last) {
  Examination out;
  const std::size_t onset = FindOnset(model, settings, periods, calm, coil);
  std::vector<Window> all;
  const std::size_t first = std::max(onset + 1, periods.size() > 6 ? periods.size() - 6 : 0);
  for (std::size_t n = first; n < periods.size(); ++n) AddWindows(model, settings, *periods[n], coil, &all);
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
  std::stable_sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) { return a.cost < b.cost; });
  const auto vanished = [](FaultClass c) { return c == FaultClass::kOpen || c == FaultClass::kAmplifierOff; };
  std::size_t second = 1;
  if (vanished(entries[0].cls) && vanished(entries[1].cls)) second = 2;
  FaultClass best = entries[0].cls;
  const double lead = entries[second].cost - entries[0].cost;
  out.cost = entries[0].cost;
  if (vanished(best) && second == 2)
    best = Decayed(settings, periods, onset, coil) || entries[1].cost - entries[0].cost > kMargin
               ? (entries[1].cost - entries[0].cost > kMargin ? best : FaultClass::kAmplifierOff)
               : FaultClass::kOpen;
  if (best == FaultClass::kNone) {
    if (UnexplainedStep(model, settings, periods, onset, coil) < kLeastOffset) return out;
    best = FaultClass::kCurrentSensor;  // right before and after, but another offset
  }
  const bool offset = best == FaultClass::kCurrentSensor && entries[0].cls == FaultClass::kNone;
  out.decided = lead > kMargin || last || (offset && periods.size() >= first + 3);
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
