#include "discovery/decision/missing_force.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "core/math/constants.h"
#include "core/math/linear_equations.h"
#include "discovery/decision/side_contact.h"
#include "discovery/model/residual_force.h"

namespace ambrig {

namespace {

constexpr double kCutoff = 200;       // [Hz] of the estimated force
constexpr std::size_t kMost = 1500;   // samples looked at
constexpr double kMuchBetter = 0.08;  // of the power: what a law with more freedom must gain

/// A law f = Σ c_k b_k with vector fields b_k, fitted with a constant force beside it.
struct ForceField {
  std::vector<double> x, y;
};

struct ForceFit {
  double share = 0;
  std::vector<double> c;
};

ForceFit FitFields(const ForceSamples& s, const std::vector<ForceField>& fields) {
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
  const Eigen::VectorXd c = SolveLeastNorm(gram, right);
  const double left = square - 2 * c.dot(right) + c.dot(gram * c);
  return {std::clamp(1 - left / total, 0.0, 1.0), {c.data(), c.data() + m}};
}

std::string Parameter(const std::string& name, double value, const std::string& unit) {
  return fmt::format(
      "{} = {{ value = {:.4g}, null = 0.0, min = {:.4g}, max = {:.4g}, unit = \"{}\" }}", name,
      value, -20 * std::abs(value), 20 * std::abs(value), unit);
}

std::string Effect(const std::string& plane, const std::string& label,
                   const std::vector<std::string>& parameters, const std::string& x,
                   const std::string& y) {
  std::string list;
  for (const std::string& p : parameters) list += (list.empty() ? "" : ", ") + p;
  return fmt::format(
      "[[effect]]\nname = \"formula\"\nlabel = \"{}\"\ntarget = \"{}\"\nparameters = {{ {} "
      "}}\nforce = {{ x = \"{}\", y = \"{}\" }}\n",
      label, plane, list, x, y);
}

template <class Function>
ForceField MakeField(const ForceSamples& s, Function f) {
  ForceField out;
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
  const auto add = [&](const std::string& on, const std::vector<ForceField>& fields,
                       const std::vector<std::string>& names, const std::string& unit,
                       const std::string& x, const std::string& y) {
    const ForceFit fit = FitFields(s, fields);
    std::vector<std::string> parameters;
    for (std::size_t k = 0; k < names.size(); ++k)
      parameters.push_back(Parameter(names[k], fit.c.empty() ? 0 : fit.c[k], unit));
    out.push_back({plane, 0, on, fit.share, Effect(plane, on, parameters, x, y)});
  };
  const auto linear = [&](const std::vector<double>& u, const std::vector<double>& v) {
    return std::vector<ForceField>{MakeField(s,
                                             [&](std::size_t k) {
                                               return Pair{u[k], 0};
                                             }),
                                   MakeField(s,
                                             [&](std::size_t k) {
                                               return Pair{v[k], 0};
                                             }),
                                   MakeField(s,
                                             [&](std::size_t k) {
                                               return Pair{0, u[k]};
                                             }),
                                   MakeField(s, [&](std::size_t k) {
                                     return Pair{0, v[k]};
                                   })};
  };
  add("position (linear)", linear(s.x, s.y), {"kxx", "kxy", "kyx", "kyy"}, "N/m", "kxx*x + kxy*y",
      "kyx*x + kyy*y");
  add("velocity (linear)", linear(s.vx, s.vy), {"cxx", "cxy", "cyx", "cyy"}, "N s/m",
      "cxx*vx + cxy*vy", "cyx*vx + cyy*vy");
  add("position (cubic)",
      {MakeField(s,
                 [&](std::size_t k) {
                   const double r2 = s.x[k] * s.x[k] + s.y[k] * s.y[k];
                   return Pair{s.x[k] * r2, s.y[k] * r2};
                 })},
      {"k3"}, "N/m3", "k3*x*(x*x + y*y)", "k3*y*(x*x + y*y)");
  for (const int order : {1, 2}) {
    const auto turning = [&](double shift) {
      return MakeField(s, [&](std::size_t k) {
        return Pair{std::cos(order * s.theta[k] + shift), std::sin(order * s.theta[k] + shift)};
      });
    };
    const std::string a = order == 1 ? "theta" : "2*theta";
    add(fmt::format("angle of rotation, order {}", order), {turning(0), turning(kPi / 2)},
        {"c", "s"}, "N", fmt::format("c*cos({0}) - s*sin({0})", a),
        fmt::format("c*sin({0}) + s*cos({0})", a));
  }
  return out;
}

MissingForce ContactLaw(const ForceSamples& s, const std::string& plane) {
  const SideContact c = FindSideContact(s, kMuchBetter);
  if (c.share <= 0) return {plane, 0, "contact", 0, ""};
  const double k = c.push, mu = c.drag / k, angle = std::remainder(c.angle, 2 * kPi);
  std::string
      on = fmt::format(
          "position on one side: a restoring force acts from {:.0f} degrees (from x towards y)",
          angle * 180 / kPi),
      gate;
  const auto within = [](const char* name, double value, double reach, const char* unit) {
    return fmt::format("{} = {{ value = {:.4g}, min = {:.4g}, max = {:.4g}, unit = \"{}\" }}", name,
                       value, value - reach, value + reach, unit);
  };
  std::vector<std::string> parameters = {Parameter("k", k, "N/m"), within("gap", c.gap, 4e-5, "m"),
                                         within("mu", std::clamp(mu, -1.5, 1.5), 0.5, "-"),
                                         within("a", angle, 0.5, "rad")};
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
  // Friction against the sliding: none at rest, the other way round when the rotor turns backwards.
  const std::string v = fmt::format("({:.6g}*omega - sin(a)*vx + cos(a)*vy)", s.radius);
  const std::string rub =
      fmt::format("mu*{0}/sqrt({0}^2 + {1:g})", v, SideContact::kSlow * SideContact::kSlow);
  return {plane, 0, on, c.share,
          Effect(plane, "contact on one side", parameters, push + "*(cos(a) - sin(a)*" + rub + ")",
                 push + "*(sin(a) + cos(a)*" + rub + ")")};
}

/// Samples of all levitated records, thinned to kMost.
std::optional<ForceSamples> SamplesOf(const CaseModel& model, const Hypothesis& h,
                                      const std::string& plane) {
  ForceSamples all;
  all.radius = h.rig.rotor.journal_radius;
  for (const CaseRecord& r : model.data().records) {
    const auto force = EstimateResidualForce(h.rig, r.scenario, r.data, kCutoff);
    if (!force) continue;
    const auto edge = static_cast<std::size_t>(2 * r.data.rate / kCutoff);
    for (const auto& p : force->planes) {
      if (p.bearing != plane) continue;
      for (std::size_t k = edge; k + edge < p.fx.size(); ++k) {
        all.t.push_back(force->t[k]);
        all.theta.push_back(force->theta[k]);
        all.omega.push_back(force->omega[k]);
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
  for (auto* v :
       {&all.t, &all.theta, &all.omega, &all.x, &all.y, &all.vx, &all.vy, &all.fx, &all.fy}) {
    for (std::size_t k = 0; k * stride < v->size(); ++k) (*v)[k] = (*v)[k * stride];
    v->resize((v->size() + stride - 1) / stride);
  }
  return all;
}

}  // namespace

MissingForce FindLaw(const ForceSamples& samples, const std::string& plane) {
  std::vector<MissingForce> laws = SmoothLaws(samples, plane);
  MissingForce best = *std::max_element(
      laws.begin(), laws.end(), [](const auto& a, const auto& b) { return a.share < b.share; });
  const MissingForce contact = ContactLaw(samples, plane);
  if (contact.share > best.share + kMuchBetter) best = contact;
  double square = 0;
  for (std::size_t k = 0; k < samples.fx.size(); ++k)
    square += samples.fx[k] * samples.fx[k] + samples.fy[k] * samples.fy[k];
  best.rms = std::sqrt(square / static_cast<double>(std::max<std::size_t>(samples.fx.size(), 1)));
  return best;
}

std::optional<MissingForce> DescribeMissingForce(const CaseModel& model, const Hypothesis& h,
                                                 const std::string& plane) {
  const auto samples = SamplesOf(model, h, plane);
  if (!samples) return std::nullopt;
  return FindLaw(*samples, plane);
}

}  // namespace ambrig
