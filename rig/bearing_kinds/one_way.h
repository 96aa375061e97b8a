#pragma once

namespace ambrig {

/// Class of the map of a thrust bearing of which one side has no turns left: the other side pulls
/// its own way only.
inline constexpr const char* kOneWay = "one way";

}  // namespace ambrig
