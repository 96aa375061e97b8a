// A law that the rig file holds already is fitted from where it stands, beside the rig without it.
#include "discovery/shape/named_law.h"

#include <gtest/gtest.h>

#include "core/base/errors.h"
#include "tests/discovery/linear_case.h"

namespace ambrig {
namespace {

const std::vector<double> kPlaces = {2e-5, 4e-5, 6e-5, 5e-5};
const auto kQuiet = [](double, const std::string&) {};

TEST(NamedLaw, OfTheRigFileIsFittedAgainFromThere) {
  const LinearCase without(kPlaces, 1.08, 0);
  Case c = LinearCase::Make(kPlaces, 1.08, 0);
  c.rig.effects = {LinearCase::Gain(1.02)};
  CaseModel model(c);
  for (Target& t : model.targets()) t.floor = LinearCase::kFloor;
  const NamedLaw law = FitNamedLaw(model, "sensor-gain", "A.x", 300, kQuiet);
  EXPECT_EQ(law.index, 0U);
  ASSERT_EQ(law.fit.hypothesis.rig.effects.size(), 1U);
  EXPECT_NEAR(law.fit.hypothesis.rig.effects[0].Value("gain"), 1.08, 1e-3);
  EXPECT_TRUE(law.base.converged);
  EXPECT_TRUE(law.base.hypothesis.rig.effects.empty());
  EXPECT_NEAR(law.base.ratio_fit, without.Base().ratio_fit, 1e-9);
  EXPECT_LT(law.fit.ratio_fit, 0.1 * law.base.ratio_fit);
}

TEST(NamedLaw, OfAnUnknownTargetIsRefused) {
  const LinearCase c(kPlaces, 1.08, 0);
  EXPECT_THROW(FitNamedLaw(c.model, "sensor-gain", "C.x", 300, kQuiet), InputError);
}

}  // namespace
}  // namespace ambrig
