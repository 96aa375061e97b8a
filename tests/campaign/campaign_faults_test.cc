// Which coils fail, how and when: the lists that [faults] of a campaign file stands for.
#include "campaign/campaign_faults.h"

#include <gmock/gmock.h>

#include <algorithm>

#include "campaign/row.h"
#include "campaign/run_plan.h"
#include "tests/campaign/campaign_folder.h"

namespace ambrig::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class CampaignFaults : public ::testing::Test {
 protected:
  Campaign Read(const std::string& faults, const std::string& more = "") const {
    folder_.Write("c.toml", "rig = \"rig.toml\"\nduration = 0.2\n[faults]\n" + faults + more);
    return ReadCampaign(folder_.File("c.toml"));
  }
  std::string Said(const std::string& faults) const {
    return ErrorText<InputError>([&] { Read(faults); });
  }
  CampaignFolder folder_;
};

std::vector<std::string> SetNames(const Campaign& c) {
  std::vector<std::string> out;
  for (const FailureSet& s : c.sets) out.push_back(SetText(s));
  return out;
}

// Without [faults] the machine is healthy, in one case.
TEST_F(CampaignFaults, WithoutATableNothingFails) {
  folder_.Write("c.toml", "rig = \"rig.toml\"\nduration = 0.2\n");
  const Campaign c = ReadCampaign(folder_.File("c.toml"));
  EXPECT_THAT(SetNames(c), ElementsAre("A:healthy"));
  EXPECT_EQ(c.runs(), 1u);
  EXPECT_EQ(c.kinds.front().kind, "none");
}

TEST_F(CampaignFaults, NamedSetsHaveAllSetsOfThatSize) {
  EXPECT_EQ(Read("sets = \"single\"\n").sets.size(), 8u);
  EXPECT_EQ(Read("sets = \"double\"\n").sets.size(), 28u);
  EXPECT_EQ(Read("sets = \"triple\"\n").sets.size(), 56u);
  EXPECT_EQ(Read("sets = \"quadruple\"\n").sets.size(), 70u);
  EXPECT_EQ(Read("sets = \"all\"\n").sets.size(), 255u);
  EXPECT_EQ(Read("sets = \"none\"\n").sets.size(), 1u);
  EXPECT_EQ(Read("sets = \"single\"\nbearings = [\"B\", \"A\"]\n").sets.size(), 16u);
}

// Coils in any order are one set; the kind is an open coil where none is given.
TEST_F(CampaignFaults, SetsMayBeListed) {
  const Campaign c = Read("sets = [[3], [5, 2]]\nbearings = [\"B\"]\n");
  EXPECT_THAT(SetNames(c), ElementsAre("B:3", "B:2+5"));
  ASSERT_EQ(c.kinds.size(), 1u);
  EXPECT_EQ(c.kinds[0].kind, "open");
  EXPECT_EQ(c.runs(), 2u);
}

// Labels carry the parameters: two shorts of different size are two kinds of a table.
TEST_F(CampaignFaults, KindsHaveTheirParametersInTheirLabel) {
  const Campaign c = Read(
      "sets = [[1]]\n[[faults.kind]]\nkind = \"partial-short\"\nparameters = { fraction = 0.5 }\n"
      "[[faults.kind]]\nkind = \"partial-short\"\nparameters = { fraction = 0.1 }\n");
  ASSERT_EQ(c.kinds.size(), 2u);
  EXPECT_EQ(c.kinds[0].label, "partial-short fraction=0.5");
  EXPECT_EQ(c.kinds[1].label, "partial-short fraction=0.1");
  EXPECT_EQ(c.kinds[1].parameters.at("fraction"), 0.1);
  EXPECT_EQ(c.runs(), 2u);
}

// A healthy run among faulty ones is one case, whatever the kinds and onsets.
TEST_F(CampaignFaults, HealthyIsOneCaseAmongTheOthers) {
  const Campaign c = Read(
      "healthy = true\nsets = [[1], [1, 2]]\nonset = [\"simultaneous\", \"sequential\"]\n"
      "[[faults.kind]]\nkind = \"open\"\n[[faults.kind]]\nkind = \"amplifier-off\"\n");
  // healthy 1; {1}: two kinds, one onset; {1, 2}: two kinds, two onsets
  EXPECT_EQ(c.cases.size(), 1u + 2 + 4);
  EXPECT_EQ(std::count_if(c.cases.begin(), c.cases.end(),
                          [&](const FaultCase& f) { return c.kinds[f.kind].kind == "none"; }),
            1);
  EXPECT_EQ(std::count_if(c.cases.begin(), c.cases.end(),
                          [](const FaultCase& f) { return f.sequential; }),
            2);
}

TEST_F(CampaignFaults, OnsetsAreTakenOnceEach) {
  EXPECT_EQ(Read("sets = [[1, 2]]\nonset = [\"sequential\", \"sequential\"]\n").cases.size(), 1u);
  EXPECT_TRUE(Read("sets = [[1, 2]]\nonset = \"sequential\"\n").cases[0].sequential);
}

// Faults in sequence come `spacing` apart, in the order of the coils, at the phase of the period.
TEST_F(CampaignFaults, TimesOfASequence) {
  const RunPlan plan(
      Read("sets = [[7, 2, 4]]\nonset = \"sequential\"\ntime = 0.05\nspacing = 0.01\n"
           "phases = [0.25]\n"));
  const PlannedRun p = plan.Make(0);
  ASSERT_EQ(p.scenario.faults.size(), 3u);
  const char* const coils[] = {"A.coil2", "A.coil4", "A.coil7"};
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(p.scenario.faults[k].target, coils[k]);
    EXPECT_NEAR(p.scenario.faults[k].time, 0.05 + 0.01 * static_cast<double>(k) + 0.25 / 12500,
                1e-12);
  }
  EXPECT_EQ(p.bearing, "A");
}

// The least that theory says of a set: its class and what it carries.
TEST_F(CampaignFaults, TheoryOfTheSets) {
  const RunPlan plan(Read("healthy = true\nsets = [[1], [1, 2, 3, 4, 5, 6, 7, 8]]\n"));
  ASSERT_EQ(plan.campaign().runs(), 3u);
  const PlannedRun healthy = plan.Make(0), one = plan.Make(1), all = plan.Make(2);
  EXPECT_EQ(healthy.theory.cls, "healthy");
  EXPECT_EQ(healthy.theory.capacity, 60);  // the controller's limit
  EXPECT_THAT(healthy.scenario.faults, IsEmpty());
  EXPECT_EQ(one.theory.cls, "exact");
  EXPECT_GT(one.theory.capacity, 0);
  EXPECT_LE(one.theory.capacity, 60);
  EXPECT_EQ(all.theory.cls, "none");
  EXPECT_EQ(all.theory.capacity, 0);
  EXPECT_EQ(all.scenario.faults.size(), 8u);
  EXPECT_THROW(plan.Make(3), std::logic_error);
}

// A thrust bearing has four windings, two on each side. One that opens leaves its side the other,
// at twice the current; a side without any pulls one way only.
TEST_F(CampaignFaults, TheThrustBearingHasSetsOfItsFourWindings) {
  EXPECT_EQ(Read("sets = \"single\"\nbearings = [\"Z\"]\n").sets.size(), 4u);
  EXPECT_EQ(Read("sets = \"double\"\nbearings = [\"Z\"]\n").sets.size(), 6u);
  EXPECT_EQ(Read("sets = \"single\"\nbearings = [\"A\", \"Z\"]\n").sets.size(), 8u + 4);
  const RunPlan plan(
      Read("healthy = true\nsets = [[1], [1, 2], [1, 2, 3, 4]]\nbearings = [\"Z\"]\n",
           "[operation]\nloads = [0.5]\n"));
  const PlannedRun healthy = plan.Make(0), one = plan.Make(1), side = plan.Make(2),
                   all = plan.Make(3);
  EXPECT_EQ(healthy.theory.cls, "healthy");
  EXPECT_EQ(one.theory.cls, "exact");
  EXPECT_EQ(one.theory.capacity, 120);  // f_max of its own controller
  EXPECT_EQ(side.theory.cls, "one way");
  EXPECT_EQ(side.theory.capacity, 0);
  EXPECT_EQ(all.theory.cls, "none");
  EXPECT_EQ(one.scenario.faults.front().target, "Z.coil1");
  // The load acts along the shaft, which has no weight there: half of the capacity, in steps.
  double pulled = 0;
  for (const LoadSpec& l : one.scenario.loads) {
    EXPECT_TRUE(l.axial);
    EXPECT_EQ(l.fx, 0);
    EXPECT_EQ(l.fy, 0);
    pulled += l.fz;
  }
  EXPECT_NEAR(pulled, 60, 60 * 12 * 1e-15);  // rounding of 12 summands
}

TEST_F(CampaignFaults, MistakesAreOneLine) {
  const std::pair<const char*, const char*> mistakes[] = {
      {"sets = [[0]]\n", "faults.sets = [..0..] in set 1, allowed: different coils from 1 to 8"},
      {"sets = [[1], [1.5]]\n", "in set 2"},
      {"sets = [[3, 3]]\n", "[..3..] in set 1"},
      {"sets = []\n", "faults.sets = [], allowed: e.g. [[1], [1, 2]]"},
      {"bearings = []\n", "faults.bearings = [], allowed: some of A, B, Z"},
      {"bearings = [\"A\", \"A\"]\n", "allowed: each once of A, B, Z"},
      {"sets = [[1], [2, 5]]\nbearings = [\"A\", \"Z\"]\n",
       "faults.sets = [..5..] with bearing Z, allowed: its coils, 1 to 4"},
      {"sets = [[1]]\nonset = []\n", "faults.onset = [], allowed: simultaneous, sequential"},
      {"sets = [[1]]\nonset = \"later\"\n", "faults.onset = \"later\", allowed: simultaneous"},
      {"[[faults.kind]]\nkind = \"open\"\n", "is given, but sets = \"none\"; allowed: other sets"},
      {"sets = [[1]]\n[[faults.kind]]\nkind = \"bus-sag\"\n", "allowed: "},
      {"sets = [[1, 2]]\nonset = \"sequential\"\ntime = 0.15\nspacing = 0.06\n",
       "the last fault comes at 0.21008 s, allowed: below the duration of 0.2 s"},
      {"sets = [[1]]\nphases = [1.5]\n", "faults.phases = 1.5, allowed: 0 to 1"},
      {"sets = [[1]]\nspacing = 0\n", "faults.spacing = 0, allowed: 1e-06 to"},
      {"sets = [[1]]\ncolour = 1\n", "faults.colour: unknown key"},
  };
  for (const auto& [text, said] : mistakes) {
    const std::string line = Said(text);
    EXPECT_THAT(line, HasSubstr(said)) << text;
    EXPECT_THAT(line, HasSubstr("c.toml:")) << text;
    EXPECT_EQ(line.find('\n'), std::string::npos) << line;
  }
}

}  // namespace
}  // namespace ambrig::testing
