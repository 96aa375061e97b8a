#include "simulation/verdict/drop_figures.h"

#include <algorithm>
#include <cmath>

#include "core/math/constants.h"
#include "core/record/channels.h"
#include "rig/parameters/bearing_kind.h"

namespace ambrig {

namespace {

constexpr double kWhirlRadius = 0.3;  // of the clearance; nearer to the centre an angle says little

double Radius(const CentrePath& p, std::size_t row) { return std::hypot(p.x[row], p.y[row]); }

/// Row before the first crossing of the clearance, 0 when it starts in contact, the last row when
/// there is none.
std::size_t RowBeforeTouch(const CentrePath& p) {
  if (Radius(p, 0) > p.clearance) return 0;
  for (std::size_t k = 0; k + 1 < p.x.size(); ++k)
    if (Radius(p, k) <= p.clearance && Radius(p, k + 1) > p.clearance) return k;
  return p.x.size() - 1;
}

double Rebound(const CentrePath& p, std::size_t touch) {
  std::size_t k = touch + 1;
  while (k < p.x.size() && Radius(p, k) > p.clearance) ++k;
  double least = p.clearance;
  for (; k < p.x.size() && Radius(p, k) <= p.clearance; ++k) least = std::min(least, Radius(p, k));
  return p.clearance - least;
}

double Turns(const DropPaths& paths, const CentrePath& p, std::size_t touch) {
  double sum = 0;
  for (std::size_t k = touch; k + 1 < p.x.size(); ++k) {
    if (std::min(Radius(p, k), Radius(p, k + 1)) < kWhirlRadius * p.clearance) continue;
    const double cross = p.x[k] * p.y[k + 1] - p.y[k] * p.x[k + 1];
    const double dot = p.x[k] * p.x[k + 1] + p.y[k] * p.y[k + 1];
    sum += std::atan2(cross, dot) / (2 * kPi);
  }
  return paths.Omega[touch] < 0 ? -sum : sum;
}

/// Largest centre speed after row `touch` [m/s], by central differences.
double PeakSpeed(const DropPaths& paths, const CentrePath& p, std::size_t touch) {
  double peak = 0;
  for (std::size_t k = std::max<std::size_t>(touch, 1); k + 1 < p.x.size(); ++k)
    peak = std::max(peak, std::hypot(p.x[k + 1] - p.x[k - 1], p.y[k + 1] - p.y[k - 1]));
  return peak * paths.rate / 2;
}

}  // namespace

DropPaths CentrePaths(const RigParameters& rig, const Record& record) {
  DropPaths paths;
  paths.rate = record.rate;
  paths.start = record.start;
  for (const BearingParameters& b : rig.bearings) {
    if (!b.kind->two_axes || !b.auxiliary) continue;
    const Channel* x = Find(record, {ChannelKind::kTruePosition, b.name, 0});
    const Channel* y = Find(record, {ChannelKind::kTruePosition, b.name, 1});
    Require(x && y && !x->samples.empty(), "the record has the path of the shaft's centre");
    paths.bearings.push_back({b.name, b.auxiliary->clearance, x->samples, y->samples});
  }
  if (const Channel* omega = Find(record, {ChannelKind::kSpeed})) paths.Omega = omega->samples;
  Require(!paths.Omega.empty(), "the record has the speed");
  return paths;
}

DropFigures MakeDropFigures(const RigParameters& rig, const RunResult& run,
                            const DropPaths& paths) {
  DropFigures f;
  f.touchdown = run.touchdown;
  f.drop = run.drop;
  std::size_t touch = 0, where = paths.bearings.size();
  for (std::size_t b = 0; b < paths.bearings.size(); ++b) {
    const CentrePath& p = paths.bearings[b];
    const std::size_t row = RowBeforeTouch(p);
    const std::size_t tenth = p.x.size() - std::max<std::size_t>(p.x.size() / 10, 1);
    double x = 0, y = 0;
    for (std::size_t k = tenth; k < p.x.size(); ++k) x += p.x[k], y += p.y[k];
    const auto count = static_cast<double>(p.x.size() - tenth);
    f.rest.push_back({x / count, y / count});
    if (row + 1 == p.x.size()) continue;
    const double before = Radius(p, row), after = Radius(p, row + 1);
    const double part = before < p.clearance ? (p.clearance - before) / (after - before) : 0;
    const double t = paths.TimeAt(row) + part / paths.rate;
    if (where < paths.bearings.size() && t >= f.touchdown_time) continue;
    where = b;
    touch = row;
    f.touchdown_time = t;
    f.first = p.bearing;
  }
  if (where == paths.bearings.size()) return f;
  const CentrePath& first = paths.bearings[where];
  f.rebound = Rebound(first, touch);
  f.turns = Turns(paths, first, touch);
  f.whirl = std::abs(f.turns) < 0.5 ? ContactWhirl::kNone
            : f.turns > 0           ? ContactWhirl::kForward
                                    : ContactWhirl::kBackward;
  const double Omega = std::abs(paths.Omega[touch]);
  const double g = std::hypot(rig.gravity[0], rig.gravity[1]);
  for (const CentrePath& p : paths.bearings) {
    for (std::size_t k = touch; k < p.x.size(); ++k)
      f.peak_orbit = std::max(f.peak_orbit, Radius(p, k));
    const double speed = PeakSpeed(paths, p, touch);
    if (Omega > 0) f.severity = std::max(f.severity, speed / (Omega * p.clearance));
    if (g > 0) f.fall_severity = std::max(f.fall_severity, speed / std::sqrt(2 * g * p.clearance));
  }
  return f;
}

double PartingTime(const DropPaths& a, const DropPaths& b, double share) {
  Require(a.bearings.size() == b.bearings.size() && a.rate == b.rate, "two runs of one scenario");
  double first = -1;
  for (std::size_t k = 0; k < a.bearings.size(); ++k) {
    const CentrePath &p = a.bearings[k], &q = b.bearings[k];
    for (std::size_t row = 0; row < std::min(p.x.size(), q.x.size()); ++row) {
      if (std::hypot(p.x[row] - q.x[row], p.y[row] - q.y[row]) <= share * p.clearance) continue;
      if (first < 0 || a.TimeAt(row) < first) first = a.TimeAt(row);
      break;
    }
  }
  return first;
}

const char* WhirlName(ContactWhirl whirl) {
  switch (whirl) {
    case ContactWhirl::kNone:
      return "none";
    case ContactWhirl::kForward:
      return "forward";
    case ContactWhirl::kBackward:
      return "backward";
  }
  return "";
}

}  // namespace ambrig
