#pragma once
/// Contacts of a run, once per switching period: touchdown, lift-off, drop, clearance left.
///
///   touchdown   first penetration p > 0 (of a resting start: after its first period)
///   drop        in contact at the end of the run, or for longer than the scenario's limit
///
/// A rotor that nothing carries bounces: while it hops it is in contact all the same. A contact is
/// over only when the journal has been free for longer than a bounce through the whole clearance
/// takes, 2 √(4 c/g) = 18 ms for 0.2 mm. Lift-off events and the longest contact count every hop.
/// Source: docs/theory/base_model.md section 8.
#include <vector>

#include "rotor/motion/rotor_model.h"
#include "scenarios/scenario.h"
#include "simulation/record/run_result.h"

namespace ambrig {

class ContactWatch {
 public:
  /// `T`: switching period [s].
  ContactWatch(const RotorModel& rotor, const Scenario& scenario, double T);
  /// Motion at the end of a period; `first`: of the run.
  void Period(const MotionState& s, bool first, RunResult& result);
  void Finish(const MotionState& s, RunResult& result);

 private:
  struct Plane {
    double touching_since = -1, contact_since = -1, last_touch = -kInfinity;  // [s], -1: no contact
    int touches = 0;                                                          // of this contact
  };
  void Watch(Plane& plane, std::size_t k, const MotionState& s, bool first,
             RunResult& result) const;
  static void Drop(const std::string& name, double t, RunResult& result);

  const RotorModel& rotor_;
  const Scenario& scenario_;
  double T_;
  std::vector<Plane> planes_;  // auxiliary bearings, then the axial stops
};

}  // namespace ambrig
