// Simulations on disk: the same bits without simulating again, half entries dropped, others
// refused.
#include "discovery/model/run_store.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "core/base/errors.h"
#include "discovery/model/case_model.h"

namespace ambrig {
namespace {

namespace fs = std::filesystem;

class RunStoreTest : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() /
              ("ambrig_store_" + std::to_string(::getpid()) + "_" +
               ::testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::create_directories(folder_);
    fs::copy_file(std::string(AMBRIG_SOURCE_DIR) + "/scenarios/library/rigs/reference.toml",
                  folder_ / "rig.toml");
    for (const char* name : {"one", "two"}) {
      Write(std::string(name) + ".toml", "rig = \"rig.toml\"\nduration = 0.01\n");
      Write(std::string(name) + ".csv", Data());
    }
    Write("case.toml", CaseText("0.001"));
  }
  void TearDown() override { fs::remove_all(folder_); }

  void Write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
  }
  static std::string Data() {
    std::string text = "time [s],A.x [um],B.y [um]\n";
    for (int k = 0; k < 100; ++k)
      text += std::to_string(1e-4 * k) + "," + std::to_string(k % 7) + "," + std::to_string(k % 5) +
              "\n";
    return text;
  }
  static std::string CaseText(const std::string& noise) {
    return "rig = \"rig.toml\"\nnoise = { \"bus\" = " + noise + " }\n" +
           "[[record]]\nscenario = \"one.toml\"\ndata = \"one.csv\"\nuse = "
           "\"fit\"\n[[record]]\nscenario = \"two.toml\"\ndata = \"two.csv\"\nuse = \"validate\"\n";
  }
  Case Read() const { return ReadCase((folder_ / "case.toml").string()); }
  std::string Store() const { return (folder_ / "store").string(); }

  fs::path folder_;
};

/// The rig file's hypothesis and one with an effect.
std::vector<Hypothesis> Hypotheses(const Case& c) {
  const Hypothesis base = Hypothesis::Base(c.rig);
  Hypothesis moved = base;
  moved.Set(0, moved.free[0].value + 0.5 * moved.free[0].sd);
  return {base, moved};
}

/// What the hypotheses predict, simulated into a store that is closed again.
std::vector<std::optional<std::vector<double>>> KeptPredictions(const Case& c,
                                                                const std::string& folder) {
  CaseModel model(c);
  RunStore store(folder, c);
  model.store = &store;
  return model.PredictAll(Hypotheses(c));
}

TEST_F(RunStoreTest, SameBitsWithoutSimulating) {
  const Case c = Read();
  CaseModel plain(c), first(c), second(c);
  const auto wanted = plain.PredictAll(Hypotheses(c));
  const auto noisy = plain.PredictNoisy(Hypotheses(c)[0], 3);
  {
    RunStore store(Store(), c);
    first.store = &store;
    EXPECT_EQ(first.PredictAll(Hypotheses(c)), wanted);
    EXPECT_EQ(first.PredictNoisy(Hypotheses(c)[0], 3), noisy);
    EXPECT_EQ(store.size(), 6U);  // three hypotheses, noise being one, of two records
  }
  RunStore store(Store(), c);
  second.store = &store;
  EXPECT_EQ(second.PredictAll(Hypotheses(c)), wanted);
  EXPECT_EQ(second.PredictNoisy(Hypotheses(c)[0], 3), noisy);
  EXPECT_EQ(second.runs, 0);
}

TEST_F(RunStoreTest, AnotherHypothesisIsAnotherEntry) {
  const Case c = Read();
  CaseModel plain(c), stored(c);
  RunStore store(Store(), c);
  stored.store = &store;
  stored.Predict(Hypotheses(c)[0]);
  Hypothesis other = Hypotheses(c)[0];
  other.Set(1, std::nextafter(other.free[1].value, 1e9));
  EXPECT_EQ(stored.Predict(other), plain.Predict(other));
  EXPECT_EQ(stored.runs, 4);
}

// A search may set the size of an input or a clock right and go on with the same store.
TEST_F(RunStoreTest, AnotherSizeOfTheInputOrClockIsAnotherEntry) {
  const Case c = Read();
  RunStore store(Store(), c);
  std::vector<Excitation> inputs(1);
  inputs[0].amplitude = 2;
  const double kept[] = {1, 2};
  const RunKey key{c.rig, 0, false, 0, 2, 0, &inputs};
  store.Keep(key, true, kept);
  double found[2] = {};
  EXPECT_TRUE(store.Find(key, found).has_value());
  inputs[0].amplitude = 2.02;
  EXPECT_FALSE(store.Find(key, found).has_value());
  inputs[0].amplitude = 2;
  const RunKey later{c.rig, 0, false, 0, 2, 0, &inputs, 2e-5};  // a clock that was set right
  EXPECT_FALSE(store.Find(later, found).has_value());
}

TEST_F(RunStoreTest, AnEntryThatWasCutOffIsDoneAgain) {
  const Case c = Read();
  const auto wanted = KeptPredictions(c, Store());
  CaseModel again(c);
  const fs::path file = fs::path(Store()) / "simulations.bin";
  fs::resize_file(file, fs::file_size(file) - 5);
  RunStore store(Store(), c);
  EXPECT_EQ(store.size(), 3U);
  again.store = &store;
  EXPECT_EQ(again.PredictAll(Hypotheses(c)), wanted);
  EXPECT_EQ(again.runs, 1);
}

// Its check sum fits, but the rows that are asked for are more (or fewer, and there is no room for
// the others).
TEST_F(RunStoreTest, AnEntryOfAnotherLengthIsDoneAgain) {
  const Case c = Read();
  const auto wanted = KeptPredictions(c, Store());
  CaseModel again(c);
  {
    std::string text;
    const auto keep = [&text](const JournalEntry& e) {
      text = e.text;
      return true;
    };
    Journal journal((fs::path(Store()) / "simulations.bin").string(), "",
                    {.header = [](std::string_view) {}, .entry = keep});
    journal.Append(text, "8 bytes.");
  }
  RunStore store(Store(), c);
  EXPECT_EQ(store.size(), 4U);
  again.store = &store;
  EXPECT_EQ(again.PredictAll(Hypotheses(c)), wanted);
  EXPECT_EQ(again.runs, 1);
}

TEST_F(RunStoreTest, RefusesAnotherCaseAndASecondUser) {
  { RunStore store(Store(), Read()); }
  Write("case.toml", CaseText("0.002"));
  EXPECT_THROW(
      try { RunStore store(Store(), Read()); } catch (const InputError& e) {
        EXPECT_NE(std::string(e.what()).find("another case or of another build"), std::string::npos)
            << e.what();
        throw;
      },
      InputError);
  Write("case.toml", CaseText("0.001"));
  const RunStore store(Store(), Read());
  EXPECT_THROW(RunStore(Store(), Read()), InputError);
}

}  // namespace
}  // namespace ambrig
