#pragma once
/// When the coils of one bearing that were given up are looked at again. A small current is asked
/// of a coil for at most 35 periods (fdd/commissioned/coil_probe.h); one that behaves as a healthy
/// coil does returns. The first look comes 10 ms after the action, two more follow, each after four
/// times as long, and one before them, after 2 ms, when the orbit has grown by then: an action that
/// made it worse is the first to be doubted. A coil that came back once and is given up again is
/// given up for good.
///
/// Not looked at: a switch that stays on (the current could not be taken away again).
///
/// A coil that works but has been asked for next to no current for 10 ms would not show a fault:
/// the same current is asked of it then and every 50 ms, but not of a shaft that moves by more
/// than 20 % of the clearance: what the current pulls adds to a swing that may already be as large
/// as the bearing can hold.
#include <array>
#include <map>

#include "actuators/magnetics/lane.h"
#include "core/base/parameters.h"
#include "fdd/diagnosis.h"

namespace ambrig {

class CoilProbes {
 public:
  /// Place of the shaft at the bearing at the end of a period [m].
  void Orbit(double t, double x, double y);
  /// How far it has moved along x or y within this slice of 20 ms and the last one, the larger [m];
  /// infinity before one whole slice has been seen: a rotor that has just been lifted may swing.
  double Motion() const;
  void GivenUp(int coil, FaultClass cls, double t);
  /// A coil is driven as one with fewer turns from t on. `room`: of the rotor at the bearing [m].
  /// `closed`: the turns close through a resistance, and what flux they keep out comes slowly.
  void Derated(int coil, double t, double room, bool closed);
  /// The coil after whose derating the orbit grew within 10 ms, by half and by 2.5 % of the
  /// rotor's room (closed turns: within 60 ms, and by 7.5 %), and no other coil was given up or
  /// derated since; -1: none. Told once.
  int MadeWorse(double t);
  /// Whether a coil that works is asked for next to no current at t.
  void Idle(int coil, bool idle, double t);
  /// What Idle was last told of `coil`.
  bool idle(int coil) const { return idle_[static_cast<std::size_t>(coil)].idle; }
  /// The coil whose probe is due, -1: none.
  int Due(double t) const;
  /// Whether `coil` was given up because the reading of its current was wrong: a test current is an
  /// indication then only to a detector that does not doubt its model.
  bool FalseCurrent(int coil) const;
  /// Whether another coil of the bearing waits for its probes after a false reading of its
  /// current, came back from one, or answered as healthy to a detector that doubts its model.
  /// Current sensors do not fail one after the other within milliseconds, a model that is wrong
  /// says just that: such a conclusion is not to be acted on.
  bool OtherFalseCurrent(int coil) const;
  /// A probe of `coil` found it healthy, but the detector doubts its model.
  void Dispute(int coil);
  /// The answer to the probe of `coil`, which was given up, at t.
  void Answer(int coil, bool healthy, double t);
  /// The probe of the idle coil `coil` ended at t.
  void AnswerIdle(int coil, double t);

 private:
  struct Look {
    bool early = false;                        // the look after growth is done, or its time is over
    double next = 0;                           // [s]
    double wait = 0;                           // that led there [s]
    double given_up = 0;                       // [s]
    double orbit_before = 0, orbit_after = 0;  // [m]
    int left = 0;                              // looks to come
    bool false_current = false;
    bool disputed = false;  // a look found it healthy, in doubt
  };
  /// Of a coil that was derated.
  struct Derating {
    double since = 0, until = 0;                     // [s]
    double before = 0, after = 0, least_growth = 0;  // [m]
  };
  /// Of coils that were derated before t: an orbit that grows after another coil has failed is that
  /// coil's.
  void ForgetDeratings(double t);
  bool FalseCurrentIsOpen(int coil) const;
  bool Grown(const Look& look) const;
  int DueIdle(double t) const;

  /// Of a coil that works.
  struct IdleTime {
    bool idle = false;
    double next = 0;  // probe, while it is idle [s]
  };
  std::array<IdleTime, kLanes> idle_;
  double idle_again_ = 0;  // no idle coil is probed before [s]
  std::map<int, Look> looks_;
  std::map<int, Derating> deratings_;
  Lane returned_;          // 1: came back once
  Lane refuted_;           // 1: came back though the reading of its current was called wrong
  double slice_ends_ = 0;  // [s]
  struct Slice {
    double orbit = 0;  // largest displacement [m]
    double least[2] = {kInfinity, kInfinity}, most[2] = {-kInfinity, -kInfinity};  // x, y [m]
  };
  Slice slice_[2];  // this and the last one
};

}  // namespace ambrig
