// Promises of plans, counted; and one whole trial, whose true law is not the catalogue's.
#include "discovery/plan/promise_trial.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include "core/base/errors.h"
#include "core/base/read_file.h"
#include "core/base/toml_edit.h"

namespace ambrig {
namespace {

PromiseTrial Trial(double promise, double after, const std::string& left_out = "") {
  PromiseTrial t;
  t.promise = promise;
  t.after = after;
  t.left_out = left_out;
  return t;
}

TEST(PromisesKept, CountsBesideWhatWasPromised) {
  const std::vector<PromiseBin> bins =
      PromisesKept({Trial(0.999, 0.9), Trial(0.99, 0.2), Trial(1, 0.6), Trial(0.98, 1),
                    Trial(0.9, 0.4), Trial(0.5, 0.7), Trial(0.999, 0, "nothing to tell apart")});
  ASSERT_EQ(bins.size(), 4u);
  const std::size_t found[] = {2, 1, 0, 1}, all[] = {3, 1, 1, 1};
  for (std::size_t k = 0; k < bins.size(); ++k) {
    EXPECT_EQ(bins[k].found.right, found[k]) << bins[k].from;
    EXPECT_EQ(bins[k].found.of, all[k]) << bins[k].from;
  }
}

TEST(PromisesKept, OfNothingIsNothing) {
  for (const PromiseBin& b : PromisesKept({})) EXPECT_EQ(b.found.of, 0u);
}

/// As `ambrig practice` reads it.
PracticeRig RigFile(const std::string& name) {
  const std::string file = std::string(AMBRIG_SOURCE_DIR) + "/examples/" + name + "/rig.toml";
  return {name, file, WithAbsoluteFiles(ReadFile(file), file)};
}

// An iron path that shows little more than the noise: no safe record tells it from a zero of the
// current sensors, the plan says so, and the record that it proposes nevertheless does not.
TEST(TryPromise, WhatCannotBeToldIsNotPromised) {
  if (std::getenv("AMBRIG_SLOW_TESTS") == nullptr)
    GTEST_SKIP() << "half a minute of computing: AMBRIG_SLOW_TESTS=1 runs it";
  const std::vector<PracticeRig> rigs = {RigFile("reference"), RigFile("small_spindle"),
                                         RigFile("heavy_compressor")};
  const PracticeCase made = MakePracticeCase(rigs, 12, 43);
  PromiseOptions options;
  options.draws = 4;
  options.first = 43 % made.records.size();
  const PromiseTrial trial = TryPromise(made, made.data, options);
  EXPECT_EQ(trial.left_out, "");
  EXPECT_EQ(trial.right, "iron-reluctance at B");
  EXPECT_NEAR(trial.before, 0.5, 0.05);
  EXPECT_LT(trial.promise, 0.95);
  EXPECT_LT(trial.after, 0.95);
  ASSERT_TRUE(trial.planned);
  EXPECT_FALSE(trial.planned->measured.channels.empty());
}

TEST(TryPromise, OneHiddenEffectIsNeeded) {
  PracticeCase two;
  two.name = "case-0002";
  two.kind = "two";
  EXPECT_THROW(TryPromise(two, {}, {}), InputError);
}

}  // namespace
}  // namespace ambrig
