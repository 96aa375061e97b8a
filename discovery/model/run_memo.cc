#include "discovery/model/run_memo.h"

#include <algorithm>

#include "discovery/model/record_traits.h"
#include "rig/rig_assembly.h"

namespace ambrig {

namespace {

template <class T>
void Add(std::string& bytes, const T& value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

void AddText(std::string& bytes, const std::string& text) {
  Add(bytes, text.size());
  bytes += text;
}

/// Whether the shaft turns at any time. What turns between two instants leaves an angle behind.
bool Turns(const Scenario& s) {
  constexpr int kParts = 64;
  for (int k = 0; k <= kParts; ++k) {
    const double t = s.duration * k / kParts;
    if (s.speed.Speed(t) != 0 || s.speed.Angle(t) != 0) return true;
  }
  return s.speed_free_from < s.duration;
}

bool FeelsParameter(const std::string& path, bool clamped, bool turns) {
  if (clamped && path.starts_with("rotor.")) return false;
  return turns || path != "rotor.inertia_polar";
}

}  // namespace

std::string MemoKey(const RigParameters& rig, const CaseRecord& record, std::size_t index) {
  const bool clamped = record.scenario.start == StartState::kClamped,
             turns = Turns(record.scenario);
  std::string bytes;
  Add(bytes, index);
  Add(bytes, rig.amplifier.adc_samples_per_period);
  Add(bytes, rig.amplifier.unit);
  for (const Tolerance& t : rig.tolerances)
    if (const double* value = ParameterAt(rig, t.path))
      if (FeelsParameter(t.path, clamped, turns)) Add(bytes, *value);
  for (const EffectInstance& e : rig.effects) {
    if (!Feels(record, e)) continue;
    AddText(bytes, e.name);
    AddText(bytes, e.target);
    for (const double v : e.values) Add(bytes, v);
    for (const auto& [port, law] : e.formulas) AddText(bytes, port + "=" + law);
  }
  return bytes;
}

std::optional<bool> RunMemo::Find(const std::string& key, double* out) const {
  const std::scoped_lock lock(mutex_);
  const auto found = places_.find(key);
  if (found == places_.end()) return std::nullopt;
  entries_.splice(entries_.begin(), entries_, found->second);
  const Entry& e = *found->second;
  std::copy(e.rows.begin(), e.rows.end(), out);
  return e.fine;
}

void RunMemo::Clear() {
  const std::scoped_lock lock(mutex_);
  places_.clear();
  entries_.clear();
  bytes_ = 0;
}

void RunMemo::Keep(const std::string& key, bool fine, const double* rows, std::size_t count) {
  const std::scoped_lock lock(mutex_);
  if (places_.contains(key)) return;
  entries_.push_front(
      {key, fine, fine ? std::vector<double>(rows, rows + count) : std::vector<double>()});
  places_[key] = entries_.begin();
  bytes_ += entries_.front().rows.size() * sizeof(double) + 2 * key.size();
  while (bytes_ > most_ && entries_.size() > 1) {
    bytes_ -= entries_.back().rows.size() * sizeof(double) + 2 * entries_.back().key.size();
    places_.erase(entries_.back().key);
    entries_.pop_back();
  }
}

}  // namespace ambrig
