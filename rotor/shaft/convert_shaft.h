#pragma once
/// A shaft's file from ROSS's kind to ours or back (rotor/shaft/shaft_file.h,
/// rotor/shaft/ross_file.h).
#include <string>
#include <vector>

namespace ambrig {

struct ShaftConversion {
  bool from_ross = false;
  double mass = 0, z_com = 0;            // [kg], [m] on the shaft's own axis
  std::vector<double> free_bending;      // lowest four [Hz]
  std::size_t magnetic_bearings = 0;     // of the rig on ambrig's side
  std::vector<std::string> not_carried;  // what the other kind does not know, with sizes
};

/// Reads `in`, writes the other kind to `out`. @throws InputError, before anything is written.
ShaftConversion ConvertShaft(const std::string& in, const std::string& out);

}  // namespace ambrig
