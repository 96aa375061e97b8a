#include "discovery/missing_force.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "core/math/constants.h"
#include "scenarios/residual_force.h"

namespace ambrig {

namespace {

constexpr double kCutoff = 200;        // [Hz] of the estimated force
constexpr std::size_t kMost = 1500;    // samples looked at
constexpr double kMuchBetter = 0.08;   // of the power: what a law with more freedom must gain
constexpr double kBetter = 0.03;       // the same, of a detail

/// A law f = Σ c_k b_k with vector fields b_k, fitted with a constant force beside it.
struct Field {
  std::vector<double> x, y;
};

struct Fit {
  double share = 0;
  std::vector<double> c;
};

Fit FitFields(const ForceSamples& s, const std::vector<Field>& fields) {
  const std::size_t n = s.fx.size(), m = fields.size();
  const auto columns = static_cast<Eigen::Index>(m + 2);
  Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(columns, columns);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(columns), row_x(columns), row_y(columns);
  double mean_x = 0, mean_y = 0, square = 0;
  for (std::size_t k = 0; k < n; ++k) {
    for (std::size_t f = 0; f < m; ++f) {
      row_x(static_cast<Eigen::Index>(f)) = fields[f].x[k];
      row_y(static_cast<Eigen::Index>(f)) = fields[f].y[k];
    }
    row_x.tail(2) << 1, 0;
    row_y.tail(2) << 0, 1;
    gram += row_x * row_x.transpose() + row_y * row_y.transpose();
    right += s.fx[k] * row_x + s.fy[k] * row_y;
    mean_x += s.fx[k] / static_cast<double>(n);
    mean_y += s.fy[k] / static_cast<double>(n);
    square += s.fx[k] * s.fx[k] + s.fy[k] * s.fy[k];
  }
  const double total = square - static_cast<double>(n) * (mean_x * mean_x + mean_y * mean_y);
  if (total <= 0) return {};
  const Eigen::VectorXd c = gram.completeOrthogonalDecomposition().solve(right);
  const double left = square - 2 * c.dot(right) + c.dot(gram * c);
  return {std::clamp(1 - left / total, 0.0, 1.0), {c.data(), c.data() + m}};
}

std::string Parameter(const std::string& name, double value, const std::string& unit) {
  return fmt::format("{} = {{ value = {:.4g}, null = 0.0, min = {:.4g}, max = {:.4g}, unit = \"{}\" }}", name, value, -20 * std::abs(value), 20 * std::abs(value), unit);
}

std::string Effect(const std::string& plane, const std::string& label, const std::vector<std::string>& parameters, const std::string& x, const std::string& y) {
  std::string list;
  for (const std::string& p : parameters) list += (list.empty() ? "" : ", ") + p;
  return fmt::format("[[effect]]\nname = \"formula\"\nlabel = \"{}\"\ntarget = \"{}\"\nparameters = {{ {} }}\nforce = {{ x = \"{}\", y = \"{}\" }}\n", label, plane, list, x, y);
}

template <class Function>
Field MakeField(const ForceSamples& s, Function f) {
  Field out;
  for (std::size_t k = 0; k < s.fx.size(); ++k) {
    const auto [x, y] = f(k);
    out.x.push_back(x);
    out.y.push_back(y);
  }
  return out;
}

/// Laws without a threshold: linear in their coefficients.
std::vector<MissingForce> SmoothLaws(const ForceSamples& s, const std::string& plane) {
  using Pair = std::pair<double, double>;
  std::vector<MissingForce> out;
  const auto add = [&](const std::string& on, const std::vector<Field>& fields, const std::vector<std::string>& names, const std::string& unit, const std::string& x,
                       const std::string& y) {
    const Fit fit = FitFields(s, fields);
    std::vector<std::string> parameters;
    for (std::size_t k = 0; k < names.size(); ++k) parameters.push_back(Parameter(names[k], fit.c.empty() ? 0 : fit.c[k], unit));
    out.push_back({plane, 0, on, fit.share, Effect(plane, on, parameters, x, y)});
  };
  const auto linear = [&](const std::vector<double>& u, const std::vector<double>& v) {
    return std::vector<Field>{MakeField(s, [&](std::size_t k) { return Pair{u[k], 0}; }), MakeField(s, [&](std::size_t k) { return Pair{v[k], 0}; }),
                              MakeField(s, [&](std::size_t k) { return Pair{0, u[k]}; }), MakeField(s, [&](std::size_t k) { return Pair{0, v[k]}; })};
  };
  add("position (linear)", linear(s.x, s.y), {"kxx", "kxy", "kyx", "kyy"}, "N/m", "kxx*x + kxy*y", "kyx*x + kyy*y");
  add("velocity (linear)", linear(s.vx, s.vy), {"cxx", "cxy", "cyx", "cyy"}, "N s/m", "cxx*vx + cxy*vy", "cyx*vx + cyy*vy");
  add("position (cubic)", {MakeField(s, [&](std::size_t k) {
        const double r2 = s.x[k] * s.x[k] + s.y[k] * s.y[k];
        return Pair{s.x[k] * r2, s.y[k] * r2};
      })}, {"k3"}, "N/m3", "k3*x*(x*x + y*y)", "k3*y*(x*x + y*y)");
  for (const int order : {1, 2}) {
    const auto turning = [&](double shift) {
      return MakeField(s, [&](std::size_t k) { return Pair{std::cos(order * s.theta[k] + shift), std::sin(order * s.theta[k] + shift)}; });
    };
    const std::string a = order == 1 ? "theta" : "2*theta";
    add(fmt::format("angle of rotation, order {}", order), {turning(0), turning(kPi / 2)}, {"c", "s"}, "N", fmt::format("c*cos({0}) - s*sin({0})", a),
        fmt::format("c*sin({0}) + s*cos({0})", a));
  }
  return out;
}

/// Something that pushes back from one side: f = -k max(along + lobe cos(theta - high) - gap, 0) (n + mu t),
/// n its direction; always, or in a bump that comes back every period. The lobe is the rotor's high spot.
struct Contact {
  double angle = 0, gap = 0, period = 0, phase = 0, duty = 1, lobe = 0, high = 0;
  Fit fit = {};

  double Least() const { return std::cos(kPi * duty); }  // of the cosine where the bump begins
  double On(double t) const {
    return period <= 0 ? 1 : std::max(0.0, std::cos(2 * kPi * (t / period - phase)) - Least()) / (1 - Least());
  }
};

/// Along and across the contact's direction the fit falls into two lines through the depth, each with
/// its constant.
Fit FitContact(const ForceSamples& s, const Contact& c) {
  const double n_x = std::cos(c.angle), n_y = std::sin(c.angle);
  double sd = 0, sdd = 0, sr = 0, st = 0, srd = 0, std_ = 0, square = 0;
  for (std::size_t k = 0; k < s.fx.size(); ++k) {
    const double d = std::max(0.0, s.x[k] * n_x + s.y[k] * n_y + (c.lobe > 0 ? c.lobe * std::cos(s.theta[k] - c.high) : 0) - c.gap) * c.On(s.t[k]);
    const double r = -(s.fx[k] * n_x + s.fy[k] * n_y), t = s.fx[k] * n_y - s.fy[k] * n_x;
    sd += d;
    sdd += d * d;
    sr += r;
    st += t;
    srd += r * d;
    std_ += t * d;
    square += r * r + t * t;
  }
  const auto n = static_cast<double>(s.fx.size());
  const double total = square - (sr * sr + st * st) / n, depth = sdd - sd * sd / n;
  const double along = srd - sr * sd / n, across = std_ - st * sd / n;
  if (total <= 0 || depth <= 0 || along <= 0) return {};  // it would pull
  return {(along * along + across * across) / depth / total, {along / depth, across / depth}};
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
  for (std::size_t k = 0; k < s.fx.size(); ++k) third += std::pow((s.fx[k] - mx) * std::cos(axis) + (s.fy[k] - my) * std::sin(axis), 3);
  return third > 0 ? axis + kPi : axis;
}

/// Positions along a direction, sorted.
std::vector<double> Along(const ForceSamples& s, double angle) {
  std::vector<double> along;
  for (std::size_t k = 0; k < s.x.size(); ++k) along.push_back(s.x[k] * std::cos(angle) + s.y[k] * std::sin(angle));
  std::sort(along.begin(), along.end());
  return along;
}
double Quantile(const std::vector<double>& sorted, double q) { return sorted[static_cast<std::size_t>(q * static_cast<double>(sorted.size() - 1))]; }

Contact Better(const ForceSamples& s, const Contact& best, Contact c) {
  c.fit = FitContact(s, c);
  return c.fit.share > best.fit.share ? c : best;
}

Contact StandingContact(const ForceSamples& s) {
  Contact best;
  for (int d = 0; d < 24; ++d) {
    const double angle = 2 * kPi * d / 24;
    const std::vector<double> along = Along(s, angle);
    for (const double q : {0.02, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.85}) best = Better(s, best, {angle, Quantile(along, q)});
  }
  return best;
}

Contact PassingContact(const ForceSamples& s) {
  Contact best;
  const double from = PushedFrom(s), longest = *std::max_element(s.t.begin(), s.t.end());
  for (const double angle : {from - 0.2, from, from + 0.2}) {
    const std::vector<double> along = Along(s, angle);
    for (const double q : {0.1, 0.3, 0.4, 0.5, 0.6})
      for (double period = 0.02; period < 0.5 * longest; period *= 1.03)
        for (const double duty : {0.2, 0.35, 0.5, 0.65})
          for (double phase = 0; phase < 1; phase += 0.1) best = Better(s, best, {angle, Quantile(along, q), period, phase, duty});
  }
  return best;
}

/// Downhill in every quantity by turns.
Contact Refined(const ForceSamples& s, Contact best) {
  const std::vector<double> along = Along(s, best.angle);
  const double spread = 0.5 * (Quantile(along, 0.84) - Quantile(along, 0.16));
  const auto moved = [&](double Contact::*quantity, double by) {
    Contact c = best;
    c.*quantity += by;
    c.duty = std::clamp(c.duty, 0.02, 1.0);
    c.lobe = std::max(c.lobe, 0.0);
    best = Better(s, best, c);
  };
  for (double step = 1; step > 0.02; step *= 0.5) {
    const double here = best.fit.share;
    for (const double by : {-step, step}) {
      moved(&Contact::angle, 0.2 * by);
      moved(&Contact::gap, 0.7 * spread * by);
      if (best.period > 0) {
        moved(&Contact::period, 0.03 * by * best.period);
        moved(&Contact::phase, 0.08 * by);
        moved(&Contact::duty, 0.1 * by);
      }
      if (best.lobe > 0) {
        moved(&Contact::lobe, 0.5 * by * best.lobe);
        moved(&Contact::high, 0.5 * by);
      }
    }
    if (best.fit.share > here + 1e-6) step = std::min(1.0, 2 * step);  // once more at this size
  }
  return best;
}

/// The same with a high spot on the rotor.
Contact WithLobe(const ForceSamples& s, const Contact& round) {
  const std::vector<double> along = Along(s, round.angle);
  const double spread = 0.5 * (Quantile(along, 0.84) - Quantile(along, 0.16));
  Contact best;
  for (const double lobe : {0.3 * spread, spread})
    for (const double farther : {0.0, 0.5 * lobe, lobe})
      for (int d = 0; d < 8; ++d) {
        Contact c = round;
        c.lobe = lobe;
        c.high = 2 * kPi * d / 8;
        c.gap += farther;
        best = Better(s, best, c);
      }
  return Refined(s, best);
}

Contact FindContact(const ForceSamples& s) {
  const Contact standing = Refined(s, StandingContact(s)), passing = Refined(s, PassingContact(s));
  const Contact best = passing.fit.share < standing.fit.share + kMuchBetter ? standing : passing;
  const Contact lobed = WithLobe(s, best);
  return lobed.fit.share < best.fit.share + kBetter ? best : lobed;
}

MissingForce ContactLaw(const ForceSamples& s, const std::string& plane) {
  const Contact c = FindContact(s);
  if (c.fit.c.empty() || c.fit.share <= 0) return {plane, 0, "contact", 0, ""};
  const double k = c.fit.c[0], mu = c.fit.c[1] / k, angle = std::remainder(c.angle, 2 * kPi);
  std::string on = fmt::format("position on one side: something pushes back from {:.0f} degrees (from x towards y)", angle * 180 / kPi), gate;
  const auto within = [](const char* name, double value, double reach, const char* unit) {
    return fmt::format("{} = {{ value = {:.4g}, min = {:.4g}, max = {:.4g}, unit = \"{}\" }}", name, value, value - reach, value + reach, unit);
  };
  std::vector<std::string> parameters = {Parameter("k", k, "N/m"), within("gap", c.gap, 4e-5, "m"), within("mu", std::clamp(mu, -1.5, 1.5), 0.5, "-"), within("a", angle, 0.5, "rad")};
  if (c.period > 0) {
    on += fmt::format(", only in a part of every {:.3g} s", c.period);
    gate = "*max(cos(2*pi*(t/period - phase)) - b, 0)/(1 - b)";
    parameters.push_back(within("period", c.period, 0.05 * c.period, "s"));
    parameters.push_back(within("phase", c.phase - std::floor(c.phase), 0.2, "-"));
    const double least = std::clamp(c.Least(), -0.8, 0.9);
    parameters.push_back(within("b", least, std::min(0.6, 0.97 - least), "-"));
  }
  std::string depth = "cos(a)*x + sin(a)*y - gap";
  if (c.lobe > 0) {
    on += ", deeper where the rotor has a high spot";
    depth += " + lobe*cos(theta - high)";
    parameters.push_back(within("lobe", c.lobe, 0.95 * c.lobe, "m"));
    parameters.push_back(within("high", std::remainder(c.high, 2 * kPi), 1, "rad"));
  }
  const std::string push = "-k*max(" + depth + ", 0)" + gate;
  return {plane, 0, on, c.fit.share, Effect(plane, "contact on one side", parameters, push + "*(cos(a) - mu*sin(a))", push + "*(sin(a) + mu*cos(a))")};
}

/// Samples of all levitated records, thinned to kMost.
std::optional<ForceSamples> SamplesOf(const CaseModel& model, const Hypothesis& h, const std::string& plane) {
  ForceSamples all;
  for (const CaseRecord& r : model.data().records) {
    const auto force = EstimateResidualForce(h.rig, r.scenario, r.data, kCutoff);
    if (!force) continue;
    const auto edge = static_cast<std::size_t>(2 * r.data.rate / kCutoff);
    for (const auto& p : force->planes) {
      if (p.bearing != plane) continue;
      for (std::size_t k = edge; k + edge < p.fx.size(); ++k) {
        all.t.push_back(force->t[k]);
        all.theta.push_back(force->theta[k]);
        all.x.push_back(p.x[k]);
        all.y.push_back(p.y[k]);
        all.vx.push_back(p.vx[k]);
        all.vy.push_back(p.vy[k]);
        all.fx.push_back(p.fx[k]);
        all.fy.push_back(p.fy[k]);
      }
    }
  }
  if (all.t.size() < 100) return std::nullopt;
  const std::size_t stride = all.t.size() / kMost + 1;
  for (auto* v : {&all.t, &all.theta, &all.x, &all.y, &all.vx, &all.vy, &all.fx, &all.fy}) {
    for (std::size_t k = 0; k * stride < v->size(); ++k) (*v)[k] = (*v)[k * stride];
    v->resize((v->size() + stride - 1) / stride);
  }
  return all;
}

}  // namespace

MissingForce FindLaw(const ForceSamples& samples, const std::string& plane) {
  std::vector<MissingForce> laws = SmoothLaws(samples, plane);
  MissingForce best = *std::max_element(laws.begin(), laws.end(), [](const auto& a, const auto& b) { return a.share < b.share; });
  const MissingForce contact = ContactLaw(samples, plane);
  if (contact.share > best.share + kMuchBetter) best = contact;
  double square = 0;
  for (std::size_t k = 0; k < samples.fx.size(); ++k) square += samples.fx[k] * samples.fx[k] + samples.fy[k] * samples.fy[k];
  best.rms = std::sqrt(square / static_cast<double>(std::max<std::size_t>(samples.fx.size(), 1)));
  return best;
}

std::optional<MissingForce> DescribeMissingForce(const CaseModel& model, const Hypothesis& h, const std::string& plane) {
  const auto samples = SamplesOf(model, h, plane);
  if (!samples) return std::nullopt;
  return FindLaw(*samples, plane);
}

}  // namespace ambrig
