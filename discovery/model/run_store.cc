#include "discovery/model/run_store.h"

#include <fmt/format.h>

#include <filesystem>
#include <iterator>

#include "core/base/errors.h"
#include "core/base/fingerprint.h"
#include "core/base/read_file.h"

namespace ambrig {

namespace {

template <class T>
void AddBytes(std::string& bytes, const T& value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

void AddCountedText(std::string& bytes, const std::string& text) {
  AddBytes(bytes, text.size());
  bytes += text;
}

/// The exact values of all that a hypothesis may move, as hexadecimal digits.
std::string TextOf(const RunKey& key) {
  std::string bytes;
  AddBytes(bytes, key.record);
  AddBytes(bytes, key.noise);
  AddBytes(bytes, key.seed);
  AddBytes(bytes, key.rows);
  AddBytes(bytes, key.horizon);
  AddBytes(bytes, key.start);
  if (key.inputs)
    for (const Excitation& e : *key.inputs) AddBytes(bytes, e.amplitude);
  const RigParameters& rig = key.rig;
  AddBytes(bytes, rig.amplifier.adc_samples_per_period);
  AddBytes(bytes, rig.amplifier.unit);
  for (const Tolerance& t : rig.tolerances)
    if (const double* value = ParameterAt(rig, t.path)) AddBytes(bytes, *value);
  for (const EffectInstance& e : rig.effects) {
    AddCountedText(bytes, e.name);
    AddCountedText(bytes, e.target);
    for (const double v : e.values) AddBytes(bytes, v);
    for (const auto& [port, law] : e.formulas) AddCountedText(bytes, port + "=" + law);
  }
  std::string text;
  for (const char byte : bytes)
    fmt::format_to(std::back_inserter(text), "{:02x}", static_cast<unsigned char>(byte));
  return text;
}

/// Case, data and program: what is the same for all entries of a store.
std::string BeginOf(const Case& c) {
  std::uint64_t print = Fingerprint(ReadFile("/proc/self/exe"));
  print = Fingerprint(ReadFile(c.rig_file), Fingerprint(ReadFile(c.file), print));
  for (const CaseRecord& r : c.records) {
    print = Fingerprint(ReadFile(r.data_file), print);
    if (!r.scenario_file.empty()) print = Fingerprint(ReadFile(r.scenario_file), print);
    for (const Excitation& e : r.scenario.excitations)
      for (const double v : e.samples) print = Fingerprint(fmt::format("{} ", v), print);
  }
  return fmt::format("ambrig simulations 4 {:016x}", print);
}

}  // namespace

RunStore::RunStore(const std::string& folder, const Case& c)
    : RunStore((std::filesystem::path(folder) / "simulations.bin").string(), BeginOf(c)) {}

RunStore::RunStore(const std::string& path, const std::string& begin)
    : journal_(path, begin, Into(path, begin)) {}

JournalVisitor RunStore::Into(const std::string& path, const std::string& begin) {
  const auto header = [path, begin](std::string_view text) {
    if (text != begin)
      throw InputError(
          fmt::format("{}: holds the simulations of another case or of another build; allowed: the "
                      "same files and program, or another folder",
                      path));
  };
  const auto entry = [this](const JournalEntry& e) {
    entries_[std::string(e.text)] = {e.offset, e.bytes, e.bytes > 0};
    return true;
  };
  return {header, entry};
}

std::optional<bool> RunStore::Find(const RunKey& key, double* out) const {
  Entry entry;
  {
    const std::scoped_lock lock(mutex_);
    const auto found = entries_.find(TextOf(key));
    if (found == entries_.end()) return std::nullopt;
    entry = found->second;
  }
  if (!entry.fine) return false;
  // `out` has room for the rows of the key, whatever stands in the file.
  if (entry.bytes != key.rows * sizeof(double) ||
      !journal_.ReadData(entry.offset, reinterpret_cast<char*>(out), entry.bytes))
    return std::nullopt;
  return true;
}

void RunStore::Keep(const RunKey& key, bool fine, const double* rows) {
  const std::size_t bytes = fine ? key.rows * sizeof(double) : 0;
  const std::string text = TextOf(key);
  const std::size_t offset = journal_.Append(text, {reinterpret_cast<const char*>(rows), bytes});
  const std::scoped_lock lock(mutex_);
  entries_[text] = {offset, bytes, fine};
}

}  // namespace ambrig
