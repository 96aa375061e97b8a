#include "discovery/decision/compare.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "discovery/data_gate/lonely_rows.h"
#include "discovery/data_gate/start_current.h"
#include "discovery/model/block_ratios.h"
#include "discovery/model/floor.h"
#include "discovery/search/screen.h"
#include "simulation/switching/lost_rotor.h"

namespace ambrig {

namespace {

ChannelError ErrorOf(const CaseModel& model, const std::vector<double>& residual, const Target& t) {
  ChannelError e;
  e.channel = model.data().records[t.record].data.channels[t.channel].name;
  e.ratio = TargetRatio(model, residual, t);
  e.noise = t.floor;
  e.rms_error = e.ratio * t.floor;
  e.nrmse = t.full_scale > 0 ? e.rms_error / t.full_scale : std::nan("");
  double product = 0, square = 0;
  for (std::size_t k = t.first; k + 1 < t.first + t.count; ++k) {
    product += residual[k] * residual[k + 1];
    square += residual[k] * residual[k];
  }
  e.whiteness = square > 0 ? product / square : 0;
  return e;
}

std::vector<std::string> Words(const Comparison& c) {
  struct Place {
    std::string text;
    double ratio;
  };
  std::vector<Place> places;
  for (const RecordComparison& r : c.records) {
    for (const ChannelError& e : r.channels)
      if (e.ratio > 1.15)
        places.push_back({fmt::format("{} in {} ({}): {:.1f} times the noise", e.channel, r.data,
                                      r.scenario, e.ratio),
                          e.ratio});
    for (const auto& [block, ratio] : r.blocks)
      if (ratio > 1.15)
        places.push_back({fmt::format("block {} in {} ({}): {:.1f} times its own noise", block,
                                      r.data, r.scenario, ratio),
                          ratio});
  }
  std::stable_sort(places.begin(), places.end(),
                   [](const Place& a, const Place& b) { return a.ratio > b.ratio; });
  std::vector<std::string> out;
  for (std::size_t k = 0; k < places.size() && k < 8; ++k) out.push_back(places[k].text);
  if (out.empty())
    out.push_back(std::isfinite(c.ratio)
                      ? "model and measurement agree within the noise everywhere"
                      : "nothing is compared: every channel of every record was left out");
  return out;
}

/// A record in its channels; those of which no row counts are told in `words`.
RecordComparison RecordBeside(const CaseModel& model, const std::vector<double>& residual,
                              std::size_t r, std::vector<std::string>& words) {
  const CaseRecord& record = model.data().records[r];
  RecordComparison out;
  out.data = record.data_file;
  out.scenario = record.scenario.name;
  out.validate = record.validate;
  out.test = record.test;
  double sum = 0;
  for (const Target& t : model.targets()) {
    if (t.record != r) continue;
    if (CountedRows(model, t) == 0) {
      words.push_back(fmt::format("{} in {}: no row of it counts, it is not compared",
                                  record.data.channels[t.channel].name, record.data_file));
      continue;
    }
    out.channels.push_back(ErrorOf(model, residual, t));
    sum += out.channels.back().ratio * out.channels.back().ratio;
  }
  const auto n = static_cast<double>(out.channels.size());
  out.ratio = n > 0 ? std::sqrt(sum / n) : std::nan("");
  return out;
}

/// The blocks of a record. Noise that wrong data seem to show may throw the rotor of the comparison
/// with it: then none.
BlockErrors BlocksBeside(const CaseModel& model, const Hypothesis& h, std::size_t r,
                         std::vector<std::string>& words) {
  try {
    return BlockRatios(model, h, r);
  } catch (const LostRotor&) {
    words.push_back(model.data().records[r].data_file +
                    ": its blocks are not compared, the model with this noise loses its rotor");
    return {};
  }
}

}  // namespace

Comparison Compare(CaseModel& model, const Hypothesis& h, bool blocks,
                   const std::function<void(double, const std::string&)>& progress) {
  Comparison c;
  if (progress) progress(0.05, "noise floor");
  const std::vector<std::string> lost = model.LimitToHeld(h);
  RequireCountedRows(model);
  c.unpredictable = FindFloor(model, h).unpredictable;
  std::vector<double> stated;
  for (const Target& t : model.targets()) stated.push_back(t.floor);
  c.noise = EstimateNoise(model, h);
  model.noise_model = c.noise;
  const NoiseFloor floor = FindFloor(model, h);
  const std::vector<UnstatedStart> starts = UnstatedStartsOf(model, floor.clean);
  const std::vector<SampleSpan> begun = SpansOf(model, starts);
  model.LeaveOut(begun);
  c.unpredictable.insert(c.unpredictable.end(), begun.begin(), begun.end());
  c.data = InspectDataBelow(model, floor.clean, h, stated);
  const std::vector<LonelyRow> lonely = LonelyRowsOf(model, floor.clean);
  const std::vector<SampleSpan> alone = SpansOf(lonely);
  model.LeaveOut(alone);
  c.unpredictable.insert(c.unpredictable.end(), alone.begin(), alone.end());
  if (c.data.empty()) RequireCountedRows(model);
  c.unpredictable.insert(c.unpredictable.end(), floor.unpredictable.begin(),
                         floor.unpredictable.end());
  c.predicted = floor.clean;
  c.effective_sample_size = floor.effective_sample_size;
  c.residual = Residual(model, c.predicted);
  c.ratio = KnownRatio(model, c.residual, Which::kAll);
  c.ratio_fit = KnownRatio(model, c.residual, Which::kFit);
  c.ratio_validate = KnownRatio(model, c.residual, Which::kValidate);
  c.words = lost;
  for (std::size_t r = 0; r < model.data().records.size(); ++r) {
    const CaseRecord& record = model.data().records[r];
    if (progress)
      progress(
          0.3 + 0.7 * static_cast<double>(r) / static_cast<double>(model.data().records.size()),
          "blocks of " + record.data_file);
    RecordComparison out = RecordBeside(model, c.residual, r, c.words);
    if (blocks) out.blocks = BlocksBeside(model, h, r, c.words);
    c.records.push_back(std::move(out));
  }
  for (const DataFault& f : c.data) c.words.push_back("data: " + FaultText(f));
  c.left_out = LonelyRemarks(model.data(), lonely);
  c.words.insert(c.words.end(), c.left_out.begin(), c.left_out.end());
  for (const std::string& line : StartRemarks(model.data(), starts)) c.words.push_back(line);
  for (const std::string& line : NoiseRemarks(c.noise)) c.words.push_back(line);
  for (const std::string& line : Words(c)) c.words.push_back(line);
  return c;
}

}  // namespace ambrig
