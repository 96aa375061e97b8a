// What the rig does differently is no error of the data: every effect of the catalogue at its
// largest usual size, of either sign, at its first place.
#include <gtest/gtest.h>

#include <cmath>

#include "effects/catalogue.h"
#include "rig/rig_assembly.h"
#include "tests/discovery/data_gate/gate_case.h"

namespace ambrig {
namespace {

/// The effect with each size `sign` times its largest usual distance from nothing; sizes that
/// cannot be stay in their bounds.
EffectInstance Largest(const EffectDescription& d, const std::string& target, double sign) {
  EffectInstance e = MakeInstance(d, target);
  for (std::size_t k = 0; k < e.table.size(); ++k) {
    const EffectParameter& p = e.table[k];
    double value = p.typical_hi;
    if (d.Switches(p))
      value = std::isfinite(p.null_value) ? p.null_value + sign * p.typical_hi : p.typical_lo;
    e.values[k] = std::clamp(value, p.lo, p.hi);
  }
  return e;
}

class GatePasses : public ::testing::TestWithParam<std::string> {};

TEST_P(GatePasses, AtItsLargestUsualSize) {
  const EffectDescription& d = EffectNamed(GetParam());
  const RigParameters rig = testing::RadialRig();
  const std::vector<std::string> targets = TargetsOf(d, TargetsOfEffects(rig));
  if (targets.empty()) GTEST_SKIP() << "no place on this rig";
  for (const double sign : {1.0, -1.0}) {
    Case c;
    try {
      c = testing::Measured({Largest(d, targets[0], sign)});
    } catch (const std::runtime_error&) {
      continue;  // a rotor that is lost is not measured
    }
    const auto faults = testing::FaultsOf(c);
    EXPECT_TRUE(faults.empty()) << sign << ": " << FaultText(faults[0]);
  }
}

std::vector<std::string> Proposed() {
  std::vector<std::string> out;
  for (const EffectDescription& d : Catalogue())
    if (!d.users_own) out.push_back(d.id);
  return out;
}

INSTANTIATE_TEST_SUITE_P(Effects, GatePasses, ::testing::ValuesIn(Proposed()), [](const auto& p) {
  std::string name = p.param;
  std::erase(name, '-');
  return name;
});

}  // namespace
}  // namespace ambrig
