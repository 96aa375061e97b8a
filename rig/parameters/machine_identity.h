#pragma once
/// Which machine a rig file describes, beside its nominal values: what a commissioning must have
/// been made on to hold for it. Names and short hashes only; no value can be told from it.
#include <string>
#include <vector>

namespace ambrig {

struct MachineIdentity {
  /// Of one number, or one effect.
  struct Part {
    std::string name;     // "bearings.A.gap", "eddy-currents at A"
    std::string hash;     // of its values, 8 hexadecimal digits
    std::string bearing;  // that it belongs to; empty: all
  };
  bool known = false;         // read from a rig file, or from a file that has it
  double unit = 1;            // [amplifier] unit
  bool unit_counts = false;   // the amplifier has spreads, whose draws are those of the unit
  std::vector<Part> fitted;   // numbers of bearings and amplifier with a calibrated value
  std::vector<Part> effects;  // of coils, bridges, iron and sensors; not of the shaft alone
};

}  // namespace ambrig
