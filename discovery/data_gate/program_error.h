#pragma once
/// Where the set-points of a record are not what the program of the rig file's controller makes of
/// its readings and commands.
#include "discovery/model/case_model.h"
#include "discovery/model/controller_block.h"

namespace ambrig {

/// The readings and set-points of a record, with short gaps bridged.
BridgedRecord ControllerRecord(const Record& data);

/// Whether an axis disagrees with the program for good, by more than the record is rounded.
bool IsWrong(const ControllerAxis& a);

/// Whether an axis moves so much that the program shows in it.
bool ShowsProgram(const ControllerAxis& a);

/// Axes of a record whose set-points are what the program makes of their readings: these were
/// logged as the controller saw them.
std::vector<std::string> AnsweredReadings(const CaseModel& model, std::size_t record);

/// Whether the program of the rig file is the one that computed the set-points: an axis of the case
/// that moves agrees.
bool ProgramIsRight(const CaseModel& model);

}  // namespace ambrig
