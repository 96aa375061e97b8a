#include "simulation/sampled/run_record.h"

#include <algorithm>
#include <cmath>

namespace ambrig {

RunRecord::RunRecord(const RigParameters& rig, const Scenario& scenario, double rate, bool clamped,
                     const RecordedPart& part, const RowSource& source)
    : values_(rig, scenario, source), samples_(rig.samples_per_period()), wanted_(part.rows) {
  record_.rate = rate > 0 ? rate : scenario.record_rate;
  const double per_period = record_.rate * (1 / rig.amplifier.switching_frequency);
  if (per_period > 1 + 1e-9)
    row_samples_ = static_cast<int>(std::lround(samples_ / per_period));
  else
    row_periods_ = static_cast<int>(std::lround(1 / per_period));
  const auto periods = static_cast<std::size_t>(part.periods);
  last_ = row_samples_ > 0
              ? periods * static_cast<std::size_t>((samples_ - 1) / row_samples_ + 1) - 1
              : (periods - 1) / static_cast<std::size_t>(row_periods_);
  const std::size_t rows =
      wanted_ ? wanted_->size() + 1
              : static_cast<std::size_t>(std::ceil(scenario.duration * record_.rate)) + 1;
  // A shaft that is held stands in load cells; its true position says nothing.
  const ChannelKind held = clamped ? ChannelKind::kLoadCell : ChannelKind::kTruePosition;
  for (const ChannelValues::Named& c : values_.Columns(
           {ChannelKind::kCoilCurrent, ChannelKind::kSetPoint, ChannelKind::kDuty, held},
           !clamped)) {
    const std::vector<std::string>& only = part.channels;
    if (!only.empty() && std::find(only.begin(), only.end(), c.id.name()) == only.end()) continue;
    record_.channels.push_back(
        {c.id.name(), std::string(c.id.row().unit), std::vector<double>(rows)});
    columns_.push_back({c.column, row_samples_ > 0 ? nullptr : values_.Place(c.column)});
  }
}

bool RunRecord::Wanted() {
  const std::size_t row = due_++;
  return row == last_ || (row_ < wanted_->size() && (*wanted_)[row_] == row);
}

void RunRecord::Row(long long n, int sample) {
  if (wanted_ && !Wanted()) return;
  if (row_ == record_.rows())
    for (Channel& c : record_.channels) c.samples.resize(row_ + 1);
  for (std::size_t k = 0; k < columns_.size(); ++k) {
    const Written& c = columns_[k];
    record_.channels[k].samples[row_] = c.place            ? *c.place
                                        : row_samples_ > 0 ? values_.InBurst(c.column, n, sample)
                                                           : values_.At(c.column, n);
  }
  ++row_;
}

Record RunRecord::Take() {
  for (Channel& c : record_.channels) c.samples.resize(row_);
  return std::move(record_);
}

}  // namespace ambrig
