/// kind = "state-space": one system of all axes, or one at each of several speeds.
#include <fmt/format.h>

#include <cmath>

#include "control/kinds/read_system.h"
#include "control/position/state_space_controller.h"
#include "core/base/toml_checked.h"

namespace ambrig {

namespace {

Eigen::MatrixXd MatrixOf(const TomlTable& t, const char* key, Eigen::Index rows,
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
  s.A = MatrixOf(t, "A", n, n);
  s.B = MatrixOf(t, "B", n, p);
  s.C = n > 0 ? MatrixOf(t, "C", p, n) : Eigen::MatrixXd(p, 0);
  s.D = t.Has("D") ? MatrixOf(t, "D", p, p) : Eigen::MatrixXd::Zero(p, p);
  if (n == 0 && !t.Has("D")) t.Fail("D", "is missing, allowed: A, B, C and D, or D alone");
  return SampledSystem(t, s, rate, "z");
}

StateSpace ReadSystem(const TomlTable& t, std::size_t axes, double rate) {
  if (!t.Has("file")) return MatricesOf(t, axes, rate);
  for (const char* key : {"A", "B", "C", "D"})
    if (t.Has(key)) t.Fail(key, "is given beside file, allowed: one of both");
  const TomlTable inner = TomlTable::FromFile(ExistingFile(t, "file"));
  const StateSpace s = MatricesOf(inner, axes, rate);
  inner.RejectUnknownKeys();
  return s;
}

void ReadStateSpace(const TomlTable& t, const ControllerNames& names, ControllerParameters& c) {
  const std::size_t axes = names.axes.size();
  const auto points = t.Tables("point");
  if (points.empty()) {
    c.systems.push_back({0, ReadSystem(t, axes, c.rate)});
    return;
  }
  double before = -1;
  for (const TomlTable& p : points) {
    SystemPoint s{Within(p, "speed", kRequired, {"rad/s", 0, 1e5, "of the rotor"}),
                  ReadSystem(p, axes, c.rate)};
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

std::unique_ptr<PositionController> MakeStateSpace(const ControllerParameters& c,
                                                   const ControllerSite& site) {
  std::vector<double> speeds;
  std::vector<StateSpace> points;
  for (const SystemPoint& s : c.systems) {
    speeds.push_back(s.speed);
    points.push_back(s.system);
  }
  return std::make_unique<StateSpaceController>(speeds, points, site.f_max);
}

}  // namespace

const ControllerKind& StateSpaceKind() {
  static constexpr ControllerKind kind{
      .name = "state-space",
      .doc = "a system of all axes, over the speed",
      .read = ReadStateSpace,
      .make = MakeStateSpace,
  };
  return kind;
}

}  // namespace ambrig
