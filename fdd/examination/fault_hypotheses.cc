#include "fdd/examination/fault_hypotheses.h"

#include <algorithm>
#include <cmath>

namespace ambrig {

namespace {

/// The flux equation must hold; the suspect's own one too, or its shorted turns carry a current.
double ShortCost(const PhaseWindows& all, double a) {
  double cost = kParameter;
  for (const PhaseWindow& w : all) {
    if (!w.Applies()) continue;
    const double sd = std::hypot(a * w.sd_f, a * a * w.noise_l);
    cost += Cost((a * w.F + a * a * w.x_l + a * w.x_r - w.v) / sd);
    cost += std::min(Cost((a * a * w.own + a * w.Rest() - w.v) / w.sd_e), kFreeVoltage);
  }
  return cost;
}

}  // namespace

double Cost(double z) { return std::min(z * z, kClip); }

double HealthyCost(const PhaseWindows& all) {
  double cost = 0;
  for (const PhaseWindow& w : all)
    if (w.Applies() && !(w.mean < 2 * kZeroCurrent && w.e > 0)) cost += Cost(w.e / w.sd_e);
  return cost;
}

double OpenCost(const PhaseWindows& all) {
  double cost = 0;
  for (const PhaseWindow& w : all) cost += Cost(w.mean / 0.015) + (w.phase == 0 ? kFreeVoltage : 0);
  return cost;
}

double WrongVoltageCost(const PhaseWindows& all, int phase) {
  double cost = 0;
  for (const PhaseWindow& w : all) {
    if (phase == 0 && w.least < kZeroCurrent) {
      if (w.mean < 2 * kZeroCurrent)
        cost += Cost(w.mean / 0.015) + (w.phase == 0 ? kFreeVoltage : 0);
      continue;
    }
    if (phase == 1 && !w.Applies()) {
      cost += kClip;  // a bridge that always drives leaves no zero current
      continue;
    }
    cost += Cost((w.e + (w.phase == phase ? w.v - w.v_other : 0)) / w.sd_e);
  }
  return cost;
}

double BestShort(const PhaseWindows& all, double* turns_left) {
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

double SensorCost(const PhaseWindows& all, double* c_found) {
  double top = 0, bottom = 0;
  for (const PhaseWindow& w : all) {
    if (!w.Applies()) continue;
    const double x = w.own + w.x_r, weight = 1 / (w.sd_e * w.sd_e);
    top += weight * x * (w.v - w.Rest() + w.x_r);
    bottom += weight * x * x;
  }
  const double c = bottom > 0 ? std::clamp(top / bottom, 0.0, 20.0) : 1;
  *c_found = c;
  double cost = kParameter;
  for (const PhaseWindow& w : all) {
    if (!w.Applies()) continue;
    cost += Cost((c * (w.own + w.x_r) + w.Rest() - w.x_r - w.v) / w.sd_e);
    cost += Cost((w.F + c * (w.x_l + w.x_r) - w.v) / std::hypot(w.sd_f, c * w.noise_l));
  }
  return cost;
}

double FrozenCost(const PhaseWindows& all) {
  double cost = kParameter;
  for (const PhaseWindow& w : all)
    cost += w.mean < 2 * kZeroCurrent ? kClip : Cost(w.own / (1.2 * w.noise_own)) + kFreeVoltage;
  return cost;
}

bool LoopCarriesCurrent(const PhaseWindows& all, double a) {
  double sum = 0, count = 0;
  for (const PhaseWindow& w : all) {
    if (!w.Applies()) continue;
    sum += Cost((a * a * w.own + a * w.Rest() - w.v) / w.sd_e);
    count += 1;
  }
  return count > 0 && sum / count > 16;
}

}  // namespace ambrig
