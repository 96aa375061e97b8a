#include "faulttolerance/redistribution/redistribution_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/base/atomic_file.h"
#include "core/base/errors.h"
#include "core/base/fingerprint.h"

namespace ambrig {
namespace {

constexpr int kGrid = 20;    // steps of a coil's turns
constexpr int kVersion = 3;  // of solver and file: raise it when results change
constexpr int kDeepest = 5;  // a coefficient of W: object, entries, entry, W, row

/// Check sum of an entry as the file has it, without the sum itself.
std::string Checksum(nlohmann::json item) {
  item.erase("checksum");
  return fmt::format("{:016x}", Fingerprint(item.dump()));
}

/// Fingerprint of everything the results depend on.
std::uint64_t Hash(const RedistributionProblem& p, const DistributionOptions& o) {
  std::string text = fmt::format("{} {} {} {} {} {} {}", kVersion, p.turns, p.pole_area, p.gap,
                                 p.c0, p.i_max, p.quadrants);
  for (int j = 0; j < 8; ++j) text += fmt::format(" {} {}", p.angle[j], p.sign[j]);
  text += fmt::format(" {} {} {} {} {} {} {} {} {}", static_cast<int>(o.policy), o.capacity_share,
                      o.rho_floor, o.rho_needed, o.rho_same_flux, o.bias_weight, o.control_weight,
                      o.starts, o.seed);
  return Fingerprint(text);
}

SolvabilityClass ClassFrom(const std::string& text) {
  for (const auto c : {SolvabilityClass::kExact, SolvabilityClass::kLinearised})
    if (text == ToText(c)) return c;
  return SolvabilityClass::kNone;
}

}  // namespace

RedistributionTable::RedistributionTable(const RedistributionProblem& problem,
                                         const std::string& cache_dir,
                                         const DistributionOptions& options)
    : problem_(problem), options_(options), symmetries_(FindSymmetries(problem)) {
  Require((problem.turns_left.array() == 1).all(), "the table's bearing is healthy");
  if (cache_dir.empty()) return;
  file_ = (std::filesystem::path(cache_dir) /
           fmt::format("redistribution-{:016x}.json", Hash(problem, options)))
              .string();
  Load();
}

CoilVector RedistributionTable::TurnsLeft(const std::vector<int>& failed) const {
  CoilVector turns_left = CoilVector::Ones();
  for (const int coil : failed) {
    Require(1 <= coil && coil <= 8, "coils are numbered 1 to 8");
    turns_left[coil - 1] = 0;
  }
  return turns_left;
}

RedistributionProblem RedistributionTable::AtGrid(const Key& key) const {
  RedistributionProblem p = problem_;
  for (int j = 0; j < 8; ++j) p.turns_left[j] = static_cast<double>(key[j]) / kGrid;
  return p;
}

Distribution RedistributionTable::Lookup(const std::vector<int>& failed) const {
  return Lookup(TurnsLeft(failed));
}

Distribution RedistributionTable::Lookup(const CoilVector& turns_left) const {
  Require((turns_left.array() >= 0).all() && (turns_left.array() <= 1).all(), "turns left 0 to 1");
  const BearingSymmetry& g = ToCanonical(symmetries_, turns_left);
  const CoilVector canonical = Mapped(g, turns_left);
  Key key;  // a coil with few turns left counts as failed: its current would have to be huge
  for (int j = 0; j < 8; ++j) key[j] = static_cast<int>(std::lround(canonical[j] * kGrid));
  std::unique_lock lock(mutex_);
  const Entry entry = Find(key);
  lock.unlock();
  DistributionMatrix W = entry.W;
  for (int j = 0; j < 8; ++j)
    if (key[j] > 0) W.row(j) *= key[j] / (kGrid * canonical[j]);
  RedistributionProblem p = problem_;
  p.turns_left = turns_left;
  return Describe(p, entry.cls, MappedBack(g, W));
}

double RedistributionTable::FluxCapacity(const std::vector<int>& failed) const {
  const BearingSymmetry& g = ToCanonical(symmetries_, TurnsLeft(failed));
  const CoilVector canonical = Mapped(g, TurnsLeft(failed));
  Key key;
  for (int j = 0; j < 8; ++j) key[j] = canonical[j] > 0 ? kGrid : 0;
  const std::scoped_lock lock(mutex_);
  Entry& entry = Find(key);
  if (!entry.flux_capacity) {
    const RedistributionProblem p = AtGrid(key);
    entry.flux_capacity = Describe(p, entry.cls, entry.W).capacity_flux;
    if (entry.cls == SolvabilityClass::kExact)
      entry.flux_capacity = std::max(*entry.flux_capacity, BestFluxCapacity(p, options_));
    Save();
  }
  return *entry.flux_capacity;
}

RedistributionTable::Entry& RedistributionTable::Find(const Key& key) const {
  const auto known = entries_.find(key);
  if (known != entries_.end()) return known->second;
  const Distribution d = SolveDistribution(AtGrid(key), options_);
  Entry& entry = entries_[key] = {d.cls, d.W, {}};
  Save();
  return entry;
}

void RedistributionTable::Load() const {
  std::ifstream stream(file_);
  if (!stream) return;
  try {
    // Deeper values are left out while they are read: copies and texts of JSON are recursive.
    const nlohmann::json root =
        nlohmann::json::parse(stream, [](int depth, nlohmann::json::parse_event_t,
                                         const nlohmann::json&) { return depth <= kDeepest; });
    if (root.at("version") != kVersion) return;
    for (const nlohmann::json& item : root.at("entries")) {
      if (item.at("checksum") != Checksum(item)) continue;  // edited or damaged
      const Key key = item.at("turns").get<Key>();
      Entry entry{ClassFrom(item.at("class").get<std::string>()), {}, {}};
      for (int j = 0; j < 8; ++j)
        for (int c = 0; c < 3; ++c) entry.W(j, c) = item.at("W").at(j).at(c).get<double>();
      if (item.contains("flux")) entry.flux_capacity = item.at("flux").get<double>();
      const double residual = Describe(AtGrid(key), entry.cls, entry.W).residual;
      if (residual == item.at("residual").get<double>()) entries_.try_emplace(key, entry);
    }
  } catch (const nlohmann::json::exception&) {
    // Damaged: what could be read is valid by its check sum, the rest is computed again.
  }
}

void RedistributionTable::Save() const {
  if (file_.empty()) return;
  Load();  // what another process has added meanwhile
  nlohmann::json root{{"version", kVersion}, {"entries", nlohmann::json::array()}};
  for (const auto& [key, entry] : entries_) {
    nlohmann::json item{{"turns", key}, {"class", ToText(entry.cls)}};
    for (int j = 0; j < 8; ++j) item["W"].push_back({entry.W(j, 0), entry.W(j, 1), entry.W(j, 2)});
    item["residual"] = Describe(AtGrid(key), entry.cls, entry.W).residual;
    if (entry.flux_capacity) item["flux"] = *entry.flux_capacity;
    item["checksum"] = Checksum(item);
    root["entries"].push_back(item);
  }
  std::error_code error;
  std::filesystem::create_directories(std::filesystem::path(file_).parent_path(), error);
  try {
    WriteFileAtomically(file_, root.dump(1) + '\n');  // threads of one process write it too
  } catch (const InputError&) {
    // A cache that cannot be written costs time, nothing else.
  }
}

std::vector<std::vector<int>> AllFailureSets() {
  std::vector<std::vector<int>> sets;
  for (int mask = 1; mask < 256; ++mask) {
    std::vector<int> set;
    for (int j = 0; j < 8; ++j)
      if (mask >> j & 1) set.push_back(j + 1);
    sets.push_back(set);
  }
  std::sort(sets.begin(), sets.end(), [](const auto& a, const auto& b) {
    return a.size() != b.size() ? a.size() < b.size() : a < b;
  });
  return sets;
}

}  // namespace ambrig
