/// Every kind of controller on the reference rig: it levitates in the engines, carries a load,
/// changes over without a bump, and its mistakes in a rig file are told.
#include <gtest/gtest.h>

#include <algorithm>

#include <cmath>

#include "analysis/linear/control_plant.h"
#include "simulation/sampled/controller_setup.h"
#include "simulation/simulate.h"
#include "tests/simulation/controlled_rig.h"

namespace ambrig {
namespace {

Scenario LoadStepAtSpeed(const RigParameters& rig, const std::string& more = "") {
  return ReadScenarioText(
      "name = \"load\"\nduration = 0.12\nnoise = true\n[speed]\nprofile = [[0.0, "
      "300.0]]\n[[load]]\nplane = \"A\"\n"
      "force = [20.0, 0.0]\nstart = 0.02\nstop = 0.2\n" +
          more,
      "s.toml", rig);
}

TEST(Controllers, LevitateInTheSwitchingEngine) {
  for (const TestedController& k : LevitatingControllers()) {
    const RigParameters rig = RigWith(k.controller);
    const RunResult r = Simulate(rig, LoadStepAtSpeed(rig), {});
    EXPECT_FALSE(r.touchdown) << k.name;
    EXPECT_LT(r.metrics.max_orbit.at("A"), k.load_orbit) << k.name;
    EXPECT_GT(r.metrics.max_orbit.at("A"), 5e-6) << k.name;  // the load was there
    EXPECT_TRUE(std::all_of(r.events.begin(), r.events.end(), [](const RunEvent& e) {
      return e.kind == "doubtful";  // not commissioned: it says so and does nothing
    })) << k.name;
    EXPECT_TRUE(r.actions.empty()) << k.name;
  }
}

// The fidelities agree on the load's largest deflection: the averaged engine leaves out ripple and
// noise.
TEST(Controllers, SameInEveryFidelity) {
  for (const char* kind : {"lqg", "h-infinity"}) {
    const RigParameters rig = RigWith(std::string("kind = \"") + kind + "\"\n");
    Scenario s = LoadStepAtSpeed(rig);
    s.noise = false;
    s.duration = 0.04;
    double orbit[3];
    int n = 0;
    for (const Fidelity f : {Fidelity::kSwitching, Fidelity::kAveraged, Fidelity::kReference}) {
      SimulateOptions options;
      options.fidelity = f;
      orbit[n++] = Simulate(rig, s, options).metrics.max_orbit.at("A");
    }
    EXPECT_NEAR(orbit[1], orbit[0], 0.03 * orbit[0]) << kind;
    EXPECT_NEAR(orbit[2], orbit[0], 0.01 * orbit[0]) << kind;
  }
}

// Linear loops are stable where the runs levitate, with every kind.
TEST(Controllers, LinearLoopsAreStable) {
  for (const TestedController& k : LevitatingControllers()) {
    const RigParameters rig = RigWith(k.controller);
    const SampledPlant plant = MakeControlPlant(rig, {0, 1, 2, 3, 4}, 300);
    EXPECT_LT(SpectralRadius(LoopMatrix(
                  plant.FromForce(), MakeController(NominalRig(rig), rig.controller)->Linear(300))),
              1)
        << k.name;
  }
}

// The notch with phase 0 is for speeds above the bearing's own frequencies: there the loop is
// stable, below them it is not.
TEST(Controllers, UnbalanceControlNeedsItsSpeed) {
  const RigParameters rig =
      RigWith("kind = \"pid\"\n" + kPidGains + "[controller.unbalance]\nfrom_speed = 100.0\n");
  const auto controller = MakeController(NominalRig(rig), rig.controller);
  const auto radius = [&](double speed) {
    return SpectralRadius(LoopMatrix(MakeControlPlant(rig, {0, 1, 2, 3, 4}, speed).FromForce(),
                                     controller->Linear(speed)));
  };
  EXPECT_GT(radius(300), 1);
  EXPECT_LT(radius(1256.6), 1);
}

// Automatic balancing: with the notch the set-points carry (almost) nothing synchronous, without it
// they do.
TEST(Controllers, UnbalanceControlEndsTheSynchronousCurrent) {
  double amplitude[2];
  for (const int on : {0, 1}) {
    std::string text = "kind = \"pid\"\n" + kPidGains;
    if (on) text += "[controller.unbalance]\nfrom_speed = 100.0\nbandwidth = 30.0\n";
    RigParameters rig = RigWith(
        text + "[[effect]]\nname = \"unbalance\"\ntarget = \"A\"\nparameters = { c = 5.0e-6 }\n");
    const Scenario s = ReadScenarioText(
        "name = \"u\"\nduration = 0.5\nnoise = false\n[speed]\nprofile = [[0.0, "
        "1256.6370614359173]]\n",
        "s.toml", rig);
    const Record r = Simulate(rig, s, {}).record;
    const Channel* c = r.Find("A.s1");
    ASSERT_NE(c, nullptr);
    double re = 0, im = 0;
    long n = 0;
    for (std::size_t k = 0; k < c->samples.size(); ++k) {
      if (r.TimeAt(k) < 0.4) continue;
      re += c->samples[k] * std::cos(1256.6370614359173 * r.TimeAt(k));
      im += c->samples[k] * std::sin(1256.6370614359173 * r.TimeAt(k));
      ++n;
    }
    amplitude[on] = 2 * std::hypot(re, im) / static_cast<double>(n);
  }
  EXPECT_GT(amplitude[0], 0.01);
  EXPECT_LT(amplitude[1], 0.01 * amplitude[0]);
}

// In the engine, changing over under load: no step of the set-points beyond what noise makes, and
// the rotor stays.
TEST(Controllers, ChangeOverWithoutABump) {
  const std::string text =
      "kind = \"pid\"\n" + kPidGains +
      "[controllers.strong]\nkind = \"lqg\"\nf_max = 60.0\n[controllers.soft]\nkind = "
      "\"pid\"\nf_max = 60.0\n"
      "kp = 3.0e5\nkd = 700.0\nki = 4.0e6\nderivative_time_constant = 1.5e-4\n";
  const RigParameters rig = RigWith(text);
  ASSERT_EQ(rig.other_controllers.size(), 2u);
  Scenario s = LoadStepAtSpeed(
      rig, "[[switch]]\ntime = 0.06\nto = \"strong\"\n[[switch]]\ntime = 0.09\nto = \"soft\"\n");
  s.noise = false;
  const RunResult r = Simulate(rig, s, {});
  EXPECT_FALSE(r.touchdown);
  const Channel *set = r.record.Find("A.s1"), *x = r.record.Find("A.x");
  double usual = 0, orbit_before = 0, orbit_after = 0;
  std::vector<double> steps;
  for (std::size_t k = 1; k < set->samples.size(); ++k) {
    const double t = r.record.TimeAt(k), step = std::abs(set->samples[k] - set->samples[k - 1]);
    if (t > 0.05 && t < 0.0599) usual = std::max(usual, step);
    for (const double at : {0.06, 0.09})
      if (t > at - 1e-6 && t < at + 4e-4) steps.push_back(step);
    if (t > 0.05 && t < 0.06) orbit_before = std::max(orbit_before, std::abs(x->samples[k]));
    if (t > 0.06) orbit_after = std::max(orbit_after, std::abs(x->samples[k]));
  }
  ASSERT_FALSE(steps.empty());
  for (const double step : steps) EXPECT_LT(step, usual + 0.01);  // [A], of 2 A bias
  EXPECT_LT(orbit_after, orbit_before + 5e-6);
}

// A scenario without changes has the same bits whether or not the rig has other controllers.
TEST(Controllers, OthersChangeNoBit) {
  const std::string pid = "kind = \"pid\"\n" + kPidGains;
  const RigParameters one = RigWith(pid),
                      two = RigWith(pid + "[controllers.spare]\nkind = \"lqg\"\nf_max = 60.0\n");
  Scenario s = LoadStepAtSpeed(one);
  s.duration = 0.03;
  const Record a = Simulate(one, s, {}).record, b = Simulate(two, s, {}).record;
  ASSERT_EQ(a.channels.size(), b.channels.size());
  for (std::size_t k = 0; k < a.channels.size(); ++k)
    EXPECT_TRUE(a.channels[k].samples == b.channels[k].samples);
}

struct Mistake {
  std::string controller, said;
};

TEST(Controllers, MistakesAreTold) {
  const std::string pid = "kind = \"pid\"\n" + kPidGains;
  const std::vector<Mistake> all{
      {"kind = \"pdi\"\n", "allowed: pid, duty-pid, state-feedback"},
      {"kind = \"lqg\"\nforce_wieght = 3.0\n", "force_weight"},
      {"kind = \"lqg\"\nforce_weight = -3.0\n", "allowed 1e-06"},
      {"kind = \"lqg\"\nspeeds = [100.0, 50.0]\n", "ascending"},
      {pid + "[[controller.filter]]\nkind = \"notch\"\nfrequency = 7000.0\nwidth = 5.0\n",
       "below half the controller's rate"},
      {pid + "[[controller.filter]]\nkind = \"notch\"\nfrequency = 700.0\nwidth = 5.0\naxes = "
             "[\"z\"]\n",
       "allowed: A.x, A.y, B.x, B.y"},
      {"kind = \"transfer-function\"\n", "controller.transfer"},
      {"kind = \"transfer-function\"\n[[controller.transfer]]\nnumerator = [1.0, 2.0]\ndenominator "
       "= [1.0]\n",
       "higher power"},
      {"kind = \"state-space\"\nD = [[1.0, 0.0], [0.0, 1.0]]\n", "allowed: 4 rows of 4 numbers"},
      {"kind = \"state-space\"\nfile = \"nowhere.toml\"\n", "nowhere.toml"},
      {"kind = \"tilt-translation\"\n", "translation"},
      {pid + "[controller.unbalance]\nbandwidth = 3.0\n", "from_speed"},
      {pid + "[controllers.main]\nkind = \"lqg\"\nf_max = 60.0\n", "allowed: another one"},
      {pid + "[[controller.schedule]]\nspeed = 10.0\n[[controller.schedule]]\nspeed = 5.0\n",
       "ascending"}};
  for (const Mistake& m : all) {
    try {
      RigWith(m.controller);
      ADD_FAILURE() << m.controller;
    } catch (const InputError& e) {
      const std::string text = e.what();
      EXPECT_NE(text.find(m.said), std::string::npos) << text;
      EXPECT_EQ(text.find('\n'), std::string::npos) << text;
    }
  }
  const RigParameters rig = RigWith(pid);
  EXPECT_THROW(LoadStepAtSpeed(rig, "[[switch]]\ntime = 0.05\nto = \"other\"\n"), InputError);
  EXPECT_THROW(LoadStepAtSpeed(rig, "[[switch]]\ntime = 5.0\nto = \"main\"\n"), InputError);
}

}  // namespace
}  // namespace ambrig
