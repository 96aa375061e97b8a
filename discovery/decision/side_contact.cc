#include "discovery/decision/side_contact.h"

#include <vector>

namespace ambrig {

namespace {

constexpr double kBetter = 0.03;  // of the power: what a detail must explain

/// Straight line through samples, from sums; how much of the second's variance it explains.
struct Line {
  double n = 0, u = 0, v = 0, uu = 0, uv = 0, vv = 0;
  void Add(double a, double b) {
    n += 1;
    u += a;
    v += b;
    uu += a * a;
    uv += a * b;
    vv += b * b;
  }
  double Slope() const { return uu * n > u * u ? (uv - u * v / n) / (uu - u * u / n) : 0; }
  double Explained() const { return Slope() * (uv - u * v / n); }
  double Variance() const { return vv - v * v / n; }
};

/// Along and across the contact's direction the fit falls into two lines, through the depth and
/// through the depth that rubs, each with its constant.
SideContact Fitted(const ForceSamples& s, SideContact c) {
  c.share = c.push = c.drag = 0;
  const double n_x = std::cos(c.angle), n_y = std::sin(c.angle);
  Line along, across;
  for (std::size_t k = 0; k < s.fx.size(); ++k) {
    const double d =
        std::max(0.0, s.x[k] * n_x + s.y[k] * n_y +
                          (c.lobe > 0 ? c.lobe * std::cos(s.theta[k] - c.high) : 0) - c.gap) *
        c.On(s.t[k]);
    along.Add(d, -(s.fx[k] * n_x + s.fy[k] * n_y));
    across.Add(d > 0 ? d * c.Rubs(s, k) : 0, s.fx[k] * n_y - s.fy[k] * n_x);
  }
  const double total = along.Variance() + across.Variance();
  if (total <= 0 || along.Slope() <= 0) return c;  // it would pull
  c.share = (along.Explained() + across.Explained()) / total;
  c.push = along.Slope();
  c.drag = across.Slope();
  return c;
}

/// Direction from which most of the force comes: its principal axis, against its larger side.
double PushedFrom(const ForceSamples& s) {
  double xx = 0, xy = 0, yy = 0, mx = 0, my = 0;
  const auto n = static_cast<double>(s.fx.size());
  for (std::size_t k = 0; k < s.fx.size(); ++k) {
    mx += s.fx[k] / n;
    my += s.fy[k] / n;
  }
  for (std::size_t k = 0; k < s.fx.size(); ++k) {
    xx += std::pow(s.fx[k] - mx, 2);
    yy += std::pow(s.fy[k] - my, 2);
    xy += (s.fx[k] - mx) * (s.fy[k] - my);
  }
  const double axis = 0.5 * std::atan2(2 * xy, xx - yy);
  double third = 0;  // the side of the long tail
  for (std::size_t k = 0; k < s.fx.size(); ++k)
    third += std::pow((s.fx[k] - mx) * std::cos(axis) + (s.fy[k] - my) * std::sin(axis), 3);
  return third > 0 ? axis + kPi : axis;
}

/// Positions along a direction, sorted.
std::vector<double> Along(const ForceSamples& s, double angle) {
  std::vector<double> along;
  for (std::size_t k = 0; k < s.x.size(); ++k)
    along.push_back(s.x[k] * std::cos(angle) + s.y[k] * std::sin(angle));
  std::sort(along.begin(), along.end());
  return along;
}
double SortedQuantile(const std::vector<double>& sorted, double q) {
  return sorted[static_cast<std::size_t>(q * static_cast<double>(sorted.size() - 1))];
}

/// Half the width that two thirds of them fill.
double Spread(const ForceSamples& s, double angle) {
  const std::vector<double> along = Along(s, angle);
  return 0.5 * (SortedQuantile(along, 0.84) - SortedQuantile(along, 0.16));
}

SideContact Better(const ForceSamples& s, const SideContact& best, SideContact c) {
  c = Fitted(s, c);
  return c.share > best.share ? c : best;
}

SideContact StandingContact(const ForceSamples& s) {
  SideContact best;
  for (int d = 0; d < 24; ++d) {
    const double angle = 2 * kPi * d / 24;
    const std::vector<double> along = Along(s, angle);
    for (const double q : {0.02, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.85})
      best = Better(s, best, {angle, SortedQuantile(along, q)});
  }
  return best;
}

/// The best of each period, best first.
std::vector<SideContact> PassingContacts(const ForceSamples& s) {
  std::vector<SideContact> found;
  const double from = PushedFrom(s), longest = *std::max_element(s.t.begin(), s.t.end());
  for (double period = 0.02; period < 0.5 * longest; period *= 1.03) {
    SideContact best;
    for (const double angle : {from - 0.2, from, from + 0.2}) {
      const std::vector<double> along = Along(s, angle);
      for (const double q : {0.1, 0.3, 0.4, 0.5, 0.6})
        for (const double duty : {0.2, 0.35, 0.5, 0.65})
          for (double phase = 0; phase < 1; phase += 0.1)
            best = Better(s, best, {angle, SortedQuantile(along, q), period, phase, duty});
    }
    found.push_back(best);
  }
  std::sort(found.begin(), found.end(),
            [](const SideContact& a, const SideContact& b) { return a.share > b.share; });
  return found;
}

ForceSamples EveryFourth(const ForceSamples& s) {
  ForceSamples out;
  out.radius = s.radius;
  for (const auto part : {&ForceSamples::t, &ForceSamples::theta, &ForceSamples::omega,
                          &ForceSamples::x, &ForceSamples::y, &ForceSamples::vx, &ForceSamples::vy,
                          &ForceSamples::fx, &ForceSamples::fy})
    for (std::size_t k = 0; k < (s.*part).size(); k += 4) (out.*part).push_back((s.*part)[k]);
  return out;
}

/// Downhill in every quantity by turns.
SideContact Refined(const ForceSamples& s, SideContact best) {
  const double spread = Spread(s, best.angle);
  const auto moved = [&](double SideContact::*quantity, double by) {
    SideContact c = best;
    c.*quantity += by;
    c.duty = std::clamp(c.duty, 0.02, 1.0);
    c.lobe = std::max(c.lobe, 0.0);
    best = Better(s, best, c);
  };
  for (double step = 1; step > 0.02; step *= 0.5) {
    const double here = best.share;
    for (const double by : {-step, step}) {
      moved(&SideContact::angle, 0.2 * by);
      moved(&SideContact::gap, 0.7 * spread * by);
      if (best.period > 0) {
        moved(&SideContact::period, 0.03 * by * best.period);
        moved(&SideContact::phase, 0.08 * by);
        moved(&SideContact::duty, 0.1 * by);
      }
      if (best.lobe > 0) {
        moved(&SideContact::lobe, 0.5 * by * best.lobe);
        moved(&SideContact::high, 0.5 * by);
      }
    }
    if (best.share > here + 1e-6) step = std::min(1.0, 2 * step);  // once more at this size
  }
  return best;
}

/// The same with a high spot on the rotor.
SideContact WithLobe(const ForceSamples& s, const SideContact& round) {
  const double spread = Spread(s, round.angle);
  SideContact best;
  for (const double lobe : {0.3 * spread, spread})
    for (const double farther : {0.0, 0.5 * lobe, lobe})
      for (int d = 0; d < 8; ++d) {
        SideContact c = round;
        c.lobe = lobe;
        c.high = 2 * kPi * d / 8;
        c.gap += farther;
        best = Better(s, best, c);
      }
  return Refined(s, best);
}

}  // namespace

SideContact FindSideContact(const ForceSamples& s, double much) {
  const ForceSamples few = EveryFourth(s);  // enough to search where the refinement begins
  const SideContact standing = Refined(s, StandingContact(few));
  const std::vector<SideContact> starts = PassingContacts(few);
  SideContact passing;
  for (std::size_t k = 0; k < std::min<std::size_t>(starts.size(), 6); ++k) {
    const SideContact refined = Refined(few, starts[k]);
    if (refined.share > passing.share) passing = refined;
  }
  passing = Refined(s, passing);
  const SideContact best = passing.share < standing.share + much ? standing : passing;
  const SideContact lobed = WithLobe(s, best);
  return lobed.share < best.share + kBetter ? best : lobed;
}

}  // namespace ambrig
