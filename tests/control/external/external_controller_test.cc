// A controller in a process of its own: what it is given, what it gives, and how everything that it
// can do wrong is told in one sentence.
#include "control/external/external_controller.h"

#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <cstring>
#include <random>

#include "control/external/ambrig_controller.h"
#include "control/external/controller_link.h"
#include "control/external/host/wire.h"
#include "control/position/pid.h"
#include "core/base/errors.h"
#include "tests/control/external/external_site.h"
#include "tests/core/temporary_folder.h"

namespace ambrig::testing {
namespace {

const std::vector<double> kZero = {0, 0};

/// The sentence that ends a controller which is stepped at t = 2 ms.
std::string EndOf(const ExternalSettings& s) {
  return ErrorText<InputError>([&] {
    ExternalController c(s, SmallSite());
    std::vector<double> f(2);
    const std::vector<BearingControl> control(1);
    for (int k = 0; k < 4; ++k) {
      c.Observe(control, 2e-3 + k * 8e-5);
      c.Step({1e-6, 2e-6}, kZero, kZero, 100, f);
    }
  });
}

std::string EndOf(const char* module, double how) {
  ExternalSettings s = Library(module, {{"how", how}});
  s.timeout = 0.3;
  return EndOf(s);
}

const std::string kWhere = "rig.toml:7: controller.file = \"misbehaves.so\": ";

TEST(ExternalController, EveryWrongdoingHasItsSentence) {
  const std::string step = kWhere + "step at t = 0.002 s: ";
  EXPECT_EQ(EndOf("misbehaves", 0), "");
  EXPECT_EQ(EndOf("misbehaves", 1), step + "divided an integer by zero (SIGFPE)");
  EXPECT_EQ(EndOf("misbehaves", 2), step + "the force of A.y is nan, allowed: finite numbers");
  EXPECT_EQ(EndOf("misbehaves", 3),
            step + "did not answer within 0.3 s, an endless loop? (key timeout)");
  EXPECT_EQ(EndOf("misbehaves", 4),
            step + "crashed: it touched memory that is not its own (SIGSEGV)");
  EXPECT_EQ(EndOf("misbehaves", 5),
            step + "aborted: an exception that it did not catch, or a failed assertion (SIGABRT)");
  EXPECT_EQ(EndOf("misbehaves", 6), step + "step says: the bearing smells of smoke");
  EXPECT_EQ(EndOf("misbehaves", 7), step + "step returned 3 without a message");
  EXPECT_EQ(EndOf("misbehaves", 8), step + "ended its own process with exit code 5");
  EXPECT_EQ(EndOf("misbehaves", 9), step + "the force of A.x is inf, allowed: finite numbers");
  EXPECT_EQ(EndOf("misbehaves", 11),
            step + "was killed from outside, or for want of memory (SIGKILL)");
  EXPECT_EQ(EndOf("misbehaves", 12), step + "step says: " + std::string(255, 'x'));
}

TEST(ExternalController, AnExceptionIsNotOurs) {
  EXPECT_EQ(EndOf(Library("throws")),
            "rig.toml:7: controller.file = \"throws.so\": step at t = 0.00208 s: aborted: an "
            "exception that it did not catch, or a failed assertion (SIGABRT)");
}

TEST(ExternalController, WhatCannotBeLoadedIsToldAtOnce) {
  const auto text = [](const ExternalSettings& s) {
    return ErrorText<InputError>([&] { ExternalController(s, SmallSite()); });
  };
  EXPECT_EQ(text(Library("other_version")),
            "rig.toml:7: controller.file = \"other_version.so\": was compiled for version 99 of "
            "ambrig_controller.h (16 bytes), this ambrig has version 1 (" +
                std::to_string(sizeof(ambrig_controller)) + " bytes)");
  EXPECT_NE(text(Library("no_version")).find("says no version of ambrig_controller.h"),
            std::string::npos);
  EXPECT_NE(text(Library("no_step"))
                .find("has no function ambrig_controller_open or "
                      "ambrig_controller_step"),
            std::string::npos);
  const TemporaryFolder folder;
  WriteBytes(folder.File("text.so"), "not a library");
  ExternalSettings s = Library("pid");
  s.library = folder.File("text.so");
  EXPECT_NE(text(s).find("cannot be loaded: "), std::string::npos) << text(s);
  EXPECT_EQ(text(Library("misbehaves", {{"how", 20}})),
            kWhere + "open says: no parameter pleases me");
  EXPECT_EQ(text(Library("misbehaves", {{"how", 21}})),
            kWhere + "open returned 7 without a message");
  s = Library("misbehaves", {{"how", 22}});
  s.timeout = 0.2;
  EXPECT_EQ(text(s), kWhere + "did not answer within 0.2 s, an endless loop? (key timeout)");
}

TEST(ExternalController, TheReasonIsReadEvenFromAProcessThatEndsAtOnce) {
  for (int k = 0; k < 100; ++k)
    ASSERT_NE(ErrorText<InputError>([] {
                ExternalController(Library("other_version"), SmallSite());
              }).find("was compiled for version 99"),
              std::string::npos)
        << k;
}

TEST(ControllerLink, AReasonSentBeforeAnyQuestionIsRead) {
  const TemporaryFolder folder;
  const std::string path = folder.File("s");
  sockaddr_un a{};
  a.sun_family = AF_UNIX;
  std::memcpy(a.sun_path, path.c_str(), path.size() + 1);
  const int listener = socket(AF_UNIX, SOCK_STREAM, 0);
  ASSERT_EQ(bind(listener, reinterpret_cast<const sockaddr*>(&a), sizeof a), 0);
  ASSERT_EQ(listen(listener, 1), 0);
  ControllerLink link = ControllerLink::Connect("unix:" + path, 1);
  const int other = accept(listener, nullptr, nullptr);
  const wire_header head{WIRE_FAILED, 9};
  ASSERT_EQ(write(other, &head, sizeof head), static_cast<ssize_t>(sizeof head));
  ASSERT_EQ(write(other, "no oil ..", 9), 9);
  close(other);
  close(listener);
  const std::vector<unsigned char> question(16);
  EXPECT_EQ(ErrorText<ControllerFailure>([&] { link.Ask(WIRE_SETUP, question); }), "no oil ..");
  EXPECT_EQ(ErrorText<ControllerFailure>([&] { link.Ask(WIRE_STEP, question); }),
            "ended the connection");
}

TEST(ExternalController, IsToldTheRig) {
  EXPECT_EQ(ErrorText<InputError>([&] {
              ExternalController(Library("echoes", {{"tell", 1}}), SmallSite());
            }),
            "rig.toml:7: controller.file = \"echoes.so\": open says: 2 8 A.x A.y A.coil1 A.coil8 "
            "8e-05 60 6 1 1");
}

TEST(ExternalController, GetsEveryNumberOfThePeriod) {
  ControllerSite site = SmallSite();
  site.axes.push_back("z");
  site.f_max = {1e6, 1e6, 1e6};
  ExternalController c(Library("echoes"), site);
  std::vector<BearingControl> control(1);
  control[0].feedback[0] = 0.5;
  control[0].set_point[1] = 0.25;
  control[0].duty[2] = 0.125;
  const std::vector<double> none(3, 0.0);
  std::vector<double> f(3);
  c.Hold({7, 0, 0}, none, none);
  c.Observe(control, 0.5);
  c.Step({0, 0.02, 0}, {0, 0.03, 0}, {0, 0.04, 0}, 3, f);
  EXPECT_EQ(f[0], 1007);
  EXPECT_DOUBLE_EQ(f[1], 0.5 + 30 + 2 + 30 + 400);
  EXPECT_DOUBLE_EQ(f[2], 0.5 + 2.5 + 12.5);
  c.Track(none, none, 0, {8, 0, 0});
  c.Step(none, none, none, 0, f);
  EXPECT_EQ(f[0], 2008);
}

TEST(ExternalController, CurrentsAreClampedToWhatTheAmplifierGives) {
  ExternalSettings s = Library("echoes");
  std::vector<double> f(2);
  {
    ExternalController forces(s, SmallSite());
    forces.Step(kZero, kZero, kZero, 0, f);
    EXPECT_EQ(forces.SetPoints(0), nullptr);
  }
  s.commands_currents = true;
  ExternalController c(s, SmallSite());
  c.Step(kZero, kZero, kZero, 0, f);
  const Lane* i = c.SetPoints(0);
  ASSERT_NE(i, nullptr);
  EXPECT_EQ((*i)[0], 1.5);
  EXPECT_EQ((*i)[1], 0);  // unipolar
  EXPECT_EQ((*i)[2], 6);
  EXPECT_EQ(c.SetPoints(1), nullptr);  // a bearing that is not its own
  s = Library("misbehaves", {{"how", 10}});
  s.commands_currents = true;
  EXPECT_EQ(EndOf(s),
            kWhere + "step at t = 0.002 s: the current of A.coil3 is nan, allowed: finite numbers");
}

// Two at once have static data of their own: the PID keeps its state in them.
TEST(ExternalController, EachHasStaticDataOfItsOwn) {
  const ExternalSettings s = Library("pid", {{"kp", 1e5}, {"kd", 100}, {"ki", 1e6}});
  ExternalController a(s, SmallSite()), b(s, SmallSite());
  std::vector<double> fa(2), fb(2), alone(2);
  for (int k = 0; k < 5; ++k) a.Step({1e-5, 0}, kZero, kZero, 0, fa);
  b.Step({1e-5, 0}, kZero, kZero, 0, fb);
  DecentralisedPid fresh({2, {1e5, 100, 1e6, 0, 60}}, 8e-5);
  fresh.Step({1e-5, 0}, kZero, kZero, 0, alone);
  EXPECT_EQ(fb[0], alone[0]);
  EXPECT_NE(fa[0], fb[0]);
}

// Random readings, references, excitations, small and far beyond the limits: the same bits each
// period.
TEST(ExternalController, ThePidInCIsThePid) {
  const PidParameters p{4e5, 900, 6e6, 1.5e-4, 60};
  PidParameters second = p;
  second.f_max = 50;
  DecentralisedPid ours({p, second}, 8e-5);
  ExternalController theirs(
      Library("pid", {{"kp", 4e5}, {"kd", 900}, {"ki", 6e6}, {"derivative_time_constant", 1.5e-4}}),
      SmallSite());
  const std::vector<double> y0 = {1e-6, -2e-6}, r0 = {3e-6, 0}, force = {5, -7};
  ours.Hold(force, y0, r0);
  theirs.Hold(force, y0, r0);
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  std::vector<double> f(2), g(2);
  int clamped = 0;
  for (int k = 0; k < 5000; ++k) {
    const double size = k % 1000 < 800 ? 1e-5 : 3e-4;
    const std::vector<double> y = {size * normal(random), size * normal(random)},
                              r = {1e-5 * normal(random), 0}, e = {normal(random), 0};
    ours.Step(y, r, e, 0, f);
    theirs.Step(y, r, e, 0, g);
    ASSERT_EQ(f, g) << k;
    clamped += std::abs(f[0]) == 60;
  }
  EXPECT_GT(clamped, 100);
}

// The child is gone when its controller is, also one that does not want to go.
TEST(ExternalController, AnEndlessLoopIsNotWaitedFor) {
  const auto begin = std::chrono::steady_clock::now();
  EndOf("misbehaves", 3);
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
  EXPECT_GT(took.count(), 0.3);
  EXPECT_LT(took.count(), 3);
}

}  // namespace
}  // namespace ambrig::testing
