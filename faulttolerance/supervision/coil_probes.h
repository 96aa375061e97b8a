#pragma once
/// When the coils of one bearing that were given up are looked at again. A small current is asked
/// of a coil for at most 1.4 ms (fdd/detectors/coil_probe.h); one that behaves as a healthy coil
/// does returns. The first look comes 10 ms after the action, two more follow, each after four
/// times as long, and one before them, after 2 ms, when the orbit has grown by then: an action that
/// made it worse is the first to be doubted. A coil that came back once and is given up again is
/// given up for good.
///
/// Not looked at: a switch that stays on (the current could not be taken away again).
#include <map>

#include "actuators/magnetics/lane.h"
#include "fdd/diagnosis.h"

namespace ambrig {

class CoilProbes {
 public:
  /// Displacement of the shaft at the bearing at the end of a period [m].
  void Orbit(double t, double displacement);
  void GivenUp(int coil, FaultClass cls, double t);
  /// The coil whose probe is due, -1: none.
  int Due(double t) const;
  /// Whether `coil` was given up because the reading of its current was wrong: a test current is a
  /// witness then only to a detector that does not doubt its model.
  bool FalseCurrent(int coil) const;
  /// The answer to the probe of `coil` at t.
  void Answer(int coil, bool healthy, double t);

 private:
  struct Look {
    bool early = false;                        // the look after growth is done, or its time is over
    double next = 0;                           // [s]
    double wait = 0;                           // that led there [s]
    double given_up = 0;                       // [s]
    double orbit_before = 0, orbit_after = 0;  // [m]
    int left = 0;                              // looks to come
    bool false_current = false;
  };
  bool Grown(const Look& look) const;

  std::map<int, Look> looks_;
  Lane returned_;          // 1: came back once
  double slice_ends_ = 0;  // [s]
  double slice_[2] = {};   // largest displacement of this and of the last slice [m]
};

}  // namespace ambrig
