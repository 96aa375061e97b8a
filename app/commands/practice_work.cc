#include "app/commands/practice_work.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "app/commands/commands.h"
#include "app/commands/outputs.h"
#include "app/json/discovery_json.h"
#include "app/json/practice_json.h"
#include "core/base/atomic_file.h"
#include "core/base/errors.h"
#include "core/base/fingerprint.h"
#include "core/base/json_file.h"
#include "core/base/read_file.h"
#include "core/record/hdf5.h"

namespace ambrig {

namespace {

namespace fs = std::filesystem;

const char* const kAnswerEnding = ".answer.toml";

PracticeCase Made(const PracticeSetting& setting, std::size_t number) {
  try {
    return MakePracticeCase(setting.rigs, setting.seed, number, &interrupted);
  } catch (const InputError& e) {
    throw PracticeCaseNotMade(e.what());
  }
}

}  // namespace

std::string PracticeHeader(const PracticeSetting& setting) {
  std::string text;
  for (const PracticeRig& rig : setting.rigs) text += rig.text;
  return fmt::format("practice seed {} rigs {}", setting.seed, Fingerprint(text));
}

std::string PracticeJournalName(const std::string& name, const Shard& shard) {
  return shard.count == 1 ? name + ".txt"
                          : fmt::format("{}-{}-of-{}.txt", name, shard.index + 1, shard.count);
}

void ReadPracticeJournals(const PracticeSetting& setting, const std::string& name,
                          const std::string& header,
                          const std::function<void(const nlohmann::ordered_json&)>& entry) {
  std::vector<std::string> journals;
  std::error_code error;
  for (const auto& item : fs::directory_iterator(setting.folder, error)) {
    const std::string file = item.path().filename().string();
    if (file.starts_with(name) && file.ends_with(".txt")) journals.push_back(item.path().string());
  }
  std::sort(journals.begin(), journals.end());
  for (const std::string& path : journals) {
    JournalVisitor visit;
    visit.header = [&](std::string_view text) {
      if (!text.empty() && text != header)
        throw InputError(fmt::format(
            "{}: is the journal of other rigs or another seed, allowed: the same rigs and --seed, "
            "or another folder",
            path));
    };
    visit.entry = [&](const JournalEntry& e) {
      try {
        entry(nlohmann::ordered_json::parse(e.text));
        return true;
      } catch (const nlohmann::json::exception&) {
        return false;  // damaged, or of an earlier version: it is done again
      }
    };
    ReadJournalFile(path, visit);
  }
}

std::map<std::string, PracticeResult> FinishedCases(const PracticeSetting& setting) {
  std::map<std::string, PracticeResult> found;
  ReadPracticeJournals(setting, "journal", PracticeHeader(setting),
                       [&](const nlohmann::ordered_json& json) {
                         PracticeResult r = PracticeResultOf(json);
                         found[r.name] = std::move(r);
                       });
  return found;
}

std::vector<std::size_t> PendingCases(const PracticeSetting& setting,
                                      const std::map<std::string, PracticeResult>& finished) {
  std::vector<std::size_t> out;
  for (std::size_t k = 0; k < setting.cases; ++k)
    if (setting.shard.Has(k) && !finished.contains(NameOfPracticeCase(k))) out.push_back(k);
  return out;
}

std::vector<std::string> FilesOfCases(const std::string& folder,
                                      const std::vector<std::size_t>& cases) {
  std::vector<std::string> out;
  for (const std::size_t k : cases) {
    const fs::path inside = fs::path(folder) / NameOfPracticeCase(k);
    if (const std::string answer = inside.string() + kAnswerEnding; fs::exists(answer))
      out.push_back(answer);
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(inside, error)) {
      const std::string name = entry.path().filename().string();
      if (name == "case.toml" || name == "rig.toml" || name.starts_with("record-"))
        out.push_back(entry.path().string());
    }
  }
  return out;
}

void WritePracticeCase(const PracticeCase& c, const std::string& folder) {
  const fs::path inside = fs::path(folder) / c.name;
  fs::create_directories(inside);
  for (std::size_t r = 0; r < c.records.size(); ++r) {
    const std::string stem = (inside / fmt::format("record-{}", r + 1)).string();
    WriteMarkedText(stem + ".toml", "practice", c.records[r].toml);
    Record data = c.data.records[r].data;
    data.attributes["made_by"] = "ambrig practice";
    WriteHdf5(data, stem + ".h5");
  }
  WriteMarkedText((inside / "rig.toml").string(), "practice", c.rig_text);
  WriteMarkedText((inside / "case.toml").string(), "practice", c.case_text);
  WriteMarkedText((fs::path(folder) / (c.name + kAnswerEnding)).string(), "practice",
                  c.answer_text);
}

PracticeResult RunPracticeCase(const PracticeSetting& setting, std::size_t number, bool make_only,
                               const std::function<void(double, const std::string&)>& progress) {
  progress(0, "making " + NameOfPracticeCase(number));
  const PracticeCase c = Made(setting, number);
  WritePracticeCase(c, setting.folder);
  if (make_only) return ResultOf(c, {});
  const std::string folder = (fs::path(setting.folder) / c.name).string();
  try {
    ExplainOptions options;
    options.calibrate = false;
    options.stop = &interrupted;
    options.progress = [&](double f, const std::string& text) {
      progress(f, c.name + ": " + text);
    };
    const Explanation e = Explain(ReadCase(folder), options);
    WriteFileAtomically(folder + ".json", JsonText(ExplainJson(e), 1) + "\n");
    return ResultOf(c, e);
  } catch (const Interrupted&) {
    throw;
  } catch (const std::exception& error) {
    PracticeResult r = ResultOf(c, {});
    r.stated.members.clear();
    r.finding.verdict = "failed";
    r.failure = error.what();
    return r;
  }
}

void JoinAnswers(const std::string& folder) {
  std::vector<fs::path> files;
  for (const auto& item : fs::directory_iterator(folder))
    if (item.path().filename().string().ends_with(kAnswerEnding)) files.push_back(item.path());
  std::sort(files.begin(), files.end());
  std::string text = "# made by ambrig practice: what each case hides\n";
  for (const fs::path& f : files) text += "\n" + ReadFile(f.string());
  WriteMarkedText((fs::path(folder) / "answers.toml").string(), "practice", text);
}

}  // namespace ambrig
