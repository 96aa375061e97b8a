#include "fdd/examination/flux_step.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "fdd/measurement/slope_fit.h"

namespace ambrig {

namespace {

constexpr std::size_t kFewestOfLine = 6;  // samples on either side of the instant
constexpr double kLeastFollowing = 0.25;  // of a coil's inductance at the ripple, its flux
constexpr double kAsBypassed = 0.4;       // of the step that bypassed turns make
// the same of both windings of a side: a short-lived loop of many turns in one makes half of it
constexpr double kAsBothBypassed = 0.7;
constexpr double kLeastStepping = 0.3;  // [A] of which a step can be told
constexpr double kSeenOfExcess = 0.4;   // of c, by the slopes before and after the instant
constexpr double kSearched = 1.5;       // periods before and after the onset

/// Least squares of y over x, from prefix sums.
struct LineSums {
  double n = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0;
  void Add(double px, double py) {
    n += 1, x += px, y += py, xx += px * px, xy += px * py, yy += py * py;
  }
  LineSums operator-(const LineSums& o) const {
    return {n - o.n, x - o.x, y - o.y, xx - o.xx, xy - o.xy, yy - o.yy};
  }
  double spread() const { return xx - x * x / n; }
  double slope() const { return (xy - x * y / n) / spread(); }
  double at(double px) const { return y / n + slope() * (px - x / n); }
  double error() const { return yy - y * y / n - slope() * (xy - x * y / n); }
};

}  // namespace

struct FluxStep::Curve {
  std::vector<double> t, current, linkage, volts;  // [s], [A], [Vs], [Vs]
  std::vector<double> own;                         // of the ampere-turns that drive its flux
};

FluxStep::FluxStep(const LinkageModel& nominal, const SamplingSettings& sampling)
    : nominal_(nominal), sampling_(sampling) {}

void FluxStep::Keep(const MeasuredPeriod& in) {
  period_[static_cast<std::size_t>(count_++ % kKept)].Keep(in, sampling_.samples);
}

FluxStep::Curve FluxStep::CurveOf(int coil) const {
  Curve out;
  const long long first = std::max(0LL, count_ - kKept);
  double volts = 0;
  double after = 0;  // mean voltage from the last sample of a period to its end [V]
  for (long long p = first; p < count_; ++p) {
    const KeptPeriod& kept = period_[static_cast<std::size_t>(p % kKept)];
    PeriodSlopes s;
    PreparePeriod(nominal_, sampling_, kept.in, &s);
    const Lane& P = s.permeance.middle;
    const double n = nominal_.n[coil], edge = s.edge[coil], on = s.phase[0].voltage[coil],
                 off = s.phase[1].voltage[coil], h = sampling_.step;
    for (int k = 0; k < sampling_.samples; ++k) {
      const Lane& i = kept.adc[static_cast<std::size_t>(k)];
      double potential = 0;
      if (nominal_.coupling == Coupling::kFloatingRotor)
        for (int j = 0; j < nominal_.coils; ++j) potential += P[j] * nominal_.n[j] * i[j];
      double mmf = n * i[coil] - (potential != 0 ? potential / s.permeance.total : 0);
      const double of_partner =
          nominal_.coupling == Coupling::kSides ? nominal_.n[coil ^ 1] * i[coil ^ 1] : 0;
      out.own.push_back(of_partner != 0 ? n * i[coil] / (n * i[coil] + of_partner) : 1);
      mmf += of_partner;
      const double until_edge = std::clamp(edge - (k - 1) * h, 0.0, h);
      const double driven = k == 0 ? after * h : on * until_edge + off * (h - until_edge);
      volts += driven - nominal_.resistance[coil] * i[coil] * h;
      out.t.push_back(kept.in.t + k * h);
      out.current.push_back(i[coil]);
      out.linkage.push_back(n * P[coil] * mmf + nominal_.leakage[coil] * i[coil]);
      out.volts.push_back(volts);
    }
    after = s.after[coil];
  }
  return out;
}

double FluxStep::Follows(int coil, double a) const {
  const KeptPeriod& last = period_[static_cast<std::size_t>((count_ - 1) % kKept)];
  return 1 - a * nominal_.leakage[coil] / nominal_.SelfInductanceAt(coil, last.in.x1, last.in.y1);
}

std::optional<double> FluxStep::Lost(int coil, double onset, double by_ripple, bool of_both) const {
  const Curve c = CurveOf(coil);
  const std::size_t samples = c.t.size();
  const double period = sampling_.step * sampling_.samples;
  std::vector<LineSums> sums(samples + 1);
  for (std::size_t k = 0; k < samples; ++k) {
    sums[k + 1] = sums[k];
    sums[k + 1].Add(c.volts[k], c.linkage[k]);
  }
  std::size_t at = 0;
  double least = kInfinity;
  for (std::size_t k = kFewestOfLine; k + kFewestOfLine <= samples; ++k) {
    if (std::abs(c.t[k] - onset) > kSearched * period) continue;
    const double error = sums[k].error() + (sums[samples] - sums[k]).error();
    if (error < least) {
      least = error;
      at = k;
    }
  }
  // Where the diodes may block, the volt-seconds of the duty are not the coil's.
  if (at == 0 || *std::ranges::min_element(c.current) < kLeastStepping) return {};
  // Without the instant among what is kept both lines have one slope, and nothing can be told.
  const double whole_slope = sums[at].slope(), left_slope = (sums[samples] - sums[at]).slope(),
               excess = 1 / ((1 - by_ripple) * (1 - by_ripple)) - 1;
  if (!(left_slope > whole_slope * (1 + kSeenOfExcess * excess))) return {};
  // Of the last period after the instant, by the slope that the ripple of turns that are left has.
  const double a = whole_slope;
  const double b = a / ((1 - by_ripple) * (1 - by_ripple));
  const double whole = a * c.volts[at - 1] + (sums[at].y - a * sums[at].x) / sums[at].n;
  double step = 0, n = 0;
  for (std::size_t k = samples - static_cast<std::size_t>(sampling_.samples); k < samples; ++k) {
    if (k < at) continue;
    step += c.linkage[k] - whole - b * (c.volts[k] - c.volts[at - 1]);
    n += 1;
  }
  if (n == 0 || !(whole > 0)) return {};
  const double lost = step / n / (b * whole);  // s (1 - s)
  // The leakage keeps its own share of the linkage, the larger the less flux follows the ripple.
  const double follows = Follows(coil, a);
  if (follows < kLeastFollowing) return {};
  // One winding's own ampere-turns step, of those that drive the flux of a side.
  const double own = of_both ? 1 : c.own[at - 1];
  const double bypassed = follows * by_ripple * (1 - by_ripple) * own;
  if (!(lost < (of_both ? kAsBothBypassed : kAsBypassed) * bypassed)) return by_ripple;
  return lost > 0 ? 0.5 - std::sqrt(0.25 - std::min(lost, 0.25)) : 0;
}

}  // namespace ambrig
