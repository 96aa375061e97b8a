#pragma once
/// Something that happened at one instant of a run.
#include <string>

namespace ambrig {

struct RunEvent {
  double t = 0;  // [s]
  // fault | detected | classified | redistributed | not_redistributed | retuned | not_retuned |
  // alarm_cleared | touchdown | lift_off | drop ...
  std::string kind;
  std::string target;       // "A.coil3", "A"
  std::string fault_class;  // "open", ...
  double fraction = 0;      // of shorted turns
};

}  // namespace ambrig
