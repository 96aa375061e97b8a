#include "discovery/case/response_point.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <charconv>

namespace ambrig {

namespace {

struct PointSuffix {
  std::string_view suffix;
  PointKind kind;
};
constexpr PointSuffix kOfAxis[] = {
    {"", PointKind::kReading},           {".command", PointKind::kCommand},
    {".error", PointKind::kError},       {".shaft", PointKind::kShaft},
    {".force", PointKind::kForcePort},   {".reference", PointKind::kReferencePort},
    {".sensor", PointKind::kSensorPort}, {".load", PointKind::kLoadPort},
};

/// The number from 0 of "coil3", "i3", "s3" behind `mark`; -1 for other texts.
int CoilBehind(std::string_view text, std::string_view mark, int coils) {
  if (!text.starts_with(mark)) return -1;
  text.remove_prefix(mark.size());
  int number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  const bool whole = error == std::errc() && end == text.data() + text.size() && text[0] != '0';
  return whole && number >= 1 && number <= coils ? number - 1 : -1;
}

std::optional<ResponsePoint> PointOfCoil(const BearingParameters& b, std::size_t bearing,
                                         std::string_view rest, const std::string& name) {
  ResponsePoint p;
  p.name = name;
  p.bearing = bearing;
  for (const auto& [mark, kind] :
       {std::pair{"i", PointKind::kCurrent}, std::pair{"s", PointKind::kSetPoint}})
    if ((p.index = CoilBehind(rest, mark, b.coils())) >= 0) {
      p.kind = kind;
      return p;
    }
  for (const auto& [port, kind] :
       {std::pair{".current", PointKind::kCurrentPort}, std::pair{".duty", PointKind::kDutyPort}}) {
    if (!rest.ends_with(port)) continue;
    p.index =
        CoilBehind(rest.substr(0, rest.size() - std::string_view(port).size()), "coil", b.coils());
    p.kind = kind;
    if (p.index >= 0) return p;
  }
  return std::nullopt;
}

}  // namespace

const char* ResponsePoint::unit() const {
  switch (kind) {
    case PointKind::kCommand:
    case PointKind::kForcePort:
    case PointKind::kLoadPort:
      return "N";
    case PointKind::kCurrent:
    case PointKind::kSetPoint:
    case PointKind::kCurrentPort:
      return "A";
    case PointKind::kDutyPort:
      return "";
    default:
      return "m";
  }
}

std::optional<ResponsePoint> ParseResponsePoint(const RigParameters& rig, const std::string& name) {
  for (std::size_t k = 0; k < rig.bearings.size(); ++k) {
    const std::vector<std::string> axes = rig.bearings[k].Axes();
    for (std::size_t side = 0; side < axes.size(); ++side)
      for (const PointSuffix& s : kOfAxis)
        if (name == axes[side] + std::string(s.suffix))
          return ResponsePoint{s.kind, name, axes[side], k, static_cast<int>(side)};
    if (name.starts_with(rig.bearings[k].name + "."))
      if (auto p =
              PointOfCoil(rig.bearings[k], k,
                          std::string_view(name).substr(rig.bearings[k].name.size() + 1), name))
        return p;
  }
  for (const ShaftPlane& s : rig.stations)
    for (const int side : {0, 1})
      if (name == s.name + (side == 0 ? ".x" : ".y"))
        return ResponsePoint{PointKind::kStation, name, name, 0, side};
  return std::nullopt;
}

std::string ResponsePointsText(const RigParameters& rig) {
  const std::string bearing = rig.bearings.empty() ? "A" : rig.bearings.front().name;
  return fmt::format(
      "OUTPUT/INPUT of {} alone or with .command, .error, .shaft, .force, .reference, .sensor, "
      ".load; {}.i1, {}.s1, {}.coil1.current, {}.coil1.duty",
      fmt::join(AxisNames(rig), ", "), bearing, bearing, bearing, bearing);
}

}  // namespace ambrig
