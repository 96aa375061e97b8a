#include "discovery/model/run_store.h"

#include <fmt/format.h>

#include <cstring>
#include <filesystem>

#include "core/base/errors.h"
#include "core/base/fingerprint.h"
#include "core/base/read_file.h"

namespace ambrig {

namespace {

struct EntryHead {
  std::uint64_t key_bytes = 0, rows = 0, fine = 0, check = 0;
};

template <class T>
void Add(std::string& bytes, const T& value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

void AddText(std::string& bytes, const std::string& text) {
  Add(bytes, text.size());
  bytes += text;
}

/// The exact values of all that a hypothesis may move.
std::string BytesOf(const RunKey& key) {
  std::string bytes;
  Add(bytes, key.record);
  Add(bytes, key.noise);
  Add(bytes, key.seed);
  Add(bytes, key.rows);
  Add(bytes, key.horizon);
  const RigParameters& rig = key.rig;
  for (const Tolerance& t : rig.tolerances)
    if (const double* value = ParameterAt(rig, t.path)) Add(bytes, *value);
  for (const EffectInstance& e : rig.effects) {
    AddText(bytes, e.name);
    AddText(bytes, e.target);
    for (const double v : e.values) Add(bytes, v);
    for (const auto& [port, law] : e.formulas) AddText(bytes, port + "=" + law);
  }
  return bytes;
}

/// Case, data and program: what is the same for all entries of a store.
std::string BeginOf(const Case& c) {
  std::uint64_t print = Fingerprint(ReadFile("/proc/self/exe"));
  print = Fingerprint(ReadFile(c.rig_file), Fingerprint(ReadFile(c.file), print));
  for (const CaseRecord& r : c.records) {
    print = Fingerprint(ReadFile(r.data_file), Fingerprint(ReadFile(r.scenario_file), print));
    for (const Excitation& e : r.scenario.excitations)
      for (const double v : e.samples) print = Fingerprint(fmt::format("{} ", v), print);
  }
  return fmt::format("ambrig simulations {:016x}\n", print);
}

std::uint64_t CheckOf(std::string_view key, const double* rows, std::size_t count) {
  return Fingerprint({reinterpret_cast<const char*>(rows), count * sizeof(double)},
                     Fingerprint(key));
}

}  // namespace

RunStore::RunStore(const std::string& folder, const Case& c)
    : file_((std::filesystem::path(folder) / "simulations.bin").string()), begin_(BeginOf(c)) {
  std::string found(begin_.size(), ' ');
  if (!file_.ReadAt(0, found.data(), found.size())) {  // nothing, or not even a whole first line
    file_.Truncate(0);
    file_.Append(begin_);
    end_ = begin_.size();
    return;
  }
  if (found != begin_)
    throw InputError(
        fmt::format("{}: holds the simulations of another case or of another build; allowed: the "
                    "same files and program, or another folder",
                    file_.path()));
  ReadAll();
}

void RunStore::ReadAll() {
  EntryHead head;
  std::string key;
  std::vector<double> rows;
  for (end_ = begin_.size(); file_.ReadAt(end_, reinterpret_cast<char*>(&head), sizeof head);) {
    const std::size_t at = end_ + sizeof head;
    if (head.key_bytes > 1'000'000 || head.rows > 100'000'000) break;
    key.resize(head.key_bytes);
    rows.resize(head.rows);
    if (!file_.ReadAt(at, key.data(), key.size())) break;
    if (!file_.ReadAt(at + key.size(), reinterpret_cast<char*>(rows.data()),
                      rows.size() * sizeof(double)))
      break;
    if (CheckOf(key, rows.data(), rows.size()) != head.check) break;
    places_[key] = {at + key.size(), rows.size(), head.fine != 0};
    end_ = at + key.size() + rows.size() * sizeof(double);
  }
  file_.Truncate(end_);
}

std::optional<bool> RunStore::Find(const RunKey& key, double* out) const {
  Place place;
  {
    const std::scoped_lock lock(mutex_);
    const auto found = places_.find(BytesOf(key));
    if (found == places_.end()) return std::nullopt;
    place = found->second;
  }
  if (place.fine &&
      !file_.ReadAt(place.offset, reinterpret_cast<char*>(out), place.rows * sizeof(double)))
    return std::nullopt;
  return place.fine;
}

void RunStore::Keep(const RunKey& key, bool fine, const double* rows) {
  const std::size_t count = fine ? key.rows : 0;
  const std::string id = BytesOf(key);
  std::string bytes;
  Add(bytes, EntryHead{id.size(), count, fine ? 1U : 0U, CheckOf(id, rows, count)});
  bytes += id;
  bytes.append(reinterpret_cast<const char*>(rows), count * sizeof(double));
  const std::scoped_lock lock(mutex_);
  file_.Append(bytes);
  places_[id] = {end_ + sizeof(EntryHead) + id.size(), count, fine};
  end_ += bytes.size();
}

}  // namespace ambrig
