#include "discovery/model/case_model.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "discovery/model/in_parallel.h"
#include "discovery/model/record_order.h"
#include "discovery/model/record_rows.h"
#include "discovery/model/record_traits.h"
#include "rig/rig_assembly.h"
#include "simulation/switching/lost_rotor.h"
#include "simulation/switching/switching_engine.h"

namespace ambrig {

namespace {

constexpr double kBeforeLoss = 0.015;  // [s] between the last row that counts and the loss
constexpr double kLeastHeld = 0.05;    // [s] of a record that are worth comparing
constexpr double kCoarseSamples = 6;   // of the current, in a switching period

}  // namespace

CaseModel::CaseModel(const Case& c, std::size_t thin)
    : CaseModel(c, std::vector<std::size_t>(c.records.size(), thin)) {}

CaseModel::CaseModel(const Case& c, const std::vector<std::size_t>& thin)
    : noise_model(StatedNoise(c.rig, c.noise)), case_(c) {
  for (std::size_t r = 0; r < c.records.size(); ++r) {
    const CaseRecord& record = c.records[r];
    predictors_.push_back(MakePredictor(c, record));
    driving_.push_back(record.imposed != Imposed::kNothing ? DrivingRecord(c.rig, record)
                                                           : Record{});
    const bool points = !OverTime(record);
    plans_.push_back(points ? nullptr : std::make_unique<CommandPlan>(c.rig, record.scenario));
    for (std::size_t ch = 0; ch < record.data.channels.size(); ++ch) {
      const Channel& channel = record.data.channels[ch];
      if (!record.quality[ch].use || (!points && !IsPredicted(record, channel.name))) continue;
      Target t;
      t.record = r;
      t.channel = ch;
      t.first = measured_.size();
      double mean = 0, square = 0, n = 0;
      const std::size_t every = points ? 1 : thin[r];
      for (std::size_t block = 0; block * every < channel.samples.size(); ++block) {
        const std::size_t k = block * every + block % every;
        if (k >= channel.samples.size()) break;
        sample_.push_back(k);
        measured_.push_back(std::isfinite(channel.samples[k]) ? channel.samples[k] : 0);
        ok_.push_back(record.quality[ch].ok[k] &&
                      (points || HasSettled(record, record.data.TimeAt(k))));
        if (!ok_.back()) continue;
        mean += channel.samples[k];
        square += channel.samples[k] * channel.samples[k];
        n += 1;
      }
      t.count = measured_.size() - t.first;
      if (n > 0) t.full_scale = std::sqrt(std::max(0.0, square / n - mean * mean / n / n));
      targets_.push_back(t);
    }
    touches_.push_back(
        !points && record.imposed == Imposed::kNothing && Touches(c.rig, record) ? 1 : 0);
  }
  order_ = LongestFirst(c, touches_);
  sound_ = ok_;
  horizon_.assign(c.records.size(), kInfinity);
}

void CaseModel::ApplyHorizons() {
  memo_.Clear();
  ok_ = sound_;
  for (const Target& t : targets_) {
    const Record& data = case_.records[t.record].data;
    for (std::size_t k = t.first; k < t.first + t.count; ++k)
      if (data.TimeAt(sample_[k]) >= horizon_[t.record]) ok_[k] = 0;
  }
}

std::vector<std::string> CaseModel::LimitToHeld(const Hypothesis& h) {
  std::vector<std::string> lines;
  std::vector<double> found(case_.records.size(), kInfinity);
  horizon_ = found;
  InParallel(found.size(), [&](std::size_t r) {
    try {
      std::vector<std::vector<double>> ignored;
      if (!predictors_[r])
        Simulated(h, r, false, 1);
      else if (!predictors_[r]->Predict(h.rig, ignored))
        found[r] = 0;
    } catch (const LostRotor& lost) {
      found[r] = std::max(0.0, lost.time - kBeforeLoss);
    } catch (const std::runtime_error& e) {
      if (dynamic_cast<const Interrupted*>(&e) || dynamic_cast<const InputError*>(&e)) throw;
      found[r] = 0;
    }
  });
  horizon_ = found;
  for (std::size_t r = 0; r < found.size(); ++r) {
    const CaseRecord& record = case_.records[r];
    if (found[r] == kInfinity) continue;
    if (found[r] < record.data.start + kLeastHeld) horizon_[r] = 0;
    lines.push_back(
        horizon_[r] == 0
            ? record.data_file + ": the model does not hold its rotor here; the record is left out"
            : fmt::format("{}: the model does not hold its rotor beyond {:.3g} s; compared up to "
                          "there",
                          record.data_file, horizon_[r]));
  }
  ApplyHorizons();
  if (std::ranges::all_of(horizon_, [](double t) { return t == 0; }))
    throw InputError(fmt::format(
        "{}: the model does not hold its rotor in any record, allowed: a rig file that levitates "
        "in the records' scenarios (ambrig run {})",
        case_.rig_file, case_.records.empty() ? "" : case_.records.front().scenario_file));
  return lines;
}

void CaseModel::LimitAs(const CaseModel& other) {
  horizon_ = other.horizon_;
  ApplyHorizons();
}

void CaseModel::LeaveOut(const std::vector<SampleSpan>& spans) {
  for (const SampleSpan& span : spans)
    for (const Target& t : targets_)
      for (std::size_t k = t.first; t.record == span.record && k < t.first + t.count; ++k)
        if (span.first <= sample_[k] && sample_[k] <= span.last) sound_[k] = ok_[k] = 0;
}

void CaseModel::SetSound(std::vector<char> rows) {
  Require(rows.size() == ok_.size(), "a flag for each row");
  sound_ = std::move(rows);
  ApplyHorizons();
}

Record CaseModel::Simulated(const Hypothesis& h, std::size_t record, bool noise, std::uint64_t seed,
                            const std::vector<std::string>& channels,
                            const std::vector<std::size_t>* rows) const {
  const CaseRecord& r = case_.records[record];
  Require(plans_[record] != nullptr, "a record over time");
  Scenario scenario = r.scenario;
  scenario.noise = noise;
  scenario.seed = seed;
  EngineOptions options;
  // Every coil as drawn, but in another unit of this type, which differs as the rig file states.
  options.coil_spread = h.rig.amplifier.unit != case_.rig.amplifier.unit;
  options.commands = plans_[record].get();
  options.record_rate = SimulationRateFor(h.rig, r.data);
  options.recorded_channels = channels;
  options.recorded_rows = rows;
  options.watch = false;
  RigParameters drawing = case_.rig;
  drawing.amplifier.adc_samples_per_period = h.rig.amplifier.adc_samples_per_period;
  const NominalRig nominal(drawing);
  options.nominal = &nominal;
  scenario.duration = std::min(scenario.duration, std::max(horizon_[record], 1 / r.data.rate));
  // A hypothesis that drops a rotor which the measured rig held is no explanation; do not watch it
  // bounce.
  if (r.scenario.start == StartState::kLevitated && r.scenario.faults.empty() && !touches_[record])
    options.lost_after = 0.01;
  Record again;  // what a second measurement would have driven with
  if (r.imposed != Imposed::kNothing) {
    if (noise) again = WithReadingNoise(driving_[record], h.rig, seed);
    options.forced = noise ? &again : &driving_[record];
    if (r.imposed == Imposed::kCurrents) options.observer = r.observer;
  }
  options.stop = stop;
  ++runs;
  return SwitchingEngine(h.rig, scenario, options).Run().record;
}

std::optional<Record> CaseModel::SimulatedChannels(const Hypothesis& h, std::size_t record,
                                                   bool noise, std::uint64_t seed,
                                                   const std::vector<std::size_t>* rows) const {
  std::vector<std::string> measured;
  for (const Channel& c : case_.records[record].data.channels) measured.push_back(c.name);
  try {
    return Simulated(h, record, noise, seed, measured, rows);
  } catch (const std::runtime_error& e) {
    if (dynamic_cast<const Interrupted*>(&e) || dynamic_cast<const InputError*>(&e)) throw;
    return std::nullopt;
  }
}

std::pair<std::size_t, std::size_t> CaseModel::RowsOf(std::size_t record) const {
  std::size_t first = 0, end = 0;
  for (const Target& t : targets_) {
    if (t.record < record) first = t.first + t.count;
    if (t.record <= record) end = t.first + t.count;
  }
  return {first, end};
}

std::span<const std::size_t> CaseModel::SamplesOf(std::size_t record) const {
  const Target* longest = nullptr;
  for (const Target& t : targets_)
    if (t.record == record && (!longest || t.count > longest->count)) longest = &t;
  if (!longest) return {};
  return std::span(sample_).subspan(longest->first, longest->count);
}

bool CaseModel::FillRecord(const RigParameters& rig, std::size_t record, bool noise,
                           std::uint64_t seed, std::vector<double>& out) const {
  const auto [first, end] = RowsOf(record);
  const std::string what = noise ? "" : MemoKey(rig, case_.records[record], record);
  if (!noise)
    if (const std::optional<bool> known = memo_.Find(what, out.data() + first)) return *known;
  const bool fine = SimulateOrFind(rig, record, noise, seed, out);
  if (!noise) memo_.Keep(what, fine, out.data() + first, end - first);
  return fine;
}

bool CaseModel::SimulateOrFind(const RigParameters& rig, std::size_t record, bool noise,
                               std::uint64_t seed, std::vector<double>& out) const {
  if (!store) return SimulateRecord(rig, record, noise, seed, out);
  const auto [first, end] = RowsOf(record);
  const double horizon = horizon_[record] < kInfinity ? horizon_[record] : 0;
  const CaseRecord& r = case_.records[record];
  const RunKey key{rig,         record, noise, seed, end - first, horizon, &r.scenario.excitations,
                   r.data.start};
  if (const std::optional<bool> known = store->Find(key, out.data() + first)) return *known;
  const bool fine = SimulateRecord(rig, record, noise, seed, out);
  store->Keep(key, fine, out.data() + first);
  return fine;
}

bool CaseModel::PredictPoints(const RigParameters& rig, std::size_t record,
                              std::vector<double>& out) const {
  std::vector<std::vector<double>> columns;
  ++runs;
  try {
    if (!predictors_[record]->Predict(rig, columns)) return false;
  } catch (const std::runtime_error& e) {
    if (dynamic_cast<const Interrupted*>(&e) || dynamic_cast<const InputError*>(&e)) throw;
    return false;
  }
  for (const Target& t : targets_)
    for (std::size_t k = t.first; t.record == record && k < t.first + t.count; ++k)
      out[k] = columns[t.channel][sample_[k]];
  return true;
}

bool CaseModel::SimulateRecord(const RigParameters& rig, std::size_t record, bool noise,
                               std::uint64_t seed, std::vector<double>& out) const {
  if (horizon_[record] == 0) return true;  // left out
  if (predictors_[record]) return PredictPoints(rig, record, out);
  const Hypothesis h{rig, {}};
  const Record& data = case_.records[record].data;
  const SimulatedRows rows(data, SimulationRateFor(rig, data), SamplesOf(record));
  const auto simulated = SimulatedChannels(h, record, noise, seed, &rows.needed());
  if (!simulated) return false;
  for (const Target& t : targets_) {
    if (t.record != record) continue;
    const Channel* channel = simulated->Find(data.channels[t.channel].name);
    if (!channel) continue;
    for (std::size_t k = 0; k < t.count; ++k) out[t.first + k] = rows.At(channel->samples, k);
  }
  return true;
}

std::optional<std::vector<double>> CaseModel::Predict(const Hypothesis& h) const {
  return std::move(PredictAll({h})[0]);
}

std::vector<std::optional<std::vector<double>>> CaseModel::PredictAll(
    const std::vector<Hypothesis>& all, ModelFidelity fidelity, const RecordSubset* look) const {
  const std::size_t records = case_.records.size();
  std::vector<RigParameters> rigs;
  for (const Hypothesis& h : all) {
    rigs.push_back(h.rig);
    double& samples = rigs.back().amplifier.adc_samples_per_period;
    if (fidelity == ModelFidelity::kCoarse) samples = std::min(samples, kCoarseSamples);
  }
  std::vector<std::optional<std::vector<double>>> out(all.size());
  for (auto& o : out) o = look ? look->rest : std::vector<double>(measured_.size(), 0.0);
  std::vector<char> fine(all.size() * records, 1);
  InParallel(all.size() * records, [&](std::size_t task) {
    const std::size_t k = task % all.size(), r = order_[task / all.size()];
    if (look && !look->records[r]) return;
    fine[k * records + r] = FillRecord(rigs[k], r, false, 1, *out[k]) ? 1 : 0;
  });
  for (std::size_t k = 0; k < all.size(); ++k)
    for (std::size_t r = 0; r < records; ++r)
      if (!fine[k * records + r]) out[k].reset();
  return out;
}

std::optional<std::vector<double>> CaseModel::PredictNoisy(const Hypothesis& h,
                                                           std::uint64_t seed) const {
  std::vector<double> out(measured_.size(), 0.0);
  std::atomic<bool> fine{true};
  InParallel(order_.size(), [&](std::size_t k) {
    if (!FillRecord(h.rig, order_[k], true, seed + 977 * order_[k], out)) fine = false;
  });
  return fine ? std::optional(std::move(out)) : std::nullopt;
}

}  // namespace ambrig
