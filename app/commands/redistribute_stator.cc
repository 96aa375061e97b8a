#include "app/commands/redistribute_stator.h"

#include <fmt/format.h>

#include <algorithm>

#include "app/commands/progress.h"
#include "core/math/constants.h"
#include "faulttolerance/supervision/stator_failure_map.h"
#include "rig/nominal_control.h"
#include "rig/parameters/bearing_kind.h"
#include "rig/rig_figures.h"

namespace ambrig {

namespace {

constexpr int kDirectionsOfReach = 24;
constexpr double kTrueAdded = 0.5;  // of a force beside the load
constexpr double kTrueForce = 0.05, kSmallForce = 1, kForceStep = 0.5;  // -, [N], [N]

/// Forces from the load on that a map truly gives, by the network that made neither it nor its
/// figures.
struct StatorReach {
  bool carries = false;
  double worst = 0;  // [N] from the load in the worst direction
};

/// The force of the map's set-points for `force`, by the network.
Eigen::VectorXd TrueForce(const StatorProblem& p, const CurrentMap& map,
                          const Eigen::Vector2d& force) {
  const Eigen::VectorXd set =
      map.SetPoints(force.x(), force.y()).head(p.network->coils()).cwiseProduct(p.turns_left);
  return p.network->Force(Eigen::Vector3d::Zero(), set).head(p.axes);
}

/// Whether a true force is the wanted one.
bool Gives(const Eigen::VectorXd& truly, const Eigen::Vector2d& force) {
  return (truly - force.head(truly.size())).norm() <=
         kTrueForce * std::max(force.norm(), kSmallForce);
}

/// Whether `added` to the load is truly added: within a part of its own size, which may be small
/// beside the load.
bool Adds(const Eigen::VectorXd& truly, const Eigen::VectorXd& of_load,
          const Eigen::Vector2d& added) {
  return (truly - of_load - added.head(truly.size())).norm() <= kTrueAdded * added.norm();
}

StatorReach ReachOf(const StatorProblem& p, const CurrentMap& map, const Eigen::Vector2d& load,
                    double most) {
  StatorReach out;
  const Eigen::VectorXd of_load = TrueForce(p, map, load);
  out.carries = Gives(of_load, load);
  if (!out.carries) return out;
  out.worst = kInfinity;
  const int directions = p.axes > 1 ? kDirectionsOfReach : 2;
  for (int k = 0; k < directions; ++k) {
    const double angle = 2 * kPi * k / directions;
    const Eigen::Vector2d way(std::cos(angle), p.axes > 1 ? std::sin(angle) : 0);
    double r = 0;
    while (true) {
      const Eigen::Vector2d next = load + (r + kForceStep) * way;
      if (next.cwiseAbs().maxCoeff() > most) break;
      const Eigen::VectorXd truly = TrueForce(p, map, next);
      if (!Gives(truly, next) || !Adds(truly, of_load, next - load)) break;
      r += kForceStep;
    }
    out.worst = std::min(out.worst, r);
  }
  out.carries = out.worst > 0;  // held, not only passed through
  return out;
}

std::string SetName(const std::vector<int>& set) {
  std::string text;
  for (const int coil : set) text += (text.empty() ? "" : ",") + std::to_string(coil);
  return text;
}

nlohmann::json JsonOfSet(const StatorProblem& p, const CurrentMap& map, const std::string& cls,
                         const std::vector<int>& set, const StatorReach& reach) {
  const Eigen::MatrixXd W = map.W.topRows(p.network->coils());
  const StatorDistribution d = DescribeStator(p, SolvabilityClass::kNone, W);
  nlohmann::json item = {{"failed", set},
                         {"class", ToText(ClassifyStator(p))},
                         {"map", cls},
                         {"residual", d.residual},
                         {"rho", d.rho},
                         {"unipolar", p.unipolar && d.rho > 0},
                         {"force", {{"carries", reach.carries}, {"worst", reach.worst}}}};
  item["W"] = nlohmann::json::array();
  for (Eigen::Index j = 0; j < W.rows(); ++j) item["W"].push_back({W(j, 0), W(j, 1), W(j, 2)});
  return item;
}

}  // namespace

std::vector<std::vector<int>> FailureSetsOf(int coils) {
  std::vector<std::vector<int>> sets;
  for (int mask = 1; mask < 1 << coils; ++mask) {
    std::vector<int> set;
    for (int j = 0; j < coils; ++j)
      if (mask >> j & 1) set.push_back(j + 1);
    sets.push_back(set);
  }
  std::stable_sort(sets.begin(), sets.end(),
                   [](const auto& a, const auto& b) { return a.size() < b.size(); });
  return sets;
}

int RedistributeStator(const NominalRig& rig, std::size_t bearing,
                       const std::vector<std::vector<int>>& sets, const CommonOptions& common) {
  const BearingParameters& b = rig->bearings[bearing];
  if (!common.html.empty())
    throw InputError(
        fmt::format("--html = {}: bearing {} is of kind \"{}\", allowed with: radial "
                    "bearings (its page draws eight poles)",
                    common.html, b.name, b.kind->name));
  const CurrentMap healthy = MakeBearingControl(rig, bearing).map;
  const auto network = b.kind->stator(b).network;
  const int axes = b.kind->two_axes ? 2 : 1;
  const auto share = WeightShares(*rig)[bearing];
  const Eigen::Vector2d load(share[0], axes > 1 ? share[1] : 0);
  const double most = PidOf(*rig, b).f_max;
  nlohmann::json json = {{"bearing", b.name},
                         {"k", healthy.k},
                         {"c0", healthy.c0},
                         {"load", {load.x(), load.y()}},
                         {"sets", nlohmann::json::array()}};
  fmt::print("{}: bearing {}, {} poles, {} coils; k = {:.4g} N/A2, c0 = {:.4g} A\n", rig->file,
             b.name, network->poles(), network->coils(), healthy.k, healthy.c0);
  fmt::print("{:<13} {:<25} {:>9} {:>6} {:>8} {:>11}\n", "coils lost", "map", "equations", "rho",
             "carries", "worst");
  Progress progress("redistribute");
  for (std::size_t n = 0; n < sets.size(); ++n) {
    if (interrupted) throw Interrupted();
    CoilVector left = CoilVector::Ones();
    for (const int coil : sets[n]) left[coil - 1] = 0;
    StatorProblem p = StatorProblemOf(network, axes, healthy, left, load);
    CurrentMap map = healthy;
    const std::string cls = StatorMapAfterFailure(p, true, &map);
    // Without a map nothing is redistributed, and what is left in it carries nobody.
    const bool none = cls == ToText(SolvabilityClass::kNone);
    const StatorReach reach = none ? StatorReach{} : ReachOf(p, map, load, most);
    if (!cls.ends_with("load")) p.load.setZero();
    json["sets"].push_back(JsonOfSet(p, map, cls, sets[n], reach));
    const auto& item = json["sets"].back();
    progress.Clear();
    fmt::print("{:<13} {:<25} {:>9.1e} {:>6.3f} {:>8} {:>9.1f} N\n", SetName(sets[n]), cls,
               item["residual"].get<double>(), item["rho"].get<double>(),
               reach.carries ? "yes" : "no", reach.worst);
    progress.Update(static_cast<double>(n + 1) / static_cast<double>(sets.size()), "");
  }
  progress.Clear();
  if (sets.size() == 1)
    for (const auto& row : json["sets"][0]["W"])
      fmt::print("  {:>10.6f} {:>10.6f} {:>10.6f}\n", row[0].get<double>(), row[1].get<double>(),
                 row[2].get<double>());
  fmt::print(
      "map: with currents within range; equations: largest error of those that make\n"
      "F = k c0 v, over k/2; rho: currents within range on |v| <= rho c0 (about the load:\n"
      "on |v - v_load|); carries: the weight and a force more in every direction; worst:\n"
      "that force, the true one, in the worst direction.\n");
  common.WriteJson(json);
  return 0;
}

}  // namespace ambrig
