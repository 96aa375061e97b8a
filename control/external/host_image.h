#pragma once
/// The program of control/external/host, linked into this one as bytes, so that
/// a controller's process can be started wherever ambrig is used: as the command, from Python,
/// inside a test.
#include <string>

namespace ambrig {

/// A path that can be executed as long as this process lives.
/// @throws ControllerFailure when the system allows no program in memory.
const std::string& ControllerHostPath();

/// The text of control/external/ambrig_controller.h.
std::string ControllerHeader();

}  // namespace ambrig
