#pragma once
#include <string_view>

namespace ambrig {

/// "0.1.0": the version of the project in CMakeLists.txt.
std::string_view Version();
/// "ambrig 0.1.0".
std::string_view ProgramVersion();

}  // namespace ambrig
