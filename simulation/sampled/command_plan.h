#pragma once
/// The commanded signals of a scenario, sampled once on the controller's and the amplifiers'
/// clocks, so that many runs of one scenario do not evaluate the same sines again.
#include <algorithm>
#include <optional>
#include <vector>

#include "scenarios/scenario.h"

namespace ambrig {

struct CommandPlan {
  CommandPlan(const RigParameters& rig, const Scenario& scenario);

  struct Signal {
    int index;                   // axis (of the rig) or coil (of the bearing)
    int bearing;                 // -1 for axes
    std::vector<double> values;  // per controller tick or per switching period, from t = 0
  };
  std::vector<Signal> force, reference, current, duty;

  /// A coil that flows `amperes` at t = 0: before that its loop holds it there,
  /// whatever is commanded.
  struct StartCurrent {
    int index, bearing;  // as of a coil's signal
    double amperes;
    double set_point;  // that gives it [A]
  };
  std::vector<StartCurrent> start;
  bool StartsAt(const Signal& coil) const {
    return std::ranges::any_of(start, [&](const StartCurrent& s) {
      return s.bearing == coil.bearing && s.index == coil.index;
    });
  }

  struct Switch {
    long long tick = 0;          // of the controller, from t = 0
    std::size_t controller = 0;  // 0: main, then the rig's others
  };
  std::vector<Switch> switches;
  // The controller that is designed again after a redistribution, counted likewise; none:
  // as it was.
  std::optional<std::size_t> retuned;

  static double At(const Signal& s, long long k) {
    if (s.values.empty()) return 0;
    const long long last = static_cast<long long>(s.values.size()) - 1;
    return s.values[static_cast<std::size_t>(k < 0 ? 0 : (k > last ? last : k))];
  }
};

}  // namespace ambrig
