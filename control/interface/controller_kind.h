#pragma once
/// What a kind of controller is: one file per kind under control/kinds/ with its keys, its
/// tables for the documentation and the controller itself; one line each in kinds/catalogue.cc.
/// Nobody else knows a kind by its name.
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "control/interface/controller_file.h"
#include "control/linear/sampled_plant.h"
#include "control/position/position_controller.h"
#include "core/base/parameter_rows.h"

namespace ambrig {

/// What a kind's keys may refer to.
struct ControllerNames {
  const std::vector<std::string>& axes;    // that it controls, in the rig's order
  const std::vector<std::string>& planes;  // of bearings, disks and stations
};

/// The magnets of one bearing the other way round: from forces to currents.
struct MagnetInverse {
  /// Set-points [A] that give a force [N] with the rotor at a place [m].
  std::function<Lane(const Eigen::Vector2d& force, const Eigen::Vector2d& place)> currents;
  Eigen::Matrix2d negative_stiffness;  // dF/dr of the currents that carry the weight [N/m]
};

/// The nominal rig as a controller is made for it.
struct ControllerSite {
  struct Bearing {
    std::string name;
    bool radial = true;
    double z = 0, sensor_z = 0;  // [m]
    std::size_t index = 0;       // in the rig
    std::vector<std::string> coils;
    double i_max = 0;      // [A]
    bool unipolar = true;  // set-points are not negative
    // Of amplifiers in voltage mode: what a duty of one commands along an axis [N]; else 0.
    double force_per_duty = 0;
  };
  std::vector<std::string> axes;  // that it controls
  std::vector<double> f_max;      // of each [N]
  std::vector<Bearing> bearings;  // that it controls
  double period = 0;              // of the controller [s]
  double inertia_polar = 0;       // of the rotor [kg m²]
  /// The linear plant with all delays at this speed [rad/s], as the controller's synthesis keys
  /// want it.
  std::function<SampledPlant(const ControllerParameters& c, double speed)> plant;
  std::function<MagnetInverse(std::size_t bearing)> inverse;  // by its place in the rig
};

struct ControllerKind {
  std::string_view name;  // as files write it
  std::string_view doc;
  /// The keys of the kind; f_max is read already.
  void (*read)(const TomlTable& t, const ControllerNames& names, ControllerParameters& c);
  /// For all axes of the site. @throws InputError when a synthesis fails.
  std::unique_ptr<PositionController> (*make)(const ControllerParameters& c,
                                              const ControllerSite& site);
  /// Its numbers for `ambrig parameters`; nullptr: none.
  void (*document)(std::vector<ParameterRow>& rows) = nullptr;
  /// One PID for each axis by itself: it also serves where every bearing has its own controller.
  bool per_axis = false;
  /// Designed from the linear plant of the site: it can be designed again for coils
  /// that have failed.
  bool designed = false;
};

/// All kinds, see kinds/catalogue.cc.
std::span<const ControllerKind* const> ControllerKinds();
/// "pid, transfer-function, ..."
std::string ControllerKindNames();
/// @throws std::logic_error for a name that is not in the catalogue.
const ControllerKind& ControllerKindByName(std::string_view name);

}  // namespace ambrig
