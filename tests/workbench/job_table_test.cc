// What reaches a command line: the commands and arguments of the table, files of the folder,
// nothing else.
#include "workbench/job_table.h"

#include <gmock/gmock.h>

#include "core/base/errors.h"
#include "tests/workbench/bench_folder.h"

namespace ambrig::workbench {
namespace {

using nlohmann::json;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

class JobTable : public BenchFolder {
 protected:
  void SetUp() override {
    BenchFolder::SetUp();
    Write("served/rig.toml", "name = \"r\"\n");
    Write("served/s.toml", "rig = \"rig.toml\"\n");
    Write("served/case.toml",
          "rig = \"rig.toml\"\n[[record]]\nscenario = \"s.toml\"\ndata = \"sub/b.csv\"\n");
  }
  std::string Refusal(const json& request) const {
    try {
      CheckJob(request, ServedFolder(served()), ".ambrig/jobs/1");
    } catch (const InputError& e) {
      return e.what();
    }
    return "";
  }
};

TEST_F(JobTable, MakesTheCommandThatAPersonCouldType) {
  const ServedFolder folder(served());
  const JobOrder order = CheckJob({{"command", "adopt"},
                                   {"case", "case.toml"},
                                   {"effect", "cross-coupling"},
                                   {"target", "A"},
                                   {"rig", "rig_2.toml"},
                                   {"new_case", "case_2.toml"}},
                                  folder, ".ambrig/jobs/1");
  EXPECT_THAT(order.arguments, ElementsAre("adopt", "case.toml", "cross-coupling", "--target", "A",
                                           "--output", "rig_2.toml", "--case", "case_2.toml",
                                           "--html", ".ambrig/jobs/1/report.html"));
  EXPECT_EQ(order.subject, "case.toml");
  EXPECT_THAT(order.new_files, ElementsAre("rig_2.toml", "case_2.toml"));
}

TEST_F(JobTable, RefusesWhatIsNotInIt) {
  EXPECT_THAT(Refusal({{"command", "score"}, {"case", "case.toml"}}),
              HasSubstr("allowed: compare"));
  EXPECT_THAT(Refusal({{"command", "sh"}}), HasSubstr("command: allowed"));
  EXPECT_THAT(Refusal({{"command", 1}}), HasSubstr("command: allowed"));
  EXPECT_THAT(Refusal(json::array()), HasSubstr("command: allowed"));
  EXPECT_THAT(Refusal({{"command", "compare"}}), HasSubstr("case: is missing"));
  EXPECT_THAT(Refusal({{"command", "compare"}, {"case", "case.toml"}, {"--force", "x"}}),
              HasSubstr("is no argument of compare"));
  EXPECT_THAT(Refusal({{"command", "compare"}, {"case", {"case.toml"}}}),
              HasSubstr("allowed: a file"));
}

TEST_F(JobTable, ArgumentsAreNoOptionsAndNoPaths) {
  for (const char* effect : {"--force", "-o", "", "a b", "../x", "x;y", "$(id)", "a\nb"})
    EXPECT_NE(Refusal({{"command", "adopt"},
                       {"case", "case.toml"},
                       {"effect", effect},
                       {"rig", "r2.toml"},
                       {"new_case", "c2.toml"}}),
              "")
        << effect;
  for (const char* file :
       {"../x.toml", "/tmp/x.toml", "-x.toml", "x.h5", ".x.toml", "case.toml", "sub/../x.toml"})
    EXPECT_NE(Refusal({{"command", "adopt"},
                       {"case", "case.toml"},
                       {"effect", "e"},
                       {"rig", file},
                       {"new_case", "c2.toml"}}),
              "")
        << file;
  EXPECT_NE(Refusal({{"command", "explain"}, {"case", "case.toml"}, {"candidates", "5; id"}}), "");
  EXPECT_NE(Refusal({{"command", "explain"}, {"case", "case.toml"}, {"candidates", -1}}), "");
}

// A file of the folder may not lead a command out of it, however deep the reference lies.
TEST_F(JobTable, FilesThatNameOthersOutsideAreRefused) {
  EXPECT_EQ(Refusal({{"command", "compare"}, {"case", "case.toml"}}), "");
  Write("served/s.toml", "rig = \"../other/secret.toml\"\n");
  EXPECT_THAT(Refusal({{"command", "compare"}, {"case", "case.toml"}}),
              HasSubstr("outside the served folder"));
  Write("served/s.toml", "rig = \"rig.toml\"\n[[excitation]]\nfile = \"" +
                             (base_ / "other/secret.toml").string() + "\"\n");
  EXPECT_THAT(Refusal({{"command", "compare"}, {"case", "case.toml"}}),
              HasSubstr("outside the served folder"));
  Write("served/s.toml", "rig = \"rig.toml\"\n[[excitation]]\nfile = \"link.csv\"\n");
  std::filesystem::create_symlink(base_ / "other" / "secret.toml", base_ / "served" / "link.csv");
  EXPECT_THAT(Refusal({{"command", "compare"}, {"case", "case.toml"}}), HasSubstr("is a link"));
}

// A campaign lists its scenarios; what an absolute name of the folder means lies in it.
TEST_F(JobTable, ListsOfFilesAndAbsoluteNamesAreFollowed) {
  Write("served/c.toml",
        "rig = \"rig.toml\"\nscenarios = [\"s.toml\", \"../other/secret.toml\"]\n");
  EXPECT_THAT(Refusal({{"command", "campaign"}, {"campaign", "c.toml"}}),
              HasSubstr("outside the served folder"));
  Write("served/c.toml", "rig = \"" + served() + "/rig.toml\"\nscenarios = [\"s.toml\"]\n");
  EXPECT_EQ(Refusal({{"command", "campaign"}, {"campaign", "c.toml"}}), "");
}

// What an interrupted campaign left is found again, unless a file that it names has changed.
TEST_F(JobTable, EqualWorkSharesItsFolder) {
  const ServedFolder folder(served());
  Write("served/c.toml", "rig = \"rig.toml\"\nseeds = 2\n");
  const auto out = [&](const std::string& job) {
    const auto a =
        CheckJob({{"command", "campaign"}, {"campaign", "c.toml"}}, folder, job).arguments;
    return *(std::find(a.begin(), a.end(), "--out") + 1);
  };
  const std::string first = out(".ambrig/jobs/1");
  EXPECT_THAT(first, HasSubstr(".ambrig/work/campaign-"));
  EXPECT_EQ(out(".ambrig/jobs/2"), first);
  Write("served/rig.toml", "name = \"other\"\n");
  EXPECT_NE(out(".ambrig/jobs/3"), first);
}

// The playground's scenario stands in the job's folder and names the same files.
TEST_F(JobTable, AScenarioOfTheJobNamesTheSameFiles) {
  const ServedFolder folder(served());
  const auto order = [&](const std::string& text) {
    return CheckJob({{"command", "play"}, {"scenario", {{"beside", "s.toml"}, {"text", text}}}},
                    folder, ".ambrig/jobs/7");
  };
  const JobOrder o = order("rig = \"rig.toml\"  # mine\n[[excitation]]\nfile = \"sub/b.csv\"\n");
  EXPECT_THAT(o.arguments, ElementsAre("run", ".ambrig/jobs/7/s.toml", "--out",
                                       ".ambrig/jobs/7/run", "--quiet", "--no-traces"));
  EXPECT_EQ(o.subject, "s.toml");
  ASSERT_EQ(o.texts.size(), 1u);
  EXPECT_EQ(o.texts[0].first, "s.toml");
  EXPECT_EQ(o.texts[0].second,
            "rig = \"../../../rig.toml\"  # mine\n[[excitation]]\nfile = \"../../../sub/b.csv\"\n");
  EXPECT_THROW(order("rig = \"../other/secret.toml\"\n"), InputError);
  EXPECT_THROW(order("rig = "), InputError);
  EXPECT_THROW(
      CheckJob({{"command", "play"}, {"scenario", {{"beside", "../s.toml"}, {"text", ""}}}}, folder,
               ".ambrig/jobs/7"),
      InputError);
}

TEST_F(JobTable, AnswersOfTheWizardAreNumbersAndColumns) {
  const ServedFolder folder(served());
  const JobOrder o = CheckJob({{"command", "new"},
                               {"template", "one-axis"},
                               {"numbers", {{"mass", 0.5}}},
                               {"columns", {{"A.x", "my pos:um:-1"}}},
                               {"folder", "bench"}},
                              folder, ".ambrig/jobs/7");
  EXPECT_THAT(o.arguments, ElementsAre("new", "--template", "one-axis", "--answers",
                                       ".ambrig/jobs/7/answers.toml", "--column",
                                       "A.x=my pos:um:-1", "--out", "bench", "--only-files"));
  EXPECT_EQ(o.texts[0].second, "mass = 0.5\n");
  EXPECT_FALSE(o.events);
  const auto refused = [&](const json& change) {
    json request = {{"command", "new"},
                    {"template", "one-axis"},
                    {"numbers", {{"mass", 0.5}}},
                    {"folder", "bench"}};
    request.update(change);
    return Refusal(request);
  };
  EXPECT_NE(refused({{"numbers", {{"a = 1\nb", 2}}}}), "");
  EXPECT_NE(refused({{"numbers", {{"mass", "1"}}}}), "");
  EXPECT_NE(refused({{"columns", {{"--force", "x"}}}}), "");
  EXPECT_NE(refused({{"columns", {{"A.x", "a\nb"}}}}), "");
  for (const char* name : {"sub", "../x", "/tmp/x", ".hidden", "a.toml", "bench/"})
    EXPECT_NE(refused({{"folder", name}}), "") << name;
}

TEST_F(JobTable, FilesThatNameEachOtherAreRead) {
  Write("served/s.toml", "rig = \"case.toml\"\n");
  EXPECT_EQ(Refusal({{"command", "compare"}, {"case", "case.toml"}}), "");
}

}  // namespace
}  // namespace ambrig::workbench
