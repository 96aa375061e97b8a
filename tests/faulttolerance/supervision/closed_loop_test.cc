// What fault tolerance does after faults that it cannot size, or that come after its own action:
// not worse than nothing. Whole runs of the commissioned reference rig.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "rig/rig_file.h"
#include "simulation/simulate.h"

namespace ambrig {
namespace {

const RigParameters& CommissionedReference() {
  static const RigParameters rig =
      ReadRig(std::string(AMBRIG_SOURCE_DIR) + "/scenarios/library/rigs/reference.toml");
  return rig;
}

std::string Short(int coil, double time, const std::string& parameters) {
  return fmt::format(
      "[[fault]]\ntime = {}\ntarget = \"A.coil{}\"\nkind = \"partial-short\"\nparameters = {{ {} "
      "}}\n",
      time, coil, parameters);
}

RunResult ReferenceRunWith(const std::string& faults, double duration, bool tolerant = true) {
  const Scenario s = ReadScenarioText(
      fmt::format("name = \"run\"\nrig = \"rig.toml\"\nduration = {}\nrecord_rate = 12500.0\n"
                  "seed = 3\nfault_tolerance = {}\n[speed]\nprofile = [[0.0, 300.0]]\n{}",
                  duration, tolerant, faults),
      "run.toml", CommissionedReference());
  return Simulate(CommissionedReference(), s, {});
}

bool Blames(const RunResult& r, const std::string& other_than) {
  return std::ranges::any_of(
      r.actions, [&](const CoilAction& a) { return a.coil != other_than && a.action != "probe"; });
}

TEST(ClosedLoop, AFewShortedTurnsAreNoWorseWithFaultToleranceThanWithout) {
  for (const char* loop :
       {"fraction = 0.03, short_resistance = 0.01", "fraction = 0.1, short_resistance = 0.02"}) {
    const std::string fault = Short(3, 0.0300123, loop);
    const RunResult with = ReferenceRunWith(fault, 0.06),
                    without = ReferenceRunWith(fault, 0.06, false);
    EXPECT_LT(with.metrics.max_orbit.at("A"), 1.1 * without.metrics.max_orbit.at("A")) << loop;
    EXPECT_FALSE(Blames(with, "A.coil3")) << loop;
    EXPECT_GE(with.metrics.detection_delay, 0) << loop;
  }
}

// Slower than a switching period, so that its size is told too small at first: the coil's share
// follows its flux, and the coil goes on carrying.
TEST(ClosedLoop, ALargeOneIsDrivenByWhatItsFluxComesTo) {
  const std::string fault = Short(3, 0.0300123, "fraction = 0.3, short_resistance = 0.05");
  const RunResult with = ReferenceRunWith(fault, 0.1),
                  without = ReferenceRunWith(fault, 0.1, false);
  EXPECT_LT(with.metrics.max_orbit.at("A"), 0.6 * without.metrics.max_orbit.at("A"));
  EXPECT_FALSE(Blames(with, "A.coil3"));
  EXPECT_TRUE(
      std::ranges::none_of(with.actions, [](const auto& a) { return a.action == "disable"; }));
}

TEST(ShortOfMostTurns, TheCoilIsSwitchedOffAndNobodyElseIs) {
  for (const char* share : {"fraction = 0.8", "fraction = 0.9"}) {
    const RunResult r = ReferenceRunWith(Short(3, 0.0300123, share), 0.1);
    EXPECT_LT(r.metrics.max_orbit.at("A"), 2e-5) << share;
    EXPECT_FALSE(r.touchdown) << share;
    EXPECT_FALSE(Blames(r, "A.coil3")) << share;
    EXPECT_LT(r.metrics.detection_delay, 0.5e-3) << share;
  }
}

// The redistribution after the first fault drives the coils that are left beyond the flux of the
// commissioning.
TEST(SecondFault, IsFoundBeyondTheCommissionedFlux) {
  const std::string open = "[[fault]]\ntime = 0.0300123\ntarget = \"A.coil2\"\nkind = \"open\"\n";
  for (const int second : {1, 3, 4, 8}) {
    const RunResult r = ReferenceRunWith(open + Short(second, 0.0600123, "fraction = 0.3"), 0.12);
    EXPECT_FALSE(r.touchdown) << second;
    EXPECT_TRUE(std::ranges::any_of(r.events, [&](const RunEvent& e) {
      return e.kind == "classified" && e.target == fmt::format("A.coil{}", second) &&
             e.t < 0.0700123;
    })) << second;
  }
}

/// A coil is given up for a false reading, and another one fails `after` the probe that follows is
/// due [s]: how long that takes to be named [s], and whether the probe was interrupted.
struct FoundBesideProbe {
  double delay = kInfinity;
  bool interrupted = false;
};
FoundBesideProbe SecondFaultAt(double after) {
  const std::string sensor =
      "[[fault]]\ntime = 0.0300123\ntarget = \"A.coil2\"\nkind = \"current-sensor\"\n"
      "parameters = { gain = 0.8 }\n";
  const RunResult first = ReferenceRunWith(sensor, 0.05);
  const auto given_up = std::ranges::find(first.actions, "disable", &CoilAction::action);
  if (given_up == first.actions.end()) return {};
  const double second = given_up->t + 10e-3 + after;
  const RunResult r = ReferenceRunWith(sensor + Short(3, second, "fraction = 0.3"), 0.06);
  FoundBesideProbe out;
  out.interrupted = std::ranges::any_of(r.actions, [](const CoilAction& a) {
    return a.action == "probe" && a.reason == "interrupted";
  });
  for (const RunEvent& e : r.events)
    if (e.kind == "classified" && e.target == "A.coil3") out.delay = e.t - second;
  return out;
}

// While a coil that was given up is probed, the others are not judged: a fault of theirs ends the
// probe.
TEST(SecondFault, IsFoundDuringAProbe) {
  const FoundBesideProbe found = SecondFaultAt(0.2e-3);
  EXPECT_TRUE(found.interrupted);
  EXPECT_LT(found.delay, 0.9e-3);
}

// Nor does a probe begin while a coil has just become suspect.
TEST(SecondFault, IsFoundAsAProbeIsDue) {
  for (const double before : {0.12e-3, 0.08e-3, 0.04e-3})
    EXPECT_LT(SecondFaultAt(-before).delay, 0.9e-3) << before;
}

}  // namespace
}  // namespace ambrig
