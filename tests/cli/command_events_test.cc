// What a program that starts a command can read of it: its events, where its answer comes from,
// every sample of a comparison, a rig resolved, what differs between two.
#include <gmock/gmock.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "core/base/fingerprint.h"
#include "core/record/hdf5.h"
#include "tests/cli/cli_run.h"

namespace ambrig {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

class CommandEvents : public CliFolder {
 protected:
  void SetUp() override {
    CliFolder::SetUp();
    Write("rig.toml", ReferenceRigText());
    Write("s.toml", ScenarioText(""));
  }
  std::vector<json> Events(const std::string& arguments, int* exit = nullptr) const {
    const Outcome o = Ambrig(arguments + " --events 3 3>events.jsonl");
    if (exit) *exit = o.exit;
    std::vector<json> out;
    std::istringstream lines(ReadText(folder_ / "events.jsonl"));
    for (std::string line; std::getline(lines, line);) out.push_back(json::parse(line));
    return out;
  }
  json JsonOf(const std::string& file) const { return json::parse(ReadText(folder_ / file)); }
};

TEST_F(CommandEvents, TellStagesSharesAndTheEnd) {
  Write("s.toml", Replaced(ScenarioText(""), "duration = 0.01", "duration = 0.3"));
  int exit = -1;
  const std::vector<json> events = Events("run s.toml --no-report --quiet", &exit);
  EXPECT_EQ(exit, 0);
  ASSERT_GE(events.size(), 3u);
  EXPECT_EQ(events.front()["event"], "stage");
  EXPECT_EQ(events.back(), (json{{"event", "done"}, {"code", 0}}));
  double last = 0;
  for (const json& e : events)
    if (e["event"] == "progress") {
      EXPECT_GE(e["share"], last);
      EXPECT_LE(e["share"], 1.0);
      last = e["share"];
    }
}

TEST_F(CommandEvents, TellAMistakeInItsLine) {
  Write("s.toml", Replaced(ScenarioText(""), "duration = 0.01", "duration = -1"));
  int exit = -1;
  const std::vector<json> events = Events("run s.toml", &exit);
  EXPECT_EQ(exit, 2);
  EXPECT_EQ(events.back()["code"], 2);
  EXPECT_THAT(events.back()["error"].get<std::string>(), HasSubstr("s.toml:3: duration"));
}

TEST_F(CommandEvents, WantADescriptorThatIsOpen) {
  const Outcome closed = Ambrig("run s.toml --events 9");
  EXPECT_EQ(closed.exit, 2);
  EXPECT_EQ(closed.lines(), 1) << closed.text;
  EXPECT_THAT(closed.text, HasSubstr("not open for writing"));
}

// Whoever listens goes away: the work stops as by Ctrl-C, nothing half-written is left.
TEST_F(CommandEvents, AListenerThatGoesAwayEndsTheWork) {
  Write("s.toml", Replaced(ScenarioText(""), "duration = 0.01", "duration = 50"));
  const Outcome o =
      Shell("cd " + folder_.string() + " && bash -c '(" + AMBRIG_BINARY +
            " run s.toml --quiet --no-report --events 3; echo code $?) 3> >(head -n 1)'");
  EXPECT_THAT(o.text, HasSubstr("code 130"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out" / "s.h5"));
}

TEST_F(CommandEvents, ProvenanceNamesEveryInputWithItsHash) {
  Write("other.toml", ScenarioText("seed = 2\n"));
  ASSERT_EQ(Ambrig("run s.toml other.toml --no-report --quiet").exit, 0);
  const json first = JsonOf("out/s.json")["provenance"],
             second = JsonOf("out/other.json")["provenance"];
  EXPECT_EQ(first["inputs"].size(), 2u) << first;  // its own, not the other scenario's
  for (const char* file : {"s.toml", "rig.toml"})
    EXPECT_EQ(first["inputs"][file], HashText(ReadText(folder_ / file))) << file;
  EXPECT_TRUE(second["inputs"].contains("other.toml"));
  EXPECT_EQ(first["argv"][1], "run");
  EXPECT_EQ(first["build"].get<std::string>().size(), 40u);  // SHA-1 of the linker
  EXPECT_EQ(first["build"], second["build"]);
}

// FNV-1a of 64 bits: published test vectors.
TEST(HashText, IsFnv1a) {
  EXPECT_EQ(HashText(""), "cbf29ce484222325");
  EXPECT_EQ(HashText("a"), "af63dc4c8601ec8c");
  EXPECT_EQ(HashText("foobar"), "85944171f73967e8");
}

TEST_F(CommandEvents, RunsWithoutTracesKeepTheirBits) {
  ASSERT_EQ(Ambrig("run s.toml --quiet --out with").exit, 0);
  ASSERT_EQ(Ambrig("run s.toml --quiet --no-traces --out without").exit, 0);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "without" / "s.html"));
  EXPECT_EQ(Ambrig("diff with/s.h5 without/s.h5").exit, 0);
  const Outcome both = Ambrig("run s.toml --no-traces --html r.html");
  EXPECT_EQ(both.exit, 2);
  EXPECT_THAT(both.text, HasSubstr("without --no-traces"));
}

TEST_F(CommandEvents, ARigIsResolved) {
  const Outcome o = Ambrig("rig rig.toml --json rig.json");
  ASSERT_EQ(o.exit, 0);
  EXPECT_THAT(o.text, ::testing::ContainsRegex("bearings.A.gap +0.0004 sd 4e-06 m\n"));
  const json rig = JsonOf("rig.json");
  const json& coils = rig["bearings"][0]["coils"];
  ASSERT_EQ(coils.size(), 8u);
  for (int k = 0; k < 8; ++k) {  // poles from 22.5 degrees on, 45 apart
    const double angle = 22.5 + 45 * k;
    EXPECT_NEAR(coils[k]["angle_deg"].get<double>(), angle > 180 ? angle - 360 : angle, 1e-9);
  }
  EXPECT_EQ(coils[2]["name"], "A.coil3");
  EXPECT_EQ(rig["bearings"][1]["name"], "B");  // like = "A"
  EXPECT_EQ(rig["values"]["bearings.B.gap"]["value"], rig["values"]["bearings.A.gap"]["value"]);
  EXPECT_EQ(rig["values"]["rotor.mass"]["unit"], "kg");
}

TEST_F(CommandEvents, OfTwoRigsOnlyWhatDiffers) {
  EXPECT_EQ(Ambrig("diff rig.toml rig.toml").exit, 0);
  const json before = [&] {
    EXPECT_EQ(Ambrig("rig rig.toml --json r.json").exit, 0);
    return JsonOf("r.json");
  }();
  const double mass = before["values"]["rotor.mass"]["value"],
               sd = before["values"]["rotor.mass"]["sd"];
  Write("b.toml", ReferenceRigText() +
                      "\n[[effect]]\nname = \"cross-coupling\"\ntarget = \"A\"\nparameters = { "
                      "stiffness = -8.0e4 }\n");
  const Outcome effect = Ambrig("diff rig.toml b.toml --json d.json");
  EXPECT_EQ(effect.exit, 1);
  json d = JsonOf("d.json");
  ASSERT_EQ(d["differences"].size(), 1u) << d;
  EXPECT_EQ(d["differences"][0]["what"], "effect cross-coupling at A: stiffness");
  EXPECT_EQ(d["differences"][0]["a"], "");
  EXPECT_EQ(d["differences"][0]["b"], "-80000");
  // A calibrated value is what simulates.
  const std::string text = ReferenceRigText();
  const auto at = text.find("\nmass = {"), close = text.find('}', at);
  ASSERT_NE(at, std::string::npos);
  std::string fitted = text;
  fitted.insert(close, ", fitted = " + std::to_string(mass + 2 * sd));
  Write("b.toml", fitted);
  EXPECT_EQ(Ambrig("diff rig.toml b.toml --json d.json").exit, 1);
  d = JsonOf("d.json");
  ASSERT_EQ(d["differences"].size(), 1u) << d;
  EXPECT_EQ(d["differences"][0]["what"], "rotor.mass");
  EXPECT_NEAR(d["differences"][0]["sds"].get<double>(), 2, 1e-3);
}

// The series' rms is the table's number: error over noise and rms error of every channel.
TEST_F(CommandEvents, TheSeriesAreThoseOfTheTable) {
  ASSERT_EQ(Ambrig("hide cross-coupling@A --rig rig.toml -o practice --seed 3").exit, 0);
  ASSERT_EQ(Ambrig("compare practice/case.toml --no-blocks --json c.json --series series.h5").exit,
            0);
  const json table = JsonOf("c.json")["records"];
  std::size_t channels = 0;
  for (std::size_t r = 0; r < table.size(); ++r) {
    const Record series =
        ReadHdf5Group((folder_ / "series.h5").string(), "record-" + std::to_string(r + 1));
    const std::string name = "practice/record-" + std::to_string(r + 1) + ".h5";
    EXPECT_EQ(series.rate, ReadHdf5((folder_ / name).string()).rate);
    for (const auto& [channel, row] : table[r]["channels"].items()) {
      const Channel *measured = series.Find(channel + ".measured"),
                    *model = series.Find(channel + ".model"),
                    *error = series.Find(channel + ".error");
      ASSERT_TRUE(measured && model && error) << channel;
      double square = 0, difference = 0;
      std::size_t count = 0;
      for (std::size_t k = 0; k < series.rows(); ++k) {
        if (std::isnan(error->samples[k])) continue;
        square += error->samples[k] * error->samples[k];
        difference += std::pow(measured->samples[k] - model->samples[k], 2);
        ++count;
      }
      ASSERT_GT(count, 0u);
      const double n = static_cast<double>(count);
      EXPECT_NEAR(std::sqrt(square / n), row["ratio"].get<double>(),
                  1e-6 * row["ratio"].get<double>())
          << channel;
      EXPECT_NEAR(std::sqrt(difference / n), row["rms_error"].get<double>(),
                  1e-6 * row["rms_error"].get<double>())
          << channel;
      ++channels;
    }
  }
  EXPECT_GT(channels, 50u);
}

}  // namespace
}  // namespace ambrig
