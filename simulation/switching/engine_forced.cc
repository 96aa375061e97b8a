/// Teacher-forced coils: measured set-points and measured readings drive the amplifiers and the
/// gaps, so that an error of the coil block shows where it arises. Discovery compares its currents.
///
/// Teacher-forced rotor: measured currents in gaps that follow the measured readings give
/// the forces; the rotor moves under them. What was measured pulls it along, or it would drift away
/// on the first error:
///
///   q' = v + 2 ζ ω K e,  v' = M⁻¹ Q + ω² K e,   e = measured - predicted reading
///
/// with K: displacements from readings, ω of `observer` and ζ = 0.7. A force error ΔF shows as
/// e = ΔF/(m (s² + 2 ζ ω s + ω²)).
#include <algorithm>
#include <cmath>

#include "core/math/constants.h"
#include "core/math/linear_equations.h"
#include "core/record/channels.h"
#include "rig/parameters/bearing_kind.h"
#include "simulation/switching/bearing_run.h"
#include "simulation/switching/switching_engine.h"

namespace ambrig {

namespace {
constexpr double kDrivenWarmUp = 0.01;  // [s] before t = 0
constexpr double kObserverDamping = 0.7;
constexpr double kFirstSlope = 2e-3;  // [s] over which the first velocity is read

double At(const Record& record, const Channel* c, double t) {
  if (!c || c->samples.empty()) return 0;
  const double row =
      std::clamp((t - record.start) * record.rate, 0.0, static_cast<double>(c->samples.size() - 1));
  const auto k = static_cast<std::size_t>(row);
  const std::size_t next = std::min(k + 1, c->samples.size() - 1);
  return c->samples[k] + (row - static_cast<double>(k)) * (c->samples[next] - c->samples[k]);
}
}  // namespace

void SwitchingEngine::StartForced() {
  if (CurrentsAreForced()) return StartForcedRotor();
  using Source = CurrentLoops::SetPoints;
  const Record& d = *options_.forced;
  const bool measured = std::ranges::any_of(
      d.channels, [](const Channel& c) { return IsOfKind(c.name, ChannelKind::kSetPoint); });
  // Set-points of a clamped run hold the coils' excitations already; where none were measured the
  // scenario's currents and duties drive.
  const Source source = scenario_.start != StartState::kClamped ? Source::kMeasured
                        : measured                              ? Source::kMeasuredWhole
                                                                : Source::kOfTheScenario;
  loop_.PrepareDriven(source, kDrivenWarmUp);
  if (source == Source::kOfTheScenario)
    for (const CommandPlan::Signal& s : loop_.commands().current)
      loop_.control[static_cast<std::size_t>(s.bearing)].set_point[s.index] +=
          CommandPlan::At(s, 0);
  FollowData(-loop_.warm);
  loop_.StartDriven();
}

void SwitchingEngine::StartForcedRotor() {
  loop_.PrepareDriven(CurrentLoops::SetPoints::kMeasured, 0);
  loop_.clamped = false;
  const Record& d = *options_.forced;
  const auto dof = static_cast<std::size_t>(plant_.rotor.dof());
  std::vector<Eigen::RowVectorXd> rows;
  std::vector<double> now, later;
  for (const SampledBearing& b : loop_.bearings) {
    const BearingParameters& p = loop_.rig.bearings[b.index];
    const std::vector<std::string> axes = p.Axes();
    for (std::size_t side = 0; side < axes.size(); ++side) {
      Eigen::RowVectorXd row(static_cast<Eigen::Index>(dof));
      DofVector unit{};
      for (std::size_t k = 0; k < dof; ++k) {
        unit[k] = 1;
        row[static_cast<Eigen::Index>(k)] =
            side == 0 ? b.plant->sensor.map.X(unit) : b.plant->sensor.map.Y(unit);
        unit[k] = 0;
      }
      rows.push_back(row);
      const Channel* c = d.Find(axes[side]);
      now.push_back(At(d, c, 0));
      later.push_back(At(d, c, kFirstSlope));
    }
  }
  Eigen::MatrixXd readings(static_cast<Eigen::Index>(rows.size()), static_cast<Eigen::Index>(dof));
  for (std::size_t k = 0; k < rows.size(); ++k)
    readings.row(static_cast<Eigen::Index>(k)) = rows[k];
  observed_ = PseudoinverseOf(readings);
  const auto count = static_cast<Eigen::Index>(rows.size());
  const Eigen::VectorXd at = Eigen::Map<Eigen::VectorXd>(now.data(), count),
                        next = Eigen::Map<Eigen::VectorXd>(later.data(), count);
  const Eigen::VectorXd q = observed_ * at, v = observed_ * (next - at) / kFirstSlope;
  for (std::size_t k = 0; k < dof; ++k) {
    motion_.q[k] = q[static_cast<Eigen::Index>(k)];
    motion_.v[k] = v[static_cast<Eigen::Index>(k)];
  }
  FollowData(0);
  loop_.StartDriven();
}

void SwitchingEngine::Observe() {
  const Record& d = *options_.forced;
  Eigen::VectorXd e(observed_.cols());
  Eigen::Index k = 0;
  for (const SampledBearing& b : loop_.bearings) {
    const std::vector<std::string> axes = loop_.rig.bearings[b.index].Axes();
    for (std::size_t side = 0; side < axes.size(); ++side, ++k)
      e[k] = At(d, d.Find(axes[side]), motion_.t) - b.plant->sensor.reading[side];
  }
  const Eigen::VectorXd pull = observed_ * e;
  const double omega = 2 * kPi * options_.observer;
  for (Eigen::Index n = 0; n < pull.size(); ++n) {
    const auto at = static_cast<std::size_t>(n);
    motion_.q[at] += T_ * 2 * kObserverDamping * omega * pull[n];
    motion_.v[at] += T_ * omega * omega * pull[n];
  }
}

void SwitchingEngine::RunForcedCurrents(long long n) {
  const Record& d = *options_.forced;
  // A row holds the mean of the period before it.
  const double after = static_cast<double>(n + 1) * T_, middle = after - 0.5 * T_;
  for (BearingRun& b : bearings_) {
    StatorLanes& lanes = b.plant->lanes;
    Lane current;
    for (int j = 0; j < lanes.coils; ++j)
      current[j] = At(d, Find(d, {ChannelKind::kCoilCurrent, b.plant->name, j}), after);
    double x = 0, y = 0;
    ForcedPosition(*b.side, middle, &x, &y);
    x -= b.plant->offset_x;
    y -= b.plant->offset_y;
    lanes.Settle(current, x, y);
    b.side->fx_before = b.side->fx;
    b.side->fy_before = b.side->fy;
    lanes.Force(x, y, &b.side->fx, &b.side->fy);
    for (int k = 0; k < loop_.samples * options_.substeps; ++k) lanes.samples[k] = current;
    ForcedPosition(*b.side, after, &b.x_next, &b.y_next);
    b.x_next -= b.plant->offset_x;
    b.y_next -= b.plant->offset_y;
  }
}

void SwitchingEngine::ForcedPosition(const SampledBearing& b, double t, double* x,
                                     double* y) const {
  const Record& d = *options_.forced;
  double reading[4], z[2];
  std::size_t found = 0;
  for (const BearingParameters& p : loop_.nominal->bearings) {
    if (!p.kind->two_axes || found > 1) continue;
    z[found] = p.sensor.z;
    reading[2 * found] = At(d, Find(d, {ChannelKind::kReading, p.name, 0}), t);
    reading[2 * found + 1] = At(d, Find(d, {ChannelKind::kReading, p.name, 1}), t);
    ++found;
  }
  if (b.plant->thrust) {
    *x = At(d, Find(d, {ChannelKind::kReading, "", 2}), t);
    *y = 0;
  } else if (found == 2) {  // rigid shaft between the two sensor planes
    const double w = (b.plant->z - z[0]) / (z[1] - z[0]);
    *x = (1 - w) * reading[0] + w * reading[2];
    *y = (1 - w) * reading[1] + w * reading[3];
  } else {
    *x = At(d, Find(d, {ChannelKind::kReading, b.plant->name, 0}), t);
    *y = 0;
  }
}

void SwitchingEngine::FollowData(long long n) {
  const Record& d = *options_.forced;
  const double t = std::max(0.0, static_cast<double>(n) * T_);
  const auto row =
      static_cast<std::size_t>(std::max(0.0, std::floor((t - d.start) * d.rate + 1e-6)));
  for (BearingRun& b : bearings_) {
    BearingControl& c = loop_.control[b.side->index];
    for (int j = 0; j < c.coils; ++j) {
      const Channel* s =
          Find(d, {CurrentsAreForced() ? ChannelKind::kCoilCurrent : ChannelKind::kSetPoint,
                   b.plant->name, j});
      if (s && !s->samples.empty())
        c.set_point[j] = s->samples[std::min(row, s->samples.size() - 1)];
    }
    c.commanded = c.set_point;
    PlanePoint p;
    ForcedPosition(*b.side, static_cast<double>(n) * T_, &p.x, &p.y);
    b.MoveTo(p);
  }
}

}  // namespace ambrig
