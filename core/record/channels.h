#pragma once
/// The table of channels: every quantity that a record may hold, with its name, its unit
/// and who can read it on a real rig. Names are made from the table and understood by
/// it, nowhere else.
#include <optional>
#include <string>
#include <string_view>

#include "core/record/record.h"

namespace ambrig {

enum class ChannelKind {
  kTruePosition,
  kLoadCell,
  kReading,
  kCoilCurrent,
  kSetPoint,
  kDuty,
  kSpeed,
  kAngle,
  kBus,
};

/// What one channel of a kind belongs to: the rig, a direction at a plane, a coil of a bearing.
enum class ChannelScope { kRig, kDirection, kCoil };

/// Who can read a channel: the controller itself, only a data logger, only the simulator.
enum class ChannelReader { kController, kLogger, kSimulator };

/// The least error of a channel that can mean anything: the step of its converter or
/// the rounding of its file, max(least, part * range).
struct ChannelResolution {
  enum class Range {
    kNone,
    kAdc,
    kBusVoltage,
    kSignal
  };                 // kSignal: standard deviation of the data
  double least = 0;  // in the channel's unit
  double part = 0;   // of the range
  Range range = Range::kNone;
};

struct ChannelRow {
  ChannelKind kind;
  ChannelScope scope;
  std::string_view mark;   // rig: the name; direction: "f" of "A.fx"; coil: "i" of "A.i3"
  std::string_view axial;  // name along the shaft; empty: by the plane as the other directions
  std::string_view unit;
  std::string_view words;  // for reports
  ChannelReader reader;
  bool may_be_constant;  // one value throughout a levitated run is no sign of a dead logger
  ChannelResolution resolution;
};

/// The first row that fits a name counts: "A.r.x" is a true position before it is a reading.
inline constexpr ChannelRow kChannels[] = {
    {ChannelKind::kTruePosition,
     ChannelScope::kDirection,
     "r.",
     "r.z",
     "m",
     "true position",
     ChannelReader::kSimulator,
     false,
     {1e-9, 1e-6, ChannelResolution::Range::kSignal}},
    {ChannelKind::kLoadCell,
     ChannelScope::kDirection,
     "f",
     "",
     "N",
     "load cell",
     ChannelReader::kLogger,
     false,
     {1e-3}},
    {ChannelKind::kReading,
     ChannelScope::kDirection,
     "",
     "z",
     "m",
     "reading",
     ChannelReader::kController,
     false,
     {1e-9, 1e-6, ChannelResolution::Range::kSignal}},
    {ChannelKind::kCoilCurrent,
     ChannelScope::kCoil,
     "i",
     "",
     "A",
     "current",
     ChannelReader::kController,
     false,
     {0, 1e-5, ChannelResolution::Range::kAdc}},
    {ChannelKind::kSetPoint,
     ChannelScope::kCoil,
     "s",
     "",
     "A",
     "set-point",
     ChannelReader::kController,
     true,
     {0, 1e-5, ChannelResolution::Range::kAdc}},
    {ChannelKind::kDuty,
     ChannelScope::kCoil,
     "d",
     "",
     "-",
     "duty",
     ChannelReader::kController,
     true,
     {1e-5}},
    {ChannelKind::kSpeed,
     ChannelScope::kRig,
     "omega",
     "",
     "rad/s",
     "speed",
     ChannelReader::kController,
     true,
     {0.05}},
    {ChannelKind::kAngle,
     ChannelScope::kRig,
     "theta",
     "",
     "rad",
     "angle",
     ChannelReader::kController,
     true,
     {1e-9, 1e-6, ChannelResolution::Range::kSignal}},
    {ChannelKind::kBus,
     ChannelScope::kRig,
     "bus",
     "",
     "V",
     "bus",
     ChannelReader::kController,
     true,
     {0, 1e-4, ChannelResolution::Range::kBusVoltage}},
};

const ChannelRow& RowOf(ChannelKind kind);

/// One channel: its kind and what it belongs to.
struct ChannelId {
  ChannelKind kind = ChannelKind::kReading;
  std::string plane = {};  // bearing or station; empty: of the rig, or along the shaft
  int index = 0;           // direction 0 x, 1 y, 2 z; coil from 0

  std::string name() const;  // "A.x", "z", "A.r.x", "A.fz", "A.i1", "bus"
  const ChannelRow& row() const { return RowOf(kind); }
  bool operator==(const ChannelId&) const = default;
};

/// nullopt for a name that is no channel's.
std::optional<ChannelId> ParseChannel(std::string_view name);
/// Whether this is the name of a channel of this kind.
bool IsOfKind(std::string_view name, ChannelKind kind);
/// What reports call the channel: the words of its kind, or "unknown".
std::string_view ChannelWords(std::string_view name);

/// nullptr when absent.
const Channel* Find(const Record& record, const ChannelId& id);

}  // namespace ambrig
