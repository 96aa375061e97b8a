#include "control/position/filter.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/math/constants.h"

namespace ambrig {

FilterParameters ReadFilter(const TomlTable& t, const std::vector<std::string>& axes, double rate) {
  FilterParameters p;
  const std::string kind = t.Choice("kind", "", "notch, lead-lag, low-pass");
  p.kind = kind == "notch"      ? FilterKind::kNotch
           : kind == "lead-lag" ? FilterKind::kLeadLag
                                : FilterKind::kLowPass;
  const auto below = [&](const char* key, double f) {
    if (!(f < 0.5 * rate))
      t.Fail(key,
             fmt::format("= {} Hz, allowed: below half the controller's rate of {} Hz", f, rate));
  };
  switch (p.kind) {
    case FilterKind::kNotch:
      t.Read(p, kNotchFields);
      below("frequency", p.frequency);
      break;
    case FilterKind::kLeadLag:
      t.Read(p, kLeadLagFields);
      below("zero", std::sqrt(p.zero * p.pole));
      break;
    case FilterKind::kLowPass:
      t.Read(p, kLowPassFields);
      below("frequency", p.frequency);
      break;
  }
  if (t.Has("axes")) p.axes = t.Strings("axes");
  for (const std::string& a : p.axes)
    if (std::find(axes.begin(), axes.end(), a) == axes.end())
      t.Fail("axes", fmt::format("= \"{}\", allowed: {}", a, fmt::join(axes, ", ")));
  t.RejectUnknownKeys();
  return p;
}

StateSpace Biquad::Linear() const {
  StateSpace s;
  s.A.resize(2, 2);
  s.A << -a1, 1, -a2, 0;
  s.B.resize(2, 1);
  s.B << b1 - a1 * b0, b2 - a2 * b0;
  s.C.resize(1, 2);
  s.C << 1, 0;
  s.D = Eigen::MatrixXd::Constant(1, 1, b0);
  return s;
}

namespace {

/// (n2 s² + n1 s + n0) / (d2 s² + d1 s + d0) with s = c (z - 1)/(z + 1).
Biquad Sampled(double n2, double n1, double n0, double d2, double d1, double d0, double c) {
  const double c2 = c * c, a = d2 * c2 + d1 * c + d0;
  Biquad q;
  q.b0 = (n2 * c2 + n1 * c + n0) / a;
  q.b1 = 2 * (n0 - n2 * c2) / a;
  q.b2 = (n2 * c2 - n1 * c + n0) / a;
  q.a1 = 2 * (d0 - d2 * c2) / a;
  q.a2 = (d2 * c2 - d1 * c + d0) / a;
  return q;
}

}  // namespace

Biquad SampleFilter(const FilterParameters& p, double Ts) {
  const double centre =
      2 * kPi * (p.kind == FilterKind::kLeadLag ? std::sqrt(p.zero * p.pole) : p.frequency);
  const double c = centre / std::tan(centre * Ts / 2);
  switch (p.kind) {
    case FilterKind::kNotch: {
      const double b = 2 * kPi * p.width;
      return Sampled(1, p.depth * b, centre * centre, 1, b, centre * centre, c);
    }
    case FilterKind::kLeadLag: {
      // First order: over and under z + 1 would cancel, so it is written out.
      const double wz = 2 * kPi * p.zero, wp = 2 * kPi * p.pole, a = c / wp + 1;
      Biquad q;
      q.b0 = (c / wz + 1) / a;
      q.b1 = (1 - c / wz) / a;
      q.a1 = (1 - c / wp) / a;
      return q;
    }
    case FilterKind::kLowPass:
      break;
  }
  return Sampled(0, 0, centre * centre, 1, 2 * p.damping * centre, centre * centre, c);
}

}  // namespace ambrig
