// Every number of a scenario, wrong in every way that its range forbids; contradicting entries.
#include <fmt/format.h>

#include <filesystem>

#include "core/record/csv.h"
#include "rig/rig_file.h"
#include "scenarios/scenario.h"
#include "tests/cli/bad_inputs/bad_input.h"
#include "tests/cli/cli_run.h"

namespace ambrig {
namespace {

/// One number of a scenario: a text that is good with `good` for the $ sign.
struct Number {
  const char *key, *text, *good;
  double lo, hi;
};

constexpr const char* kBase = "rig = \"rig.toml\"\nduration = 0.01\n";
const Number kNumbers[] = {
    {"duration", "rig = \"rig.toml\"\nduration = $\n", "0.01", 1e-6, 1e5},
    {"record_rate", "record_rate = $\n", "12500.0", 100, 1e9},
    {"drop_limit", "drop_limit = $\n", "0.1", 1e-6, 1e5},
    {"speed.free_from", "[speed]\nprofile = [[0.0, 1.0]]\nfree_from = $\n", "0.1", -1e5, 1e5},
    {"excitation[1].start",
     "[[excitation]]\ntarget = \"A.x\"\nkind = \"step\"\namplitude = 1.0\nstop = 0.009\nstart = "
     "$\n",
     "0.001", -1e5, 1e5},
    {"excitation[1].stop",
     "[[excitation]]\ntarget = \"A.x\"\nkind = \"step\"\namplitude = 1.0\nstop = $\n", "0.005",
     -1e5, 1e5},
    {"excitation[1].amplitude",
     "[[excitation]]\ntarget = \"A.x\"\nkind = \"step\"\namplitude = $\n", "1.0", -1e8, 1e8},
    {"excitation[1].amplitude",
     "[[excitation]]\ntarget = \"A.x\"\nport = \"reference\"\nkind = \"step\"\namplitude = $\n",
     "1e-6", -1, 1},
    {"excitation[1].amplitude",
     "[[excitation]]\ntarget = \"A.coil1\"\nport = \"current\"\nkind = \"step\"\namplitude = $\n",
     "1.0", -1e4, 1e4},
    {"excitation[1].amplitude",
     "[[excitation]]\ntarget = \"A.coil1\"\nport = \"duty\"\nkind = \"step\"\namplitude = $\n",
     "0.1", -2, 2},
    {"excitation[1].frequency",
     "[[excitation]]\ntarget = \"A.x\"\nkind = \"sine\"\namplitude = 1.0\nfrequency = $\n", "50.0",
     0, 1e6},
    {"excitation[1].phase",
     "[[excitation]]\ntarget = \"A.x\"\nkind = \"sine\"\namplitude = 1.0\nfrequency = 5.0\nphase = "
     "$\n",
     "0.5", -1e4, 1e4},
    {"excitation[1].f0",
     "[[excitation]]\ntarget = \"A.x\"\nkind = \"chirp\"\namplitude = 1.0\nf1 = 5.0\nf0 = $\n",
     "1.0", 0, 1e6},
    {"excitation[1].f1",
     "[[excitation]]\ntarget = \"A.x\"\nkind = \"chirp\"\namplitude = 1.0\nf0 = 5.0\nf1 = $\n",
     "9.0", 0, 1e6},
    {"load[1].z", "[[load]]\nforce = [1.0, 0.0]\nz = $\n", "0.05", -0.37, 0.38},
    {"load[1].start", "[[load]]\nplane = \"A\"\nforce = [1.0, 0.0]\nstop = 0.009\nstart = $\n",
     "0.001", -1e5, 1e5},
    {"load[1].stop", "[[load]]\nplane = \"A\"\nforce = [1.0, 0.0]\nstop = $\n", "0.005", -1e5, 1e5},
    {"load[1].force", "[[load]]\nplane = \"Z\"\nforce = [$]\n", "1.0", -1e8, 1e8},
    {"expect.detected_within", "[expect]\ndetected_within = $\n", "0.001", 0, 1e5},
    {"expect.max_orbit", "[expect]\nmax_orbit = $\n", "1e-4", 0, 1},
    {"expect.max_false_alarms", "[expect]\nmax_false_alarms = $\n", "0", 0, 1e9},
    {"expect.rests_within", "[expect]\nrests_within = $\n", "1e-4", 0, 1},
    {"fault[1].time", "[[fault]]\ntarget = \"A.coil1\"\nkind = \"open\"\ntime = $\n", "0.005", 0,
     0.0099},
    {"fault[1].parameters.fraction",
     "[[fault]]\ntime = 0.0\ntarget = \"A.coil1\"\nkind = \"partial-short\"\nparameters = { "
     "fraction = $ }\n",
     "0.5", 0, 1},
    {"fault[1].parameters.gain",
     "[[fault]]\ntime = 0.0\ntarget = \"A.coil1\"\nkind = \"current-sensor\"\nparameters = { gain "
     "= $ }\n",
     "0.5", -100, 100},
    {"fault[1].parameters.offset",
     "[[fault]]\ntime = 0.0\ntarget = \"A.coil1\"\nkind = \"current-sensor\"\nparameters = { "
     "offset = $ }\n",
     "0.5", -1e4, 1e4},
    {"fault[1].parameters.offset",
     "[[fault]]\ntime = 0.0\ntarget = \"A.x\"\nkind = \"position-sensor\"\nparameters = { offset = "
     "$ }\n",
     "1e-5", -1, 1},
    {"fault[1].parameters.voltage",
     "[[fault]]\ntime = 0.0\nkind = \"bus-sag\"\nparameters = { voltage = $ }\n", "20.0", 0, 1e5},
};

std::string Text(const Number& n, const std::string& value) {
  const std::string text = Replaced(n.text, "$", value);
  return text.starts_with("rig") ? text : kBase + text;
}

class BadScenarioInputs : public CliFolder {
 protected:
  void SetUp() override {
    CliFolder::SetUp();
    Write("rig.toml", ReferenceRigText());
    rig_ = ReadRigText(ReferenceRigText(), "rig.toml");
  }
  void Read(const std::string& text) const {
    ReadScenarioText(text, (folder_ / "s.toml").string(), rig_);
  }
  std::size_t Refused(const std::vector<BadInput>& all) const {
    return ExpectRefused(all, [&](const std::string& text) { Read(text); });
  }
  RigParameters rig_;
};

TEST_F(BadScenarioInputs, EveryNumber) {
  std::vector<BadInput> all;
  for (const Number& n : kNumbers) {
    EXPECT_NO_THROW(Read(Text(n, n.good))) << n.key;
    const std::string key(n.key), last = key.substr(key.rfind('.') + 1);
    for (const BadValue& bad : BadValues(n.lo, n.hi))
      all.push_back({key + " " + bad.kind, Text(n, bad.toml), {"s.toml:", key, "allowed"}});
    all.push_back({key + " misspelt",
                   Replaced(Text(n, n.good), last + " = ", last + "x = "),
                   {"s.toml:", last}});
  }
  EXPECT_GE(Refused(all), 200U);
}

TEST_F(BadScenarioInputs, Contradictions) {
  const std::string base = kBase;
  const std::string open = "[[fault]]\ntime = 0.005\ntarget = \"A.coil1\"\nkind = \"open\"\n";
  EXPECT_NO_THROW(Read(base + open +
                       "[[fault]]\ntime = 0.005\ntarget = \"A.coil1\"\nkind = "
                       "\"current-sensor\"\nparameters = { gain = 0.5 }\n"));
  Refused({
      {"two states of a coil",
       base + open + Replaced(open, "open", "switch-stuck-on"),
       {"fault[2].kind = \"switch-stuck-on\" on A.coil1 at 0.005 s", "open", "allowed: one"}},
      {"one fault twice", base + open + open, {"fault[2].kind", "allowed: one of them"}},
      {"force of a load",
       base + "[[load]]\nplane = \"A\"\nforce = [1e30, 0.0]\n",
       {"load[1].force = 1e+30 N", "allowed -100000000 to 100000000 N"}},
      {"place of a load",
       base + "[[load]]\nz = 100.0\nforce = [1.0, 0.0]\n",
       {"load[1].z = 100 m", "a place on the shaft"}},
      {"rate of the record", base + "record_rate = 1e-6\n", {"record_rate = 1e-06 Hz", "allowed"}},
      {"no frequencies",
       base + "[[excitation]]\ntarget = \"A.x\"\nkind = \"multisine\"\n"
              "amplitude = 1.0\nfrequencies = []\n",
       {"frequencies = []", "allowed"}},
      {"rig with a zero byte",
       "rig = \"rig.toml\\u0000.txt\"\nduration = 0.01\n",
       {"s.toml:1: rig", "control character"}},
  });
}

/// A column's unit is that of the port, converted, or refused.
TEST_F(BadScenarioInputs, SamplesHaveTheUnitOfTheirPort) {
  const auto text = [&](const char* port, const char* file) {
    return kBase + fmt::format(
                       "[[excitation]]\ntarget = \"A.x\"\nport = \"{}\"\nkind = "
                       "\"samples\"\nfile = \"{}\"\nchannel = \"a\"\n",
                       port, file);
  };
  Write("um.csv", "t [s],a [um]\n0,20\n0.005,20\n0.01,20\n");
  Write("kN.csv", "t [s],a [kN]\n0,0.02\n0.005,0.02\n0.01,0.02\n");
  Write("none.csv", "t [s],a\n0,20\n0.005,20\n0.01,20\n");
  Write("banana.csv", "t [s],a [banana]\n0,20\n0.005,20\n0.01,20\n");
  const auto value = [&](const char* port, const char* file) {
    return ReadScenarioText(text(port, file), (folder_ / "s.toml").string(), rig_)
        .excitations.at(0)
        .Value(0.002);
  };
  EXPECT_DOUBLE_EQ(value("reference", "um.csv"), 20e-6);
  EXPECT_DOUBLE_EQ(value("force", "kN.csv"), 20);
  EXPECT_DOUBLE_EQ(value("force", "none.csv"), 20);
  Refused({{"wrong quantity", text("reference", "kN.csv"), {"port reference", "unit kN", "um"}},
           {"no unit at all", text("force", "banana.csv"), {"unit banana", "allowed N, kN"}},
           {"micrometres as a force", text("force", "um.csv"), {"unit um", "allowed N"}},
           {"twenty metres", text("reference", "none.csv"), {"holds 20 m", "allowed -1 to 1 m"}},
           {"no file", text("force", "x.csv"), {"excitation[1].file = \"x.csv\"", "no such file"}},
           {"no column",
            Replaced(text("force", "um.csv"), "\"a\"", "\"b\""),
            {"channel = \"b\" is not in", "allowed: a"}}});
}

}  // namespace
}  // namespace ambrig
