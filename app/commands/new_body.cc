#include "app/commands/new_body.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "app/commands/new_case.h"
#include "app/text/screen.h"
#include "core/record/column_names.h"
#include "core/record/units.h"
#include "rig/clearance.h"
#include "rig/magnet_inverse.h"
#include "rig/rig_channels.h"
#include "rig/rig_figures.h"

namespace ambrig {

namespace {

// Mean force over weight of a body that hovers: what ten numbers of a bench miss, and what no bench
// misses.
constexpr double kSurelyCarried = 1.25, kMostCarried = 3;
constexpr std::size_t kRowsLooked = 2000;
constexpr double kSlower = 0.9;        // of the rate of commands: rows miss some
constexpr double kChanges = 0.3;       // share of rows with a new command: they change all the time
constexpr double kSameCommand = 1e-3;  // of the commands' range

/// The measured values of a channel in SI; null where it was not found in the record.
std::function<double(std::size_t row)> Measured(const Record& record,
                                                const std::vector<ColumnChoice>& all,
                                                const ChannelId& id) {
  for (const ColumnChoice& c : all) {
    if (c.channel != id.name()) continue;
    const Channel* column = FindColumn(record, c.column);
    const std::string_view si = RowOf(id.kind).unit;
    const double factor = c.gain * (c.unit.empty() ? 1 : UnitFactor(c.unit, std::string(si)));
    return [column, factor, offset = c.offset](std::size_t row) {
      return column->samples[row] * factor + offset;
    };
  }
  return nullptr;
}

/// Mean force of one bearing along its axes [N]; NaN where it cannot be told.
Eigen::Vector2d MeanForce(const BearingParameters& b, const Record& record,
                          const std::vector<ColumnChoice>& all) {
  std::vector<std::function<double(std::size_t)>> current, place;
  for (const ChannelId& id : ChannelsOf(b, ChannelKind::kCoilCurrent))
    current.push_back(Measured(record, all, id));
  for (const ChannelId& id : ChannelsOf(b, ChannelKind::kReading))
    place.push_back(Measured(record, all, id));
  const auto unknown = [](const auto& f) { return !f; };
  const Eigen::Vector2d none = Eigen::Vector2d::Constant(std::nan(""));
  if (std::ranges::any_of(current, unknown) || std::ranges::any_of(place, unknown)) return none;
  const MagnetForce force = MagnetForceOf(b);
  const double most = 0.9 * GapOf(b);
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  double count = 0;
  Eigen::VectorXd i(static_cast<Eigen::Index>(current.size()));
  for (std::size_t row = 0; row < record.rows(); row += record.rows() / kRowsLooked + 1) {
    Eigen::Vector2d at = Eigen::Vector2d::Zero();
    for (std::size_t k = 0; k < current.size(); ++k)
      i[static_cast<Eigen::Index>(k)] = current[k](row);
    for (std::size_t k = 0; k < place.size(); ++k) at[static_cast<Eigen::Index>(k)] = place[k](row);
    if (!i.allFinite() || !at.allFinite()) continue;
    if (at.norm() > most) at *= most / at.norm();
    const Eigen::VectorXd f = force(i, at);
    sum.head(f.size()) += f;
    count += 1;
  }
  return count > 0 ? Eigen::Vector2d(sum / count) : none;
}

}  // namespace

double CarriedShare(const RigParameters& rig, const Record& record,
                    const std::vector<ColumnChoice>& all) {
  const auto weight = WeightShares(rig);
  double along = 0, whole = 0;
  for (std::size_t k = 0; k < rig.bearings.size(); ++k) {
    Eigen::Vector2d w(weight[k][0], weight[k][1]);
    if (w.norm() == 0) continue;
    along += w.dot(MeanForce(rig.bearings[k], record, all));
    whole += w.squaredNorm();
  }
  return whole > 0 ? along / whole : std::nan("");
}

bool IsFree(const RigParameters& rig, const Record& record, const std::vector<ColumnChoice>& all,
            BodySaid said) {
  if (said != BodySaid::kNothing) return said == BodySaid::kFree;
  const double carried = CarriedShare(rig, record, all);
  const auto within = [carried](double factor) {
    return !(carried > factor || carried < 1 / factor);
  };
  const auto say = [](const std::string& text) { fmt::print("{}\n", Wrapped("  " + text, 4)); };
  if (within(kSurelyCarried)) {
    say(std::isnan(carried)
            ? "taken as a body that hovers: no weight to compare the measured currents with; that "
              "something holds it says --body held"
            : fmt::format("the measured currents carry {:.3g} times the weight: taken as a body "
                          "that hovers; that something holds it says --body held",
                          carried));
    return true;
  }
  if (within(kMostCarried))
    say(fmt::format(
        "in doubt: the measured currents pull with {:.3g} times the weight, where a body "
        "that hovers has 1 within what the numbers of the bench miss, and one that lies on "
        "something any; no record of its motion is made; that it hovers says --body free",
        carried));
  else
    say(fmt::format(
        "the measured currents pull with {:.3g} times the weight: the body stands on "
        "something or is held, and the record says nothing of its motion under the magnets",
        carried));
  return false;
}

namespace {

/// Share of rows with another command than the row before, of the column that changes most.
double ChangesOf(const Record& record, const std::vector<ColumnChoice>& all, ChannelKind kind) {
  double most = 0;
  for (const ColumnChoice& c : all)
    if (IsOfKind(c.channel, kind)) {
      const std::vector<double>& y = FindColumn(record, c.column)->samples;
      const auto [lo, hi] = std::minmax_element(y.begin(), y.end());
      double changes = 0;
      for (std::size_t k = 1; k < y.size(); ++k)
        changes += std::abs(y[k] - y[k - 1]) > kSameCommand * (*hi - *lo);
      most = std::max(most, changes / static_cast<double>(y.size()));
    }
  return most;
}

}  // namespace

bool LacksCommands(const RigParameters& rig, const Record& record,
                   const std::vector<ColumnChoice>& all) {
  const bool duties = DriveOf(all, rig) == CommandSource::kDuty;
  const double controller = rig.controller.rate, switching = rig.amplifier.switching_frequency;
  const bool lacks = record.rate < kSlower * controller,
             may_lack = duties && record.rate < kSlower * switching;
  if (!lacks && !may_lack) return false;
  if (ChangesOf(record, all, duties ? ChannelKind::kDuty : ChannelKind::kSetPoint) < kChanges)
    return false;
  const std::string text =
      lacks ? fmt::format(
                  "the record has {:.6g} rows a second and the controller commands {:.6g} "
                  "times a second: what it commanded between two rows is not in the record, "
                  "so that none of the coils is made; log at the controller's rate",
                  record.rate, controller)
            : fmt::format(
                  "duties that change from row to row, {:.6g} rows a second, {:.6g} switching "
                  "periods a second: where a current loop sets a duty in every period, those "
                  "between the rows are not in the record and its currents miss by far; then "
                  "log every period, or take the record of the coils out of case.toml",
                  record.rate, switching);
  fmt::print("{}\n", Wrapped("  " + text, 4));
  return lacks;
}

}  // namespace ambrig
