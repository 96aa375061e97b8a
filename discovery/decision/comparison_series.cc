#include "discovery/decision/comparison_series.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

namespace ambrig {
namespace {

/// The data file's stem as a name of a group: no dot, no slash, none twice.
std::string GroupName(const std::string& data_file,
                      const std::vector<std::pair<std::string, Record>>& before) {
  std::string stem = std::filesystem::path(data_file).stem().string();
  std::replace(stem.begin(), stem.end(), '.', '_');
  std::string name = stem;
  const auto taken = [&] {
    return std::any_of(before.begin(), before.end(),
                       [&](const auto& b) { return b.first == name; });
  };
  for (int k = 2; taken(); ++k) name = stem + "_" + std::to_string(k);
  return name;
}

void AddChannels(const CaseModel& model, const Comparison& comparison, const Target& t,
                 const Channel& channel, Record& out) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::size_t rows = channel.samples.size();
  Channel measured{channel.name + ".measured", channel.unit, channel.samples};
  Channel predicted{channel.name + ".model", channel.unit, std::vector<double>(rows, nan)};
  Channel error{channel.name + ".error", "-", std::vector<double>(rows, nan)};
  for (std::size_t row = t.first; row < t.first + t.count; ++row) {
    const std::size_t sample = model.sample(row);
    if (sample >= rows) continue;
    predicted.samples[sample] = comparison.predicted[row];
    if (model.ok()[row]) error.samples[sample] = comparison.residual[row];
  }
  out.channels.push_back(std::move(measured));
  out.channels.push_back(std::move(predicted));
  out.channels.push_back(std::move(error));
}

}  // namespace

std::vector<std::pair<std::string, Record>> ComparisonSeries(const CaseModel& model,
                                                             const Comparison& comparison) {
  std::vector<std::pair<std::string, Record>> all;
  const std::vector<CaseRecord>& records = model.data().records;
  for (std::size_t r = 0; r < records.size(); ++r) {
    const CaseRecord& record = records[r];
    if (!OverTime(record)) continue;
    Record out;
    out.rate = record.data.rate;
    out.start = record.data.start;
    for (const Target& t : model.targets())
      if (t.record == r) AddChannels(model, comparison, t, record.data.channels[t.channel], out);
    if (!out.channels.empty()) all.emplace_back(GroupName(record.data_file, all), std::move(out));
  }
  return all;
}

}  // namespace ambrig
