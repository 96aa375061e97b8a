/// What the controller knows: nothing of the true values, nothing of a fault before its time.
#include <gtest/gtest.h>

#include <cmath>

#include "scenarios/faults/fault.h"
#include "simulation/continuous/averaged_engine.h"
#include "simulation/continuous/reference_engine.h"
#include "simulation/simulate.h"
#include "simulation/switching/switching_engine.h"
#include "tests/simulation/tum_rig.h"
#include "tests/simulation/witness.h"

namespace ambrig {
namespace {

constexpr double kBoundaryT = 40e-6;

/// Another value within the parameter's range, far enough to matter.
double Other(const RigParameters& rig, const std::string& path) {
  double lo = 0, hi = 0;
  std::string unit;
  EXPECT_TRUE(ParameterRange(rig, path, &lo, &hi, &unit)) << path;
  const double value = *ParameterAt(rig, path), more = value == 0 ? 1e-3 * hi : 1.03 * value;
  return more <= hi ? more : 0.97 * value;
}

Record FirstPeriods(Fidelity fidelity, const RigParameters& rig, StartState start) {
  Scenario s = BaseScenario("steps", rig);
  s.excitations.clear();
  s.loads.clear();
  s.start = start;
  s.noise = false;
  s.record_rate = rig.amplifier.switching_frequency;
  s.duration = 6 * kBoundaryT;
  EngineOptions o;
  o.warm_up = 0;
  if (fidelity == Fidelity::kSwitching) return SwitchingEngine(rig, s, o).Run().record;
  ReferenceOptions r;
  r.sampled.warm_up = 0;
  if (fidelity == Fidelity::kReference) return RunReference(rig, s, r).record;
  return RunAveraged(rig, s, r).record;
}

/// The first set-points and duties of all coils, bit by bit; with a shaft that rests at its centre
/// the set-points of the first controller tick too, which have seen the first readings.
void ExpectSameFirstCommand(const Record& a, const Record& b, bool tick, const std::string& what) {
  int commands = 0;
  for (const Channel& c : a.channels) {
    const bool set_point = c.name.find(".s") != std::string::npos;
    if (!set_point && c.name.find(".d") == std::string::npos) continue;
    ++commands;
    const Channel* other = b.Find(c.name);
    ASSERT_NE(other, nullptr) << what;
    EXPECT_EQ(c.samples[0], other->samples[0]) << what << ": " << c.name;
    for (std::size_t n = 1; tick && set_point && n < 3; ++n)
      EXPECT_EQ(c.samples[n], other->samples[n]) << what << ": " << c.name << " row " << n;
  }
  EXPECT_GE(commands, 4) << what;
}

class TruthBoundary : public ::testing::TestWithParam<Fidelity> {};

TEST_P(TruthBoundary, CalibratingAnyParameterLeavesTheFirstCommandAsItIs) {
  const RigParameters drawn = BaseRig();
  for (const StartState start :
       {StartState::kLevitated, StartState::kClamped, StartState::kResting}) {
    const Record nominal = FirstPeriods(GetParam(), drawn, start);
    for (const std::string& path : ParameterPaths(drawn)) {
      if (std::isnan(*ParameterAt(drawn, path))) continue;  // not given, and not needed
      RigParameters rig = drawn;
      rig.tolerances.push_back({path, 0, Other(drawn, path)});
      ExpectSameFirstCommand(nominal, FirstPeriods(GetParam(), rig, start),
                             start == StartState::kLevitated, path);
    }
  }
}

// The other way round: the same change in the drawing does change the command, so that the test
// above can see a leak.
TEST_P(TruthBoundary, ADrawingWithAnotherValueGivesAnotherCommand) {
  const RigParameters drawn = BaseRig();
  const Record nominal = FirstPeriods(GetParam(), drawn, StartState::kLevitated);
  for (const std::string path : {"bearings.A.first_pole_angle_deg", "bearings.A.gap", "rotor.mass",
                                 "bearings.A.resistance", "amplifier.bus_voltage"}) {
    RigParameters rig = drawn;
    ASSERT_TRUE(SetParameter(rig, path, Other(drawn, path)));
    const Record other = FirstPeriods(GetParam(), rig, StartState::kLevitated);
    bool differs = false;
    for (const char* name : {"A.s1", "A.s2", "A.d1", "A.d2"})
      differs = differs || nominal.Find(name)->samples[0] != other.Find(name)->samples[0];
    EXPECT_TRUE(differs) << path;
  }
}

INSTANTIATE_TEST_SUITE_P(Engines, TruthBoundary,
                         ::testing::Values(Fidelity::kSwitching, Fidelity::kReference,
                                           Fidelity::kAveraged));

// Of a flexible shaft the start is an equilibrium: the controller's share of it is the drawing's.
TEST(TruthBoundaryOfAShaft, CalibratingAnyNumberOfItLeavesTheFirstCommandAsItIs) {
  const RigParameters drawn =
      testing::TumRig(testing::TumRigText({{"E = 2.11e11", "E = { value = 2.11e11, sd = 1e9 }"}}));
  ASSERT_TRUE(drawn.beam);
  const Record nominal = FirstPeriods(Fidelity::kSwitching, drawn, StartState::kLevitated);
  ASSERT_FALSE(drawn.beam->parameters.empty());
  for (const ShaftParameter& p : drawn.beam->parameters) {
    RigParameters rig = drawn;
    rig.tolerances.push_back({p.path, 0, 1.02 * p.value});
    ExpectSameFirstCommand(nominal, FirstPeriods(Fidelity::kSwitching, rig, StartState::kLevitated),
                           false, p.path);
  }
}

/// A value that makes a difference for every parameter of a fault.
double FaultValue(const FaultParameter& p) {
  if (p.flag) return 1;
  if (p.key == "gain") return 0.8;
  if (p.key == "offset") return p.unit == "A" ? 0.5 : 2e-5;
  if (p.key == "voltage") return 22;
  if (p.key == "duration") return 1e-3;
  return std::isfinite(p.hi) ? 0.5 * (p.lo + p.hi) : p.lo + 0.1;
}

/// Every kind of fault with each of its parameters in turn, at `time`.
std::vector<FaultSpec> EveryFault(double time) {
  std::vector<FaultSpec> out;
  for (const Fault* kind : Faults()) {
    FaultSpec f;
    f.time = time;
    f.kind = std::string(kind->kind);
    f.target = kind->target == FaultTarget::kCoil   ? "A.coil2"
               : kind->target == FaultTarget::kAxis ? "A.y"
                                                    : "rig";
    for (const FaultParameter& p : kind->parameters)
      if (p.required) f.parameters[std::string(p.key)] = FaultValue(p);
    if (kind->parameters.empty()) out.push_back(f);
    for (const FaultParameter& p : kind->parameters) {
      FaultSpec with = f;
      with.parameters[std::string(p.key)] = FaultValue(p);
      out.push_back(with);
    }
  }
  return out;
}

struct FaultRun {
  Fidelity fidelity;
  double duration, fault;  // [s]; the fault in the middle of a period
};
void PrintTo(const FaultRun& r, std::ostream* out) { *out << static_cast<int>(r.fidelity); }

class BeforeAFault : public ::testing::TestWithParam<FaultRun> {
 protected:
  static Record Run(const std::vector<FaultSpec>& faults) {
    const RigParameters rig = BaseRig();
    Scenario s = BaseScenario("steps", rig);
    s.duration = GetParam().duration;
    s.faults = faults;
    s.fault_tolerant = true;
    s.noise = true;  // of the switching engine
    s.record_rate = rig.amplifier.switching_frequency;
    SimulateOptions o;
    o.fidelity = GetParam().fidelity;
    return Simulate(rig, s, o).record;
  }
};

// base_model.md section 6: a fault acts from its ADC sample on. A row shows what is known at the
// start of its period.
TEST_P(BeforeAFault, NoBitOfTheRunChanges) {
  const Record healthy = Run({});
  const auto before = static_cast<std::size_t>(std::floor(GetParam().fault / kBoundaryT)) + 1;
  for (const FaultSpec& f : EveryFault(GetParam().fault)) {
    const Record faulty = Run({f});
    ASSERT_EQ(faulty.channels.size(), healthy.channels.size());
    std::size_t first = healthy.rows();
    std::string where;
    for (std::size_t c = 0; c < healthy.channels.size(); ++c)
      for (std::size_t n = 0; n < first; ++n) {
        const double a = healthy.channels[c].samples[n], b = faulty.channels[c].samples[n];
        if (a == b || (std::isnan(a) && std::isnan(b))) continue;
        first = n;
        where = healthy.channels[c].name;
      }
    EXPECT_GE(first, before) << f.kind << ": " << where;
    EXPECT_LT(first, healthy.rows()) << f.kind << " has no effect";
  }
}

TEST_P(BeforeAFault, AFaultAfterTheEndIsNone) {
  const Record healthy = Run({});
  for (const FaultSpec& f : EveryFault(GetParam().duration + 1e-3)) {
    const Record faulty = Run({f});
    for (std::size_t c = 0; c < healthy.channels.size(); ++c)
      EXPECT_EQ(faulty.channels[c].samples, healthy.channels[c].samples)
          << f.kind << ": " << healthy.channels[c].name;
  }
}

INSTANTIATE_TEST_SUITE_P(Engines, BeforeAFault,
                         ::testing::Values(FaultRun{Fidelity::kSwitching, 0.03, 0.02001},
                                           FaultRun{Fidelity::kAveraged, 0.004, 0.00201}));

}  // namespace
}  // namespace ambrig
