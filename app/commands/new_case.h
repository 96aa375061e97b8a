#pragma once
/// The scenario and the case that `ambrig new` writes for a record.
#include <string>
#include <vector>

#include "app/commands/new_body.h"
#include "app/commands/new_columns.h"
#include "core/record/channels.h"

namespace ambrig {

/// What drives the coils of the case's scenario.
enum class CommandSource { kDuty, kSetPoint, kCurrent, kNone };

bool KnowsAll(const std::vector<ColumnChoice>& all, const RigParameters& rig, ChannelKind kind);
CommandSource DriveOf(const std::vector<ColumnChoice>& all, const RigParameters& rig);

/// Readings count from the centred rotor. A column of distances from the magnet that stands still
/// says where the body is held; other places beyond the gap are none. Such columns are taken out of
/// `choices`, and it is said. Returns the place held along the axis [m].
double HoldAtDistance(const RigParameters& rig, const Record& record,
                      std::vector<ColumnChoice>& choices);

/// Which columns were taken for what, with their ranges; notes of the reader; what drives the
/// coils.
/// @throws InputError where nothing does
void PrintChoices(const Record& r, const std::vector<ColumnChoice>& all, const RigParameters& rig);

/// The record's own commands drive the coils; `data`: its file; `held`: of a body that stands [m].
std::string ScenarioOfRecord(const RigParameters& rig, const Record& record,
                             const std::vector<ColumnChoice>& all, const std::string& data,
                             double held);
/// A levitated rotor that the measured currents drive.
std::string RotorScenario(const RigParameters& rig, const Record& record);

/// A [[record]] of the case.
struct BenchRecord {
  std::string scenario, data, imposed;
  std::vector<ColumnChoice> columns;
};
/// What a record can say, of its coils in gaps that move as measured (or stand), and of the rotor
/// under the measured currents where positions and currents of everything that moves are known and
/// the body hovers. Of a rotor that hovers no record of the coils is made where it lacks the
/// commands between its rows.
std::vector<BenchRecord> RecordsOf(const RigParameters& rig, const Record& record,
                                   const std::vector<ColumnChoice>& all, const std::string& coils,
                                   const std::string& rotor, const std::string& data,
                                   BodySaid said);
std::string CaseText(const std::vector<BenchRecord>& all);
/// Without a record: half a second of levitation.
std::string LevitationText(const RigParameters& rig);

}  // namespace ambrig
