#pragma once
#include <string>

namespace ambrig {

/// The linker's identifier of the running program in hexadecimal digits: another
/// build, another text. Empty where the linker wrote none.
std::string BuildId();

}  // namespace ambrig
