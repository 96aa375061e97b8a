#pragma once
/// The reference rig with another [controller].
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "rig/rig_file.h"
#include "tests/rig/exact_coils.h"

namespace ambrig {

inline std::string ReferenceText() {
  std::ifstream in(AMBRIG_SOURCE_DIR "/scenarios/library/rigs/reference.toml");
  std::ostringstream out;
  out << in.rdbuf();
  return out.str();
}

/// `controller`: lines of [controller] beside rate, bias current and f_max, and any tables after
/// them.
inline RigParameters RigWith(const std::string& controller) {
  const std::string text = ReferenceText();
  const auto begin = text.find("[controller]"), end = text.find("[bearings.A]");
  EXPECT_NE(begin, std::string::npos);
  return WithExactCoils(ReadRigText(
      text.substr(0, begin) + "[controller]\nrate = 12500.0\nbias_current = 2.0\nf_max = 60.0\n" +
          controller + "\n" + text.substr(end),
      "rig.toml"));
}

inline const std::string kPidGains =
    "kp = 4.0e5\nkd = 900.0\nki = 6.0e6\nderivative_time_constant = 1.5e-4\n";
inline const std::string kTiltTranslation =
    "kind = \"tilt-translation\"\ntranslation = { kp = 8.0e5, kd = 1800.0, ki = 1.2e7, "
    "derivative_time_constant = 1.5e-4 }\n"
    "tilt = { kp = 1.4e4, kd = 31.0, ki = 2.1e5, derivative_time_constant = 1.5e-4 }\n";
/// PD with roll-off, as a transfer function: (kp + kd s)/(1 + s tau)².
inline const std::string kTransfer =
    "kind = \"transfer-function\"\n[[controller.transfer]]\nnumerator = [900.0, "
    "4.0e5]\ndenominator = [4.0e-10, 4.0e-5, 1.0]\n";

/// Every kind of controller that levitates the reference rig.
struct TestedController {
  const char* name;
  std::string controller;
  double load_orbit;  // [m] within which 20 N at A are held from then on
};

inline std::vector<TestedController> LevitatingControllers() {
  const std::string pid = "kind = \"pid\"\n" + kPidGains;
  return {{"filters",
           pid + "[[controller.filter]]\nkind = \"notch\"\nfrequency = 2500.0\nwidth = 400.0\n"
                 "[[controller.filter]]\nkind = \"lead-lag\"\nzero = 600.0\npole = 900.0\naxes = "
                 "[\"A.x\", \"A.y\"]\n",
           1.5e-4},
          {"schedule",
           pid + "[[controller.schedule]]\nspeed = 0.0\n[[controller.schedule]]\nspeed = "
                 "1000.0\nkp = 4.4e5\n",
           1.5e-4},
          {"unbalance", pid + "[controller.unbalance]\nfrom_speed = 800.0\n", 1.5e-4},
          {"transfer", kTransfer, 1.9e-4},
          {"lqg", "kind = \"lqg\"\n", 1.5e-4},
          {"lqg over speeds", "kind = \"lqg\"\nspeeds = [0.0, 600.0]\n", 1.5e-4},
          {"h-infinity", "kind = \"h-infinity\"\n", 1.5e-4},
          {"h-infinity over speeds", "kind = \"h-infinity\"\nspeeds = [0.0, 600.0]\n", 1.5e-4},
          {"tilt-translation", kTiltTranslation + "gyroscopic_compensation = 0.8\n", 1.5e-4}};
}

}  // namespace ambrig
