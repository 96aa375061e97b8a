#include "discovery/model/point_floor.h"

#include <algorithm>
#include <cmath>

#include "discovery/data/noise_estimate.h"

namespace ambrig {

namespace {

constexpr double kLeastSeen = 1e-4;  // over magnitude, or over the table's largest value
constexpr double kUsual = 0.01;      // where there are too few points to tell

double WhitePart(const CaseModel& model, const Target& t, const std::vector<double>& predicted) {
  std::vector<double> error(t.count);
  for (std::size_t k = 0; k < t.count; ++k)
    error[k] = model.measured()[t.first + k] - predicted[t.first + k];
  return WhiteNoiseOf(error.data(), model.ok().data() + t.first, t.count);
}

}  // namespace

double PointFloor(const CaseModel& model, std::size_t target,
                  const std::vector<double>& predicted) {
  const Target& t = model.targets()[target];
  const CaseRecord& r = model.data().records[t.record];
  const bool response = r.kind == RecordKind::kFrf;
  if (response ? r.responses.responses[t.channel / 2].sd_known : r.table.sd_known[t.channel] != 0)
    return 1;
  double square = 0, parts = 0;
  for (const Target& other : model.targets()) {
    const bool same = other.record == t.record &&
                      (response ? other.channel / 2 == t.channel / 2 : other.channel == t.channel);
    if (!same) continue;
    const double white = WhitePart(model, other, predicted);
    if (std::isfinite(white)) square += white * white, parts += 1;
  }
  return parts > 0 ? std::max(kLeastSeen, std::sqrt(square / parts)) : kUsual;
}

}  // namespace ambrig
