#include "control/position/controller_file.h"
#include "core/base/counted.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>
#include <utility>

namespace ambrig {

namespace {

std::vector<double> Polynomial(const TomlTable& t, const char* key) {
  const auto p = t.Numbers(key);
  if (p.empty() || p.size() > 41)
    t.Fail(key,
           fmt::format("has {}, allowed: 1 to 41, descending powers", Counted(p.size(), "entry")));
  for (const double v : p)
    if (!std::isfinite(v)) t.Fail(key, "allowed: finite numbers");
  return p;
}

StateSpace Sampled(const TomlTable& t, const StateSpace& s, double rate, const char* fallback) {
  if (t.Choice("domain", fallback, "s, z") == "z") return s;
  const StateSpace z = Bilinear(s, 1 / rate);
  if (!z.A.allFinite())
    t.Fail("domain", fmt::format("= \"s\": a pole at 2 rate = {} 1/s cannot be sampled", 2 * rate));
  return z;
}

AxisSystem ReadTransfer(const TomlTable& t, const std::vector<std::string>& axes, double rate) {
  AxisSystem a;
  const auto num = Polynomial(t, "numerator"), den = Polynomial(t, "denominator");
  const auto order = [](const std::vector<double>& p) {
    return p.end() - std::find_if(p.begin(), p.end(), [](double v) { return v != 0; });
  };
  if (order(den) == 0) t.Fail("denominator", "is zero, allowed: a number other than 0 in it");
  if (order(num) > order(den))
    t.Fail("numerator",
           "is of a higher power than the denominator, allowed: a proper transfer function");
  a.system = Sampled(t, FromTransferFunction(num, den), rate, "s");
  if (t.Has("axes")) a.axes = t.Strings("axes");
  for (const std::string& name : a.axes)
    if (std::find(axes.begin(), axes.end(), name) == axes.end())
      t.Fail("axes", fmt::format("= \"{}\", allowed: {}", name, fmt::join(axes, ", ")));
  t.RejectUnknownKeys();
  return a;
}

Eigen::MatrixXd Matrix(const TomlTable& t, const char* key, Eigen::Index rows,
                       Eigen::Index columns) {
  const auto all = t.Has(key) ? t.Rows(key) : std::vector<std::vector<double>>{};
  if (all.empty() && rows == 0) return Eigen::MatrixXd(0, columns);
  Eigen::MatrixXd m(rows, columns);
  bool fits = static_cast<Eigen::Index>(all.size()) == rows;
  for (std::size_t r = 0; fits && r < all.size(); ++r) {
    fits = static_cast<Eigen::Index>(all[r].size()) == columns;
    for (std::size_t c = 0; fits && c < all[r].size(); ++c) {
      m(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(c)) = all[r][c];
      if (!std::isfinite(all[r][c])) t.Fail(key, "allowed: finite numbers");
    }
  }
  if (!fits) t.Fail(key, fmt::format("allowed: {} rows of {} numbers", rows, columns));
  return m;
}

StateSpace MatricesOf(const TomlTable& t, std::size_t axes, double rate) {
  const auto p = static_cast<Eigen::Index>(axes);
  const auto n = t.Has("A") ? static_cast<Eigen::Index>(t.Rows("A").size()) : 0;
  if (n > 400) t.Fail("A", fmt::format("has {} rows, allowed: 0 to 400", n));
  StateSpace s;
  s.A = Matrix(t, "A", n, n);
  s.B = Matrix(t, "B", n, p);
  s.C = n > 0 ? Matrix(t, "C", p, n) : Eigen::MatrixXd(p, 0);
  s.D = t.Has("D") ? Matrix(t, "D", p, p) : Eigen::MatrixXd::Zero(p, p);
  if (n == 0 && !t.Has("D")) t.Fail("D", "is missing, allowed: A, B, C and D, or D alone");
  return Sampled(t, s, rate, "z");
}

StateSpace ReadSystem(const TomlTable& t, std::size_t axes, double rate) {
  if (!t.Has("file")) return MatricesOf(t, axes, rate);
  for (const char* key : {"A", "B", "C", "D"})
    if (t.Has(key)) t.Fail(key, "is given beside file, allowed: one of both");
  const std::string file = t.String("file");
  const auto beside = std::filesystem::path(t.file()).parent_path() / file;
  const TomlTable inner = TomlTable::FromFile(file.starts_with('/') ? file : beside.string());
  const StateSpace s = MatricesOf(inner, axes, rate);
  inner.RejectUnknownKeys();
  return s;
}

/// Tables with ascending speeds.
void CheckAscending(const TomlTable& t, double before, double speed) {
  if (speed <= before)
    t.Fail("speed",
           fmt::format("= {} rad/s after {} rad/s, allowed: ascending speeds", speed, before));
}

void ReadPidExtras(const TomlTable& t, const std::vector<std::string>& axes,
                   ControllerParameters& c) {
  for (const TomlTable& f : t.Tables("filter")) c.filters.push_back(ReadFilter(f, axes, c.rate));
  double before = -1;
  for (const TomlTable& s : t.Tables("schedule")) {
    PidPoint p{kRequired, c.pid.kp, c.pid.kd, c.pid.ki};
    s.Read(p, kPidPointFields);
    CheckAscending(s, before, p.speed);
    before = p.speed;
    s.RejectUnknownKeys();
    c.schedule.push_back(p);
  }
}

void ReadTransfers(const TomlTable& t, const std::vector<std::string>& axes,
                   ControllerParameters& c) {
  std::set<std::string> named;
  bool rest = false;
  for (const TomlTable& k : t.Tables("transfer")) {
    const AxisSystem a = ReadTransfer(k, axes, c.rate);
    if (a.axes.empty() && std::exchange(rest, true))
      k.Fail("axes", "is missing in two of them, allowed: in one, for the axes left");
    for (const std::string& name : a.axes)
      if (!named.insert(name).second)
        k.Fail("axes", fmt::format("= \"{}\" stands twice, allowed: once", name));
    c.transfers.push_back(a);
  }
  for (const std::string& name : axes)
    if (!rest && !named.contains(name))
      t.Fail("transfer", fmt::format("has none for axis {}, allowed: [[controller.transfer]] with "
                                     "numerator and denominator for every axis",
                                     name));
}

void ReadSystems(const TomlTable& t, std::size_t axes, ControllerParameters& c) {
  const auto points = t.Tables("point");
  if (points.empty()) {
    c.systems.push_back({0, ReadSystem(t, axes, c.rate)});
    return;
  }
  double before = -1;
  for (const TomlTable& p : points) {
    SystemPoint s{p.Number("speed"), ReadSystem(p, axes, c.rate)};
    if (!(s.speed >= 0 && s.speed <= 1e5))
      p.Fail("speed", fmt::format("= {} rad/s, allowed: 0 to 1e5", s.speed));
    CheckAscending(p, before, s.speed);
    before = s.speed;
    p.RejectUnknownKeys();
    if (!c.systems.empty() && s.system.states() != c.systems.front().system.states())
      p.Fail("A", fmt::format("is of order {}, allowed: {} as at the first speed",
                              s.system.states(), c.systems.front().system.states()));
    c.systems.push_back(s);
  }
}

CoordinateGains ReadGains(const TomlTable& t, const char* key,
                          const Field<CoordinateGains> (&fields)[4]) {
  const auto inner = t.Table(key);
  if (!inner)
    t.Fail(key, "is missing, allowed: { kp = , kd = , ki = , derivative_time_constant = }");
  CoordinateGains g;
  inner->Read(g, fields);
  inner->RejectUnknownKeys();
  return g;
}

void ReadSpeeds(const TomlTable& t, ControllerParameters& c) {
  c.speeds = t.Numbers("speeds", {0.0});
  for (std::size_t k = 0; k < c.speeds.size(); ++k)
    if (!(c.speeds[k] >= 0 && c.speeds[k] <= 1e5) || (k > 0 && c.speeds[k] <= c.speeds[k - 1]))
      t.Fail("speeds", fmt::format("= {} rad/s, allowed: ascending, 0 to 1e5", c.speeds[k]));
  if (c.speeds.empty() || c.speeds.size() > 50) t.Fail("speeds", "allowed: 1 to 50 speeds");
}

/// What LQG and H-infinity share: speeds, weighed planes, the model's order.
void ReadSynthesis(const TomlTable& t, const std::vector<std::string>& planes,
                   ControllerParameters& c) {
  ReadSpeeds(t, c);
  std::set<std::string> named;  // of planes
  for (const TomlTable& k : t.Tables("plane")) {
    PlaneWeight w;
    w.at = k.String("at");
    if (std::find(planes.begin(), planes.end(), w.at) == planes.end())
      k.Fail("at", fmt::format("= \"{}\", allowed: {}", w.at, fmt::join(planes, ", ")));
    if (!named.insert(w.at).second)
      k.Fail("at", fmt::format("= \"{}\" stands twice, allowed: once", w.at));
    k.Read(w, kPlaneWeightFields);
    k.RejectUnknownKeys();
    c.planes.push_back(w);
  }
  if (const auto m = t.Table("modes")) {
    c.modes.emplace();
    m->Read(*c.modes, kModeWeightFields);
    m->RejectUnknownKeys();
  }
  if (!t.Has("model_modes")) return;
  const long long modes = t.Integer("model_modes", 0);
  if (modes < 0 || modes > 100)
    t.Fail("model_modes", fmt::format("= {}, allowed: 0 to 100", modes));
  c.model_modes = static_cast<int>(modes);
}

}  // namespace

void ReadControllerKind(const TomlTable& t, const std::vector<std::string>& axes,
                        const std::vector<std::string>& planes, ControllerParameters& c) {
  c.kind = t.Choice("kind", "pid", kControllerKinds);
  c.where = t.Where("kind");
  if (c.kind == "pid") {
    t.Read(c.pid, kPidFields);
    ReadPidExtras(t, axes, c);
  } else {
    c.pid = PidParameters{0, 0, 0, 0, kRequired};
    t.Read(c.pid, kForceLimitField);
    if (axes.empty())
      t.Fail("kind", fmt::format("= \"{}\", but every bearing has its own controller; allowed: pid",
                                 c.kind));
  }
  if (c.kind == "transfer-function") ReadTransfers(t, axes, c);
  if (c.kind == "state-space") ReadSystems(t, axes.size(), c);
  if (c.kind == "lqg") {
    t.Read(c.lqg, kLqgFields);
    ReadSynthesis(t, planes, c);
  }
  if (c.kind == "h-infinity") {
    t.Read(c.h_infinity, kHInfinityFields);
    ReadSynthesis(t, planes, c);
  }
  if (c.kind == "tilt-translation") {
    c.translation = ReadGains(t, "translation", kTranslationFields);
    c.tilt = ReadGains(t, "tilt", kTiltFields);
    t.Read(c, kTiltTranslationFields);
  }
  if (const auto u = t.Table("unbalance")) {
    UnbalanceControlParameters p;
    u->Read(p, kUnbalanceControlFields);
    u->RejectUnknownKeys();
    c.unbalance = p;
  }
}

}  // namespace ambrig
