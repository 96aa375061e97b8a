// Controllers written as C99 and compiled: the same bits as the simulated one, for every kind,
// through readings of all sizes, references, excitations, speeds and clamped forces.
#include "control/position/c_code/c_code.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <random>

#include "control/position/state_space_controller.h"
#include "simulation/sampled/controller_setup.h"
#include "tests/campaign/campaign_folder.h"
#include "tests/control/external/external_site.h"
#include "tests/simulation/controlled_rig.h"

namespace ambrig::testing {
namespace {

/// The controller of this rig as C, compiled as its first comment says, with every warning an
/// error.
ExternalSettings Compiled(const PositionController& controller,
                          const std::vector<std::string>& axes, const TemporaryFolder& folder) {
  const std::string source = folder.File("c.c");
  ExternalSettings s;
  s.library = folder.File("c.so");
  s.name = "c.so";
  s.where = "rig.toml:1: controller.file";
  WriteBytes(source, ControllerInC(controller, axes, "title with */ in it\nand a line"));
  const Outcome o =
      Shell(std::string(AMBRIG_C_COMPILER) +
            " -std=c99 -O2 -ffp-contract=off -Wall -Wextra -Wpedantic -Wshadow -Werror -shared "
            "-fPIC -I" AMBRIG_SOURCE_DIR "/control/external " +
            source + " -o " + s.library + " -lm");
  EXPECT_EQ(o.exit, 0) << o.text;
  return s;
}

ControllerSite SiteFor(const std::vector<std::string>& axes) {
  ControllerSite site;
  site.axes = axes;
  site.f_max.assign(axes.size(), 1e9);
  site.period = 8e-5;
  return site;
}

/// Both through the same periods. @return periods in which a force was at its limit.
int Compare(PositionController& ours, PositionController& theirs, std::size_t axes,
            const std::string& what) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  const std::vector<double> zero(axes, 0.0);
  std::vector<double> f(axes), g(axes), y(axes), r(axes), e(axes);
  ours.Hold(zero, zero, zero);
  theirs.Hold(zero, zero, zero);
  int limited = 0;
  for (int k = 0; k < 3000; ++k) {
    const double size = k % 1000 < 900 ? 1e-6 : 2e-4, speed = 1500.0 * k / 3000 - 200;
    for (std::size_t a = 0; a < axes; ++a) {
      y[a] = size * normal(random);
      r[a] = k > 300 ? 1e-6 * normal(random) : 0;
      e[a] = k > 600 ? normal(random) : 0;
    }
    ours.Step(y, r, e, speed, f);
    theirs.Step(y, r, e, speed, g);
    EXPECT_EQ(f, g) << what << ", period " << k;
    if (f != g) return -1;
    for (const double force : f) limited += std::abs(force) == 60;
  }
  return limited;
}

TEST(CCode, EveryKindGivesTheSameBits) {
  std::vector<TestedController> kinds = LevitatingControllers();
  const std::string pid = "kind = \"pid\"\n" + kPidGains;
  kinds.push_back({"pid", pid, 0});
  kinds.push_back(
      {"unbalance round a pid", pid + "[controller.unbalance]\nfrom_speed = 100.0\n", 0});
  kinds.push_back({"lqg over the speed", "kind = \"lqg\"\nspeeds = [0.0, 400.0, 900.0]\n", 0});
  kinds.push_back(
      {"h-infinity over the speed", "kind = \"h-infinity\"\nspeeds = [0.0, 600.0]\n", 0});
  for (const TestedController& k : kinds) {
    const RigParameters rig = RigWith(k.controller);
    std::vector<std::string> axes;
    const auto ours = MakeCentralController(NominalRig(rig), rig.controller, &axes);
    ASSERT_EQ(axes.size(), 4u);
    const TemporaryFolder folder;
    ExternalController theirs(Compiled(*ours, axes, folder), SiteFor(axes));
    EXPECT_GT(Compare(*ours, theirs, axes.size(), k.name), 20) << k.name;
  }
}

// The start agrees to rounding: forces of some 10 N, 1e-9 of them.
TEST(CCode, HoldsAndTracksLikeTheSimulatedOne) {
  for (const TestedController& k : LevitatingControllers()) {
    const RigParameters rig = RigWith(k.controller);
    std::vector<std::string> axes;
    const auto ours = MakeCentralController(NominalRig(rig), rig.controller, &axes);
    const TemporaryFolder folder;
    ExternalController theirs(Compiled(*ours, axes, folder), SiteFor(axes));
    const std::vector<double> force = {10, -12, 8, 20}, y = {1e-6, -2e-6, 3e-6, 0},
                              r = {2e-6, 0, 0, -1e-6}, none(4, 0.0);
    std::vector<double> f(4), g(4);
    ours->Hold(force, y, r);
    theirs.Hold(force, y, r);
    for (int n = 0; n < 40; ++n) {
      if (n >= 10 && n < 20) {
        ours->Track(y, r, 0, force);
        theirs.Track(y, r, 0, force);
      }
      ours->Step(y, r, none, 0, f);
      theirs.Step(y, r, none, 0, g);
      for (int a = 0; a < 4; ++a) EXPECT_NEAR(f[a], g[a], 2e-8) << k.name << ", period " << n;
    }
  }
}

// One axis, many states: the order of a product's sum is another from 128 columns on.
TEST(CCode, LargeAndSmallSystems) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  const auto matrix = [&](Eigen::Index rows, Eigen::Index columns, double size) {
    Eigen::MatrixXd m(rows, columns);
    for (Eigen::Index k = 0; k < m.size(); ++k) m.data()[k] = size * normal(random);
    return m;
  };
  for (const Eigen::Index axes : {1, 3})
    for (const Eigen::Index n : {0, 1, 127, 128, 150}) {
      const auto system = [&] {
        return StateSpace{matrix(n, n, n > 0 ? 0.4 / std::sqrt(static_cast<double>(n)) : 0),
                          matrix(n, axes, 1), matrix(axes, n, 1e6), matrix(axes, axes, 1e6)};
      };
      const auto sides = static_cast<std::size_t>(axes);
      StateSpaceController ours({0, 1000}, {system(), system()}, std::vector<double>(sides, 60));
      std::vector<std::string> names;
      for (std::size_t a = 0; a < sides; ++a) names.push_back("axis" + std::to_string(a));
      const TemporaryFolder folder;
      ExternalController theirs(Compiled(ours, names, folder), SiteFor(names));
      Compare(ours, theirs, sides, fmt::format("{} axes, {} states", axes, n));
    }
}

TEST(CCode, NumbersAreExact) {
  for (const double v : {0.1, 1.0, -3.0, 1e300, 5e-324, 1.0 / 3, -1e22}) {
    EXPECT_EQ(std::strtod(CNumber(v).c_str(), nullptr), v) << CNumber(v);
    EXPECT_NE(CNumber(v).find_first_of(".e"), std::string::npos);  // no integer of C
  }
}

TEST(CCode, RefusesOtherAxes) {
  DecentralisedPid pid({2, {1, 1, 1, 0, 1}}, 1e-4);
  const TemporaryFolder folder;
  const ExternalSettings s = Compiled(pid, {"A.x", "A.y"}, folder);
  EXPECT_NE(ErrorText<InputError>([&] {
              ExternalController(s, SiteFor({"A.x", "B.y"}));
            }).find("open says: made for axes of other names"),
            std::string::npos);
  EXPECT_NE(ErrorText<InputError>([&] {
              ExternalController(s, SiteFor({"A.x"}));
            }).find("open says: made for another number of axes"),
            std::string::npos);
}

// The command, the compiler line of its first comment, and a run with what results.
TEST(CCode, ExportedAndRun) {
  const CampaignFolder f;
  const std::string head = "[controller]\nrate = 12500.0\nbias_current = 2.0\nf_max = 60.0\n";
  const std::string text = ReferenceText(), before = text.substr(0, text.find("[controller]")),
                    after = text.substr(text.find("[bearings.A]"));
  f.Write("rig.toml", before + head + "kind = \"pid\"\n" + kPidGains + "\n" + after);
  f.Write("c.toml", before + head + "kind = \"library\"\nfile = \"controller.so\"\n" + after);
  const std::string scenario = "name = \"s\"\nduration = 0.02\nnoise = true\n";
  f.Write("a.toml", "rig = \"rig.toml\"\n" + scenario);
  f.Write("b.toml", "rig = \"c.toml\"\n" + scenario);
  ASSERT_EQ(f.Ambrig("export rig.toml --controller-c own.c --json own.json").exit, 0);
  ASSERT_EQ(f.Ambrig("export rig.toml --controller-c own.c").exit, 0) << "its own file again";
  const std::string source = f.Read("own.c");
  const std::size_t at = source.find("cc -std=c99");
  ASSERT_NE(at, std::string::npos);
  const Outcome cc = f.In(source.substr(at, source.find('\n', at) - at));
  ASSERT_EQ(cc.exit, 0) << cc.text;
  const Outcome run = f.Ambrig("run a.toml b.toml --no-report --csv");
  ASSERT_EQ(run.exit, 0) << run.text;
  EXPECT_GT(f.Read("out/a.csv").size(), 10000u);
  const std::string a = f.Read("out/a.csv"), b = f.Read("out/b.csv");
  EXPECT_EQ(a.substr(a.find('\n')), b.substr(b.find('\n')));
  f.Write("mine.c", "int main(void) { return 0; }\n");
  EXPECT_EQ(f.Ambrig("export rig.toml --controller-c mine.c").exit, 2);
  EXPECT_EQ(f.Ambrig("export c.toml --controller-c other.c").exit, 2);
  EXPECT_EQ(f.Ambrig("export rig.toml --controller-c other.c --controller no").exit, 2);
}

}  // namespace
}  // namespace ambrig::testing
