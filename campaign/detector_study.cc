#include "campaign/detector_study.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include "campaign/campaign_values.h"
#include "campaign/row.h"
#include "core/base/counted.h"
#include "core/base/fingerprint.h"
#include "core/base/read_file.h"
#include "core/base/toml_checked.h"
#include "rig/parameters/bearing_kind.h"
#include "simulation/switching/switching_engine.h"

namespace ambrig {

namespace {

constexpr int kRowFormat = 2;  // of the rows: raise it when a cell means something else

constexpr std::string_view kStranger = "not-commissioned";

const CoilDetectorKind& CommissionedKind() {
  return *std::ranges::find(CoilDetectorKinds(), kCommissionedDetector, &CoilDetectorKind::name);
}

/// The commissioned detector as it is before it has learnt anything.
CoilDetectorKind Stranger() {
  CoilDetectorKind kind = CommissionedKind();
  kind.name = kStranger;
  kind.make = [](const CoilDetectorSetup& s) {
    CoilDetectorSetup bare = s;
    bare.commissioning.clear();
    return CommissionedKind().make(bare);
  };
  return kind;
}

/// Where plants were commissioned the detector that learnt them is compared with itself.
void AddStranger(DetectorStudy* s) {
  const auto learnt = [](const Campaign& c) {
    return std::ranges::any_of(c.plants, &CampaignPlant::commissioned);
  };
  const auto it = std::ranges::find(s->detectors, kCommissionedDetector, &CoilDetectorKind::name);
  if (it != s->detectors.end() && (learnt(s->healthy) || learnt(s->faulty)))
    s->detectors.insert(it + 1, Stranger());
}

std::vector<CoilDetectorKind> ReadDetectors(const TomlTable& t) {
  std::vector<CoilDetectorKind> all;  // that have a statistic
  for (const CoilDetectorKind& k : CoilDetectorKinds())
    if (k.make) all.push_back(k);
  std::string names;
  for (const CoilDetectorKind& k : all)
    names += fmt::format("{}{}", names.empty() ? "" : ", ", k.name);
  std::vector<CoilDetectorKind> out;
  if (!t.Has("detectors")) return all;
  for (const std::string& name : t.Strings("detectors")) {
    const auto it = std::find_if(all.begin(), all.end(),
                                 [&](const CoilDetectorKind& k) { return k.name == name; });
    const bool twice = std::any_of(out.begin(), out.end(),
                                   [&](const CoilDetectorKind& k) { return k.name == name; });
    if (it == all.end() || twice)
      t.Fail("detectors", fmt::format("= \"{}\", allowed: each once of {}", name, names));
    out.push_back(*it);
  }
  if (out.empty()) t.Fail("detectors", "= [], allowed: some of " + names);
  return out;
}

void CheckHealthy(const TomlTable& t, const DetectorStudy& s) {
  for (const FailureSet& set : s.healthy.sets)
    if (!set.coils.empty())
      t.Fail("healthy", fmt::format("= \"{}\" has faults, allowed: a campaign with sets = \"none\"",
                                    s.healthy.file));
  const double least = s.trial.begin + s.trial.settle + s.trial.window;
  for (const Scenario& one : s.healthy.scenarios)
    if (one.duration < least)
      t.Fail("healthy",
             fmt::format("= \"{}\": {} lasts {} s, allowed: at least begin + settle + window, {} s",
                         s.healthy.file, one.name, one.duration, least));
}

void CheckFaulty(const TomlTable& t, const DetectorStudy& s) {
  for (const FailureSet& set : s.faulty.sets)
    if (set.coils.size() != 1)
      t.Fail("faulty",
             fmt::format("= \"{}\" has a run with {}, allowed: a campaign of sets of one coil",
                         s.faulty.file, Counted(set.coils.size(), "fault")));
  const double last =
      s.faulty.fault_time + *std::max_element(s.faulty.phases.begin(), s.faulty.phases.end()) /
                                s.faulty.rig.controller.rate;
  for (const Scenario& one : s.faulty.scenarios)
    if (one.duration < last + s.trial.window)
      t.Fail("faulty",
             fmt::format(
                 "= \"{}\": {} ends at {} s, allowed: not before the window after the fault, {} s",
                 s.faulty.file, one.name, one.duration, last + s.trial.window));
}

std::string HealthyText(const DetectorOutcome& o) {
  std::string text;
  for (const auto& [level, count] : o.windows)
    text += fmt::format("{}{}:{}", text.empty() ? "" : " ", level, count);
  return text;
}

std::string FaultyText(const DetectorOutcome& o) {
  std::string text = "coil";
  for (const LevelReached& r : o.coil) text += fmt::format(" {}:{}", r.period, r.level);
  text += " bearing";
  for (const LevelReached& r : o.bearing)
    text += fmt::format(" {}:{}:{}", r.period, r.level, r.right ? 1 : 0);
  return text;
}

std::vector<std::string> Words(const std::string& text) {
  std::vector<std::string> out;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find(' ', begin), text.size());
    if (end > begin) out.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return out;
}

DetectorOutcome ParseOutcome(const std::string& cell, bool faulty) {
  DetectorOutcome out;
  std::vector<LevelReached>* list = nullptr;
  for (const std::string& word : Words(cell)) {
    int a = 0, b = 0, right = 1;
    if (word == "coil" || word == "bearing") {
      list = word == "coil" ? &out.coil : &out.bearing;
    } else if (std::sscanf(word.c_str(), "%d:%d:%d", &a, &b, &right) < 2 || (faulty && !list)) {
      throw InputError(fmt::format(
          "\"{}\": allowed: level:windows, or period:level after coil or bearing", word));
    } else if (faulty) {
      list->push_back({a, b, right != 0});
    } else {
      out.windows[a] += b;
    }
  }
  return out;
}

constexpr std::size_t kConditions = 9;

}  // namespace

DetectorStudy ReadDetectorStudy(const std::string& file) {
  const TomlTable root = TomlTable::FromFile(file);
  DetectorStudy s;
  s.file = file;
  s.name = root.String("name", std::filesystem::path(file).stem().string());
  s.healthy = ReadCampaign(ExistingFile(root, "healthy"));
  s.faulty = ReadCampaign(ExistingFile(root, "faulty"));
  s.detectors = ReadDetectors(root);
  AddStranger(&s);
  s.trial.begin = In(root, "begin", s.trial.begin, 0, 10, "s");
  s.trial.settle = In(root, "settle", s.trial.settle, 0, 10, "s");
  s.trial.window = In(root, "window", s.trial.window, 1e-4, 10, "s");
  s.budget = In(root, "budget", s.budget, 1e-9, 1, "(false alarms per coil and window)");
  root.RejectUnknownKeys();
  for (const Campaign* c : {&s.healthy, &s.faulty})
    if (c->rig.amplifier.modulation != Modulation::kBiState)
      root.Fail(c == &s.healthy ? "healthy" : "faulty",
                fmt::format(
                    "= \"{}\": {}, allowed: a rig with bi-state bridges (slopes need both phases)",
                    c->file, c->rig.file));
  for (const Campaign* c : {&s.healthy, &s.faulty})
    for (const BearingParameters& b : c->rig.bearings)
      if (b.kind->linearise)
        root.Fail(c == &s.healthy ? "healthy" : "faulty",
                  fmt::format("= \"{}\": bearing {} is of kind \"{}\", allowed: radial, thrust, "
                              "opposed",
                              c->file, b.name, b.kind->name));
  // A threshold is set for one kind of bearing: where the faults are.
  s.trial.kinds.clear();
  for (const FailureSet& set : s.faulty.sets)
    s.trial.kinds.push_back(s.faulty.rig.Find(set.bearing)->kind);
  CheckHealthy(root, s);
  CheckFaulty(root, s);
  const std::string texts = ReadFile(file) + s.healthy.fingerprint + s.faulty.fingerprint;
  s.fingerprint =
      fmt::format("{:016x}", Fingerprint(texts, Fingerprint(std::to_string(kRowFormat))));
  return s;
}

DetectorStudyPlan::DetectorStudyPlan(const DetectorStudy& study)
    : study_(study), healthy_(study.healthy), faulty_(study.faulty) {}

JournalHeader DetectorStudyPlan::Header() const {
  return {study_.name, std::filesystem::absolute(study_.file).lexically_normal().string(),
          study_.fingerprint, study_.runs()};
}

std::vector<std::string> DetectorStudyPlan::Columns() const {
  std::vector<std::string> out = {"run",  "part", "scenario", "coil", "kind", "fault_time [s]",
                                  "draw", "seed", "plant"};
  for (const CoilDetectorKind& k : study_.detectors) out.emplace_back(k.name);
  out.emplace_back("note");
  return out;
}

Row DetectorStudyPlan::Simulate(std::size_t run, const std::atomic<bool>* stop) const {
  const bool faulty = run >= study_.healthy.runs();
  const RunPlan& plan = faulty ? faulty_ : healthy_;
  PlannedRun p = plan.Make(faulty ? run - study_.healthy.runs() : run);
  const FaultCase& fault = plan.campaign().cases[p.at.fault];
  std::vector<std::string> cells = {
      std::to_string(run),
      faulty ? "faulty" : "healthy",
      OneCell(std::filesystem::path(p.scenario.file).stem().string()),
      faulty ? SetText(plan.campaign().sets[fault.set]) : "",
      faulty ? OneCell(plan.campaign().kinds[fault.kind].label) : "",
      faulty ? NumberText(p.scenario.faults.front().time) : "",
      std::to_string(p.at.draw),
      std::to_string(p.scenario.seed),
      p.plant ? OneCell(fmt::format("{} {}", p.plant->label, p.plant->scale)) : ""};
  // A longer run would only repeat what nobody looks at.
  if (faulty)
    p.scenario.duration =
        std::min(p.scenario.duration, p.scenario.faults.front().time + study_.trial.window + 1e-4);
  try {
    DetectorTrial trial(NominalRig(p.rig), p.scenario, study_.detectors, study_.trial);
    EngineOptions engine;
    engine.record = false;
    engine.supervisor = &trial;
    engine.stop = stop;
    SwitchingEngine(p.rig, p.scenario, engine).Run();
    for (const DetectorOutcome& o : trial.Take())
      cells.push_back(faulty ? FaultyText(o) : HealthyText(o));
    cells.emplace_back();
  } catch (const Interrupted&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& e) {
    cells.resize(kConditions + study_.detectors.size());
    cells.push_back("error: " + OneCell(e.what()));
  }
  return RowOfCells(run, cells);
}

void CheckDetectorStudyRow(const Row& row, std::size_t detectors, const std::string& where) {
  const std::size_t cells = row.Cells().size();
  if (cells != kConditions + detectors + 1)
    throw InputError(fmt::format("{}: {}, allowed: {} of a study of {}", where,
                                 Counted(cells, "cell"), kConditions + detectors + 1,
                                 Counted(detectors, "detector")));
}

DetectorStudyRow ParseDetectorStudyRow(const Row& row, std::size_t detectors) {
  CheckDetectorStudyRow(row, detectors, fmt::format("row of run {}", row.run));
  const std::vector<std::string_view> cells = row.Cells();
  DetectorStudyRow out;
  out.faulty = cells[1] == "faulty";
  out.scenario = cells[2];
  out.coil = cells[3];
  out.kind = cells[4];
  out.plant = cells[8];
  out.fault_time = out.faulty ? std::strtod(cells[5].data(), nullptr) : 0;
  out.note = cells.back();
  if (!out.note.empty()) return out;
  for (std::size_t k = 0; k < detectors; ++k)
    out.outcomes.push_back(ParseOutcome(std::string(cells[kConditions + k]), out.faulty));
  return out;
}

}  // namespace ambrig
