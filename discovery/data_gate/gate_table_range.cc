// Static tables: single readings, or currents that were set, that cannot be.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "discovery/data/noise_estimate.h"
#include "discovery/data_gate/gate_columns.h"
#include "discovery/data_gate/gate_points.h"

namespace ambrig {

namespace {

constexpr double kBeyondRange = 4;  // times the largest value that a channel can show
constexpr double kBeyondReadings =
    200;  // times what the model expects at most, and the others show

/// A table has no times that a case could leave out: the row is named.
void TellRow(const CaseRecord& r, const std::string& column, std::size_t row,
             std::vector<DataFault>& out) {
  DataFault f;
  f.record = r.data_file;
  f.channel = column;
  f.fault = "range";
  f.with = fmt::format("row {}", row + 1);
  f.probability = 0.999;
  out.push_back(f);
}

/// The rows of an output that are far beyond the others and beyond all that the model expects,
/// where they are few.
std::vector<std::size_t> FarRows(const CaseModel& model, const std::vector<double>& predicted,
                                 const Target& t, const StaticTable& table) {
  constexpr double kFew = 0.05;  // of the rows; more: the column's unit is wrong
  const std::vector<double>& y = table.outputs[t.channel].samples;
  std::vector<double> sizes;
  double most = 0;
  for (std::size_t k = 0; k < t.count; ++k) {
    const std::size_t row = model.sample(t.first + k);
    if (!std::isfinite(y[row])) continue;
    sizes.push_back(std::abs(y[row]));
    if (const double p = predicted[t.first + k] * table.sd[t.channel][row]; std::isfinite(p))
      most = std::max(most, std::abs(p));
  }
  std::vector<std::size_t> far;
  if (sizes.empty()) return far;
  most = std::max(most, MedianOf(sizes));
  for (std::size_t row = 0; row < y.size(); ++row)
    if (std::abs(y[row]) > kBeyondReadings * most) far.push_back(row);
  if (far.size() > 1 && static_cast<double>(far.size()) > kFew * static_cast<double>(sizes.size()))
    far.clear();
  return far;
}

}  // namespace

void CheckTableRange(const CaseModel& model, const std::vector<double>& predicted,
                     std::size_t record, std::vector<DataFault>& out) {
  const CaseRecord& r = model.data().records[record];
  for (const Channel& in : r.table.inputs) {
    const double most = kBeyondRange * LimitOf(model.data().rig, in.name);
    const auto far = std::ranges::find_if(in.samples, [&](double v) { return std::abs(v) > most; });
    if (far != in.samples.end())
      TellRow(r, in.name, static_cast<std::size_t>(far - in.samples.begin()), out);
  }
  for (const Target& t : model.targets()) {
    if (t.record != record) continue;
    for (const std::size_t row : FarRows(model, predicted, t, r.table))
      TellRow(r, r.table.outputs[t.channel].name, row, out);
  }
}

}  // namespace ambrig
