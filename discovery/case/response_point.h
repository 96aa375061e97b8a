#pragma once
/// Between which two points of the rig a frequency response was measured: "OUTPUT/INPUT".
///
/// Outputs   A.x [m] reading, A.x.command [N] force asked for, what was injected included,
/// A.x.error [m]
///           reference less reading, A.x.shaft [m] true position at the magnets, NAME.x [m] shaft
///           at a named plane, A.i1 [A] coil current, A.s1 [A] set-point
/// Ports     A.x.force [N] and A.x.reference [m] of the controller, A.x.sensor [m] added to the
///           reading, A.x.load [N] on the rotor; of a held rotor A.coil1.current [A], A.coil1.duty
///           [-]
///
/// The input is a port, or an output: then the response is the quotient of two outputs under the
/// excitation of a port (plant A.x/A.x.command, current loop A.i1/A.s1).
#include <optional>
#include <string>

#include "rig/parameters/rig_parameters.h"

namespace ambrig {

enum class PointKind {
  kReading,
  kCommand,
  kError,
  kShaft,
  kStation,
  kCurrent,
  kSetPoint,
  kForcePort,
  kReferencePort,
  kSensorPort,
  kLoadPort,
  kCurrentPort,
  kDutyPort,
};

struct ResponsePoint {
  PointKind kind = PointKind::kReading;
  std::string name = {};    // as in the case file
  std::string axis = {};    // "A.x", or "NAME.x" of a station
  std::size_t bearing = 0;  // of an axis or coil
  int index = 0;            // side of the bearing (0, 1), or its coil from 0

  bool port() const { return kind >= PointKind::kForcePort; }
  /// A port of the amplifiers, of a held rotor only.
  bool of_coil() const { return kind >= PointKind::kCurrentPort; }
  const char* unit() const;  // SI; "" for a duty
};

/// nullopt for what is no point of this rig.
std::optional<ResponsePoint> ParseResponsePoint(const RigParameters& rig, const std::string& name);

/// What may be written, with the rig's own names.
std::string ResponsePointsText(const RigParameters& rig);

}  // namespace ambrig
