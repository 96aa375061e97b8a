// Rigs with stators of any kind through the whole engine: the eight-pole bearing written as a
// network moves as the one of the fast path does, and benches of the examples outlive a lost coil.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "actuators/magnetics/stator_parameters.h"
#include "rig/parameters/bearing_kind.h"
#include "rig/rig_assembly.h"
#include "rig/rig_file.h"
#include "simulation/simulate.h"
#include "tests/cli/cli_run.h"

namespace ambrig {
namespace {

const std::string kExamples = AMBRIG_SOURCE_DIR "/examples/stators/";

/// The reference rig with its radial bearings as stators of eight independent poles.
std::string AsStators(std::string text) {
  text = Replaced(text, "kind = \"radial\"", "kind = \"stator\"\ntemplate = \"one-coil-per-pole\"");
  return text;
}

/// The same stators with a first pole that is larger by 1e-9: no longer pole by pole.
RigParameters AsNetworks(RigParameters rig) {
  for (BearingParameters& b : rig.bearings) {
    auto* stator = std::any_cast<StatorParameters>(&b.own);
    if (!stator) continue;
    stator->poles = PolesOf(*stator);
    stator->pattern.clear();
    stator->poles[0].area *= 1 + 1e-9;
  }
  EXPECT_EQ(BuildPlant(TrueRig(rig)).bearings[0].lanes.coupling, Coupling::kNetwork);
  return rig;
}

/// Small and deterministic: a coil shorted, one broken, nobody watches, forces from outside.
Scenario Shaken(const RigParameters& rig, const std::string& fault) {
  return ReadScenarioText(
      "rig = \"rig.toml\"\nduration = 0.06\nnoise = false\nfault_tolerance = false\n"
      "record_rate = 12500.0\n[speed]\nprofile = [[0.0, 300.0]]\n"
      "[[excitation]]\ntarget = \"A.x\"\nport = \"force\"\nkind = \"sine\"\nfrequency = 120.0\n"
      "amplitude = 15.0\nstart = 0.0\nstop = 0.06\n" +
          fault,
      "scenario.toml", rig);
}

double Difference(const Record& a, const Record& b, const std::string& channel) {
  const Channel *p = a.Find(channel), *q = b.Find(channel);
  EXPECT_TRUE(p && q) << channel;
  double largest = 0;
  for (std::size_t k = 0; p && q && k < p->samples.size(); ++k)
    largest = std::max(largest, std::abs(p->samples[k] - q->samples[k]));
  return largest;
}

double Size(const Record& a, const std::string& channel) {
  double largest = 0;
  for (const double v : a.Find(channel)->samples) largest = std::max(largest, std::abs(v));
  return largest;
}

/// Largest move of a bearing's plane from row to row, over the gap.
double LargestStep(const Record& r) {
  double largest = 0;
  for (const char* channel : {"A.r.x", "A.r.y", "B.r.x", "B.r.y"}) {
    const std::vector<double>& s = r.Find(channel)->samples;
    for (std::size_t k = 1; k < s.size(); ++k)
      largest = std::max(largest, std::abs(s[k] - s[k - 1]));
  }
  return largest / 4e-4;
}

/// Healthy and after faults of coils the rigs move alike. Within a period the lanes take the
/// conductances of the poles as linear in time, the network the fluxes per ampere of the whole
/// circuit: they differ by the square of the step.
void ExpectSameMotion(const RigParameters& lanes, const RigParameters& network) {
  for (const char* fault :
       {"", "[[fault]]\ntime = 0.02\ntarget = \"A.coil3\"\nkind = \"open\"\n",
        "[[fault]]\ntime = 0.02\ntarget = \"B.coil5\"\nkind = \"partial-short\"\nparameters = { "
        "fraction = 0.3, short_resistance = 0.05 }\n"}) {
    const Record a = Simulate(lanes, Shaken(lanes, fault), {}).record,
                 b = Simulate(network, Shaken(network, fault), {}).record;
    const double step = LargestStep(a);
    EXPECT_LT(step, 0.03);  // else the bound says nothing
    for (const char* channel : {"A.r.x", "A.r.y", "B.r.x", "B.r.y", "A.i1", "A.i3", "B.i5", "B.i6"})
      EXPECT_LT(Difference(a, b, channel), step * step * Size(a, channel)) << channel << fault;
  }
}

// Two codes, one circuit.
TEST(StatorRuns, EightPolesAsANetworkMoveAsTheyDo) {
  const std::string text = ReferenceRigText();
  const RigParameters lanes = ReadRigText(text, "rig.toml"),
                      network = AsNetworks(ReadRigText(AsStators(text), "rig.toml"));
  ExpectSameMotion(lanes, network);
}

// A coil on each of six poles is computed pole by pole.
TEST(StatorRuns, SixPolesOneByOneMoveAsTheirNetwork) {
  const RigParameters poles = ReadRig(kExamples + "six_poles.toml"), network = AsNetworks(poles);
  EXPECT_EQ(BuildPlant(TrueRig(poles)).bearings[0].lanes.coupling, Coupling::kFloatingRotor);
  ExpectSameMotion(poles, network);
}

// Laws of the iron act on such a stator as on the eight poles of a radial bearing.
TEST(StatorRuns, LawsOfTheIronActPoleByPole) {
  for (const char* effect :
       {"eddy-currents\"\ntarget = \"A\"\nparameters = { cutoff = 3000.0, path = 2.0e-5 "
        "}\n",
        "saturation\"\ntarget = \"A\"\nparameters = { knee = 0.4, path = 0.1 }\n",
        "magnetic-offset\"\ntarget = \"A\"\nparameters = { dx = 1.0e-5, dy = -5.0e-6 }\n"}) {
    const std::string with = "\n[[effect]]\nname = \"" + std::string(effect);
    const std::string text = ReferenceRigText();
    const RigParameters without = ReadRigText(text, "rig.toml"),
                        radial = ReadRigText(text + with, "rig.toml"),
                        stator = ReadRigText(AsStators(text) + with, "rig.toml");
    const auto run = [](const RigParameters& rig) {
      return Simulate(rig, Shaken(rig, ""), {}).record;
    };
    const Record none = run(without), a = run(radial), b = run(stator);
    for (const char* channel : {"A.r.x", "A.i1", "A.i4"}) {
      const double changed = Difference(a, none, channel);
      EXPECT_GT(changed, 1e-3 * Size(a, channel)) << channel << effect;
      EXPECT_LT(Difference(a, b, channel), 1e-6 * changed) << channel << effect;
    }
  }
}

// SUNDIALS as the witness of six poles.
TEST(StatorRuns, SixPolesMoveAsTheReferenceSolution) {
  const RigParameters rig = ReadRig(kExamples + "six_poles.toml");
  const Scenario s = Shaken(rig, "");
  SimulateOptions exact;
  exact.fidelity = Fidelity::kReference;
  const Record a = Simulate(rig, s, {}).record, b = Simulate(rig, s, exact).record;
  for (const char* channel : {"A.r.x", "A.r.y", "B.r.x", "B.r.y"})
    EXPECT_LT(Difference(a, b, channel), 1e-3 * Size(a, channel)) << channel;
}

TEST(StatorRuns, CopiesOfABearingAreTheSameStator) {
  const RigParameters rig = ReadRig(kExamples + "six_poles.toml");
  ASSERT_EQ(rig.bearings.size(), 2U);
  EXPECT_EQ(rig.bearings[1].coils(), 6);
  EXPECT_EQ(rig.bearings[0].kind->stator(rig.bearings[0]).n[2],
            rig.bearings[1].kind->stator(rig.bearings[1]).n[2]);
}

struct Bench {
  const char *rig, *scenario, *coil;
};

class StatorBenches : public ::testing::TestWithParam<Bench> {};

TEST_P(StatorBenches, ALostCoilIsFoundAndOutlived) {
  const Bench bench = GetParam();
  const RigParameters rig = ReadRig(kExamples + bench.rig);
  const Scenario s = ReadScenario(kExamples + bench.scenario, rig);
  const RunResult r = Simulate(rig, s, {});
  const auto at = [&](const std::string& kind) {
    const auto e = std::find_if(r.events.begin(), r.events.end(),
                                [&](const RunEvent& v) { return v.kind == kind; });
    EXPECT_NE(e, r.events.end()) << kind;
    return e == r.events.end() ? RunEvent{} : *e;
  };
  EXPECT_EQ(at("detected").target, bench.coil);
  EXPECT_LT(at("redistributed").t - s.faults.front().time, 1e-3);
  EXPECT_FALSE(r.drop);
  EXPECT_FALSE(r.touchdown);
  EXPECT_EQ(r.metrics.false_alarms, 0);
}

INSTANTIATE_TEST_SUITE_P(
    Examples, StatorBenches,
    ::testing::Values(Bench{"six_poles.toml", "six_poles_coil_opens.toml", "A.coil2"},
                      Bench{"homopolar.toml", "homopolar_coil_opens.toml", "A.coil2"},
                      Bench{"heteropolar.toml", "heteropolar_coil_opens.toml", "B.coil4"},
                      Bench{"e_core_and_thrust.toml", "e_core_and_thrust_coil_opens.toml",
                            "Z.coil1"}));

// Coil 1 carries the rotor: without it no currents of the other three give the forces, and the
// rotor falls.
TEST(StatorRuns, WhatNothingCanCarryIsNotRedistributed) {
  const RigParameters rig = ReadRig(kExamples + "series_pairs.toml");
  Scenario s = ReadScenario(kExamples + "series_pairs_coil_opens.toml", rig);
  s.duration = 0.1;
  s.faults.front().time = 0.05;
  s.faults.front().target = "A.coil1";
  const RunResult r = Simulate(rig, s, {});
  const auto of_kind = [&](const std::string& kind) {
    return std::find_if(r.events.begin(), r.events.end(),
                        [&](const RunEvent& e) { return e.kind == kind; });
  };
  ASSERT_NE(of_kind("not_redistributed"), r.events.end());
  EXPECT_EQ(of_kind("not_redistributed")->fault_class, "none");
  EXPECT_EQ(of_kind("redistributed"), r.events.end());
  EXPECT_EQ(r.metrics.redistribution_delay, -1);
}

// Every coil of six may be the one that breaks.
TEST(StatorRuns, AnyCoilOfSix) {
  const RigParameters rig = ReadRig(kExamples + "six_poles.toml");
  Scenario s = ReadScenario(kExamples + "six_poles_coil_opens.toml", rig);
  s.duration = 0.1;
  s.faults.front().time = 0.05;
  for (int coil = 1; coil <= 6; ++coil) {
    s.faults.front().target = "B.coil" + std::to_string(coil);
    const RunResult r = Simulate(rig, s, {});
    EXPECT_FALSE(r.touchdown) << coil;
    EXPECT_FALSE(r.drop) << coil;
  }
}

// What is not there yet is said, not computed.
TEST(StatorRuns, OtherFidelitiesAreRefused) {
  const RigParameters rig = ReadRig(kExamples + "series_pairs.toml");
  Scenario s = ReadScenario(kExamples + "series_pairs_coil_opens.toml", rig);
  s.expect = {};  // of fault detection, which they do not have either
  SimulateOptions o;
  o.fidelity = Fidelity::kReference;
  try {
    Simulate(rig, s, o);
    FAIL() << "no error";
  } catch (const InputError& e) {
    EXPECT_EQ(e.what(), rig.file +
                            ": bearing A: kind = \"stator\" or \"axial-stator\" needs --fidelity "
                            "switching");
  }
}

}  // namespace
}  // namespace ambrig
