#include "discovery/model/model.h"

#include <fmt/format.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "core/record/channels.h"
#include "rig/rig_assembly.h"
#include "simulation/switching/switching_engine.h"

namespace ambrig {

Hypothesis Hypothesis::Base(const RigParameters& rig) {
  Hypothesis h;
  h.rig = rig;
  for (const Tolerance& t : rig.tolerances) {
    FreeParameter p;
    p.path = t.path;
    const double* at = ParameterAt(h.rig, t.path);
    if (!at || t.sd <= 0) continue;
    // the prior's mean; a calibration found earlier is where the fit starts
    p.value = p.start = *at;
    p.sd = p.step = t.sd;
    std::string unit;
    ParameterRange(rig, t.path, &p.lo, &p.hi, &unit);
    p.lo = std::max(p.lo, p.value - 8 * t.sd);
    p.hi = std::min(p.hi, p.value + 8 * t.sd);
    h.free.push_back(p);
    if (!std::isnan(t.true_value)) h.Set(h.free.size() - 1, t.true_value);
  }
  for (Tolerance& t : h.rig.tolerances) t.true_value = kRequired;  // now in the values
  // A formula that the user wrote is there to be fitted, and so is what an adoption found: { value,
  // sd }.
  const std::vector<EffectInstance> own = std::move(h.rig.effects);
  h.rig.effects.clear();
  for (const EffectInstance& e : own) {
    const std::size_t before = h.free.size();
    h.AddEffect(e);
    if (e.IsFormula()) continue;
    for (std::size_t k = h.free.size(); k-- > before;)
      if (e.sd[h.free[k].row] <= 0) h.free.erase(h.free.begin() + static_cast<std::ptrdiff_t>(k));
  }
  return h;
}

void Hypothesis::AddEffect(const EffectInstance& effect) {
  const int index = static_cast<int>(rig.effects.size());
  rig.effects.push_back(effect);
  for (std::size_t row = 0; row < effect.table.size(); ++row) {
    const EffectParameter& e = effect.table[row];
    FreeParameter p;
    p.path = fmt::format("{}@{}.{}", effect.name, effect.target, e.name);
    p.effect = index;
    p.row = row;
    p.value = p.start = effect.values[row];
    p.lo = e.lo;
    p.hi = e.hi;
    if (!std::isfinite(p.value)) continue;  // at a null of infinity: not moved
    const double typical = std::max(std::abs(e.typical_hi), std::abs(e.typical_lo));
    p.step = 0.3 * typical;
    if (p.step == 0) p.step = std::isfinite(e.hi) && std::isfinite(e.lo) ? 0.05 * (e.hi - e.lo) : 1;
    // Sizes over decades move in ratios; signed ones and distances from a null (a gain of 1) in
    // steps.
    const bool distance =
        std::isfinite(e.null_value) && std::abs(e.typical_hi) <= 0.5 * std::abs(e.null_value);
    p.logarithmic = !distance && e.typical_lo > 0 && e.typical_hi / e.typical_lo > 2.5 &&
                    e.lo >= 0 && p.value > 0;
    free.push_back(p);
  }
}

void Hypothesis::Set(std::size_t parameter, double value) {
  FreeParameter& p = free[parameter];
  p.value = std::clamp(value, p.lo, p.hi);
  if (p.effect >= 0) {
    rig.effects[static_cast<std::size_t>(p.effect)].values[p.row] = p.value;
  } else {
    SetParameter(rig, p.path, p.value);
  }
}

double Hypothesis::Coordinate(std::size_t parameter) const {
  const FreeParameter& p = free[parameter];
  return p.logarithmic ? std::log(p.value / p.start) / 0.3 : (p.value - p.start) / p.step;
}

double Hypothesis::ValueAt(std::size_t parameter, double coordinate) const {
  const FreeParameter& p = free[parameter];
  const double v =
      p.logarithmic ? p.start * std::exp(0.3 * coordinate) : p.start + p.step * coordinate;
  return std::clamp(v, p.lo, p.hi);
}

CaseModel::CaseModel(const Case& c, std::size_t thin) : case_(c) {
  for (std::size_t r = 0; r < c.records.size(); ++r) {
    const CaseRecord& record = c.records[r];
    plans_.push_back(std::make_unique<CommandPlan>(c.rig, record.scenario));
    for (std::size_t ch = 0; ch < record.data.channels.size(); ++ch) {
      const Channel& channel = record.data.channels[ch];
      const bool free_speed = record.scenario.speed_free_from < record.scenario.duration;
      const auto id = ParseChannel(channel.name);
      if (!id || id->row().reader == ChannelReader::kSimulator) continue;
      const bool prescribed =
          id->kind == ChannelKind::kAngle || (id->kind == ChannelKind::kSpeed && !free_speed);
      const bool command =
          record.scenario.start == StartState::kClamped && id->kind == ChannelKind::kSetPoint;
      if (prescribed || command || !record.quality[ch].use) continue;
      Target t;
      t.record = r;
      t.channel = ch;
      t.first = measured_.size();
      double mean = 0, square = 0, n = 0;
      for (std::size_t block = 0; block * thin < channel.samples.size(); ++block) {
        const std::size_t k = block * thin + block % thin;
        if (k >= channel.samples.size()) break;
        sample_.push_back(k);
        measured_.push_back(std::isfinite(channel.samples[k]) ? channel.samples[k] : 0);
        ok_.push_back(record.quality[ch].ok[k]);
        if (!ok_.back()) continue;
        mean += channel.samples[k];
        square += channel.samples[k] * channel.samples[k];
        n += 1;
      }
      t.count = measured_.size() - t.first;
      if (n > 0) t.full_scale = std::sqrt(std::max(0.0, square / n - mean * mean / n / n));
      targets_.push_back(t);
    }
  }
}

Record CaseModel::Simulated(const Hypothesis& h, std::size_t record, bool noise,
                            std::uint64_t seed) const {
  const CaseRecord& r = case_.records[record];
  Scenario scenario = r.scenario;
  scenario.noise = noise;
  scenario.seed = seed;
  EngineOptions options;
  options.commands = plans_[record].get();
  options.record_rate = RecordRateFor(h.rig, r.data.rate);
  options.watch = false;
  options.nominal = &case_.rig;
  // A hypothesis that drops a rotor which the measured rig held is no explanation; do not watch it
  // bounce.
  if (r.scenario.start == StartState::kLevitated && r.scenario.faults.empty())
    options.lost_after = 0.01;
  options.stop = stop;
  ++runs;
  return SwitchingEngine(h.rig, scenario, options).Run().record;
}

std::pair<std::size_t, std::size_t> CaseModel::RowsOf(std::size_t record) const {
  std::size_t first = 0, end = 0;
  for (const Target& t : targets_) {
    if (t.record < record) first = t.first + t.count;
    if (t.record <= record) end = t.first + t.count;
  }
  return {first, end};
}

bool CaseModel::FillRecord(const RigParameters& rig, std::size_t record, bool noise,
                           std::uint64_t seed, std::vector<double>& out) const {
  if (!store) return SimulateRecord(rig, record, noise, seed, out);
  const auto [first, end] = RowsOf(record);
  const RunKey key{rig, record, noise, seed, end - first};
  if (const std::optional<bool> known = store->Find(key, out.data() + first)) return *known;
  const bool fine = SimulateRecord(rig, record, noise, seed, out);
  store->Keep(key, fine, out.data() + first);
  return fine;
}

bool CaseModel::SimulateRecord(const RigParameters& rig, std::size_t record, bool noise,
                               std::uint64_t seed, std::vector<double>& out) const {
  Hypothesis h;
  h.rig = rig;
  Record simulated;
  try {
    simulated = Simulated(h, record, noise, seed);
  } catch (const std::runtime_error& e) {
    if (dynamic_cast<const Interrupted*>(&e) || dynamic_cast<const InputError*>(&e)) throw;
    return false;  // the motion became infinite: this hypothesis cannot be
  }
  const Record& data = case_.records[record].data;
  const double ratio = simulated.rate / data.rate;
  for (const Target& t : targets_) {
    if (t.record != record) continue;
    const Channel* channel = simulated.Find(data.channels[t.channel].name);
    if (!channel) continue;
    const std::vector<double>& y = channel->samples;
    for (std::size_t k = 0; k < t.count; ++k) {
      const double at =
          data.start * simulated.rate + static_cast<double>(sample_[t.first + k]) * ratio;
      const auto low = static_cast<std::size_t>(std::max(0.0, at + 1e-6));
      const double part = std::max(0.0, at - static_cast<double>(low));
      const std::size_t a = std::min(low, y.size() - 1), b = std::min(low + 1, y.size() - 1);
      out[t.first + k] = part < 1e-5 ? y[a] : y[a] + part * (y[b] - y[a]);
    }
  }
  return true;
}

std::optional<std::vector<double>> CaseModel::Predict(const Hypothesis& h) const {
  auto all = PredictAll({h});
  return std::move(all[0]);
}

std::vector<std::optional<std::vector<double>>> CaseModel::PredictAll(
    const std::vector<Hypothesis>& all) const {
  const std::size_t records = case_.records.size();
  std::vector<std::optional<std::vector<double>>> out(all.size());
  for (auto& o : out) o.emplace(measured_.size(), 0.0);
  std::vector<char> fine(all.size() * records, 1);
  tbb::parallel_for(std::size_t{0}, all.size() * records, [&](std::size_t task) {
    const std::size_t k = task / records, r = task % records;
    fine[task] = FillRecord(all[k].rig, r, false, 1, *out[k]) ? 1 : 0;
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
  tbb::parallel_for(std::size_t{0}, case_.records.size(), [&](std::size_t r) {
    if (!FillRecord(h.rig, r, true, seed + 977 * r, out)) fine = false;
  });
  if (!fine) return std::nullopt;
  return out;
}

}  // namespace ambrig
