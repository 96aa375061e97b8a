#pragma once
/// The checks of the data gate (data_gate.h), one per kind of error. Each marks the columns that it
/// explains.
#include <string>
#include <vector>

#include "discovery/data_gate/gate_columns.h"

namespace ambrig {

// `record`: number in the case.
/// Columns that are empty or at one value in the whole record, and a bus of 0 V.
void CheckConstantColumns(const CaseModel& model, std::size_t record,
                          std::vector<GateColumn>& columns, std::vector<DataFault>& out);
/// Values far beyond what the rig can show, where they are few; later checks leave them out.
void CheckRange(const CaseModel& model, std::size_t record, std::vector<GateColumn>& columns,
                std::vector<DataFault>& out);
/// Positions and coil currents that stand alone among their neighbours.
void CheckSpikes(const CaseModel& model, std::size_t record, std::vector<GateColumn>& columns,
                 std::vector<DataFault>& out);
/// Stretches that stand still, are lost or end at a limit.
void CheckHeld(const CaseModel& model, std::size_t record, std::vector<GateColumn>& columns,
               std::vector<DataFault>& out);
/// Factors that mistakes make: units, signs.
void CheckUnits(const CaseModel& model, std::size_t record, std::vector<GateColumn>& columns,
                std::vector<DataFault>& out);
/// Any factor of a coil current, or of the bus, with its level, after exchanges: a coil whose
/// current were that far off would move the other columns of its bearing, the bus those of all.
void CheckLevelFactors(const CaseModel& model, std::size_t record, std::vector<GateColumn>& columns,
                       std::vector<DataFault>& out);
/// Columns exchanged: two, or more of one kind round a circle.
void CheckSwaps(const CaseModel& model, std::size_t record, std::vector<GateColumn>& columns,
                std::vector<DataFault>& out);
/// Clocks that are late from some row on: of all columns, of those of one instrument or converter,
/// of one or two columns.
void CheckTimes(const CaseModel& model, std::size_t record, std::vector<GateColumn>& columns,
                std::vector<DataFault>& out);
/// A clock that only the measured speed shows: in a run-up that moves nothing else, or of the
/// speed's column alone.
void CheckSpeedTime(const CaseModel& model, std::size_t record,
                    const std::vector<GateColumn>& columns, std::vector<DataFault>& out);
/// Unit or sign of the measured speed beside the profile of the scenario, or a stretch in which it
/// stands still.
void CheckSpeed(const CaseModel& model, std::size_t record, std::vector<DataFault>& out);
/// A record that lasts longer than its scenario: of another one, or of a logger that was stopped
/// late.
void CheckLength(const CaseModel& model, std::size_t record, std::vector<DataFault>& out);
void CheckGaps(const CaseModel& model, std::size_t record, std::vector<DataFault>& out);
/// Against the predictions of the other records' scenarios.
void CheckScenario(const CaseModel& model, const Hypothesis& h, std::size_t record,
                   std::vector<GateColumn>& columns, std::vector<DataFault>& out);
/// As CheckHeld, of stretches from the first row on: those of a column that comes late repeat its
/// first value.
void CheckHeldFromStart(const CaseModel& model, std::size_t record,
                        std::vector<GateColumn>& columns, std::vector<DataFault>& out);
/// Units, signs and exchanges of the set-points of a held rotor, which its scenario commands and no
/// model predicts.
void CheckCommands(const CaseModel& model, const Hypothesis& h, std::size_t record,
                   const std::vector<GateColumn>& columns, std::vector<DataFault>& out);
/// The units of what drives a record with imposed motion or currents instead of being predicted:
/// only values that cannot be show them.
void CheckDrives(const CaseModel& model, std::size_t record, std::vector<DataFault>& out);
/// The unit and the sign of the measured angle of a prescribed speed.
void CheckAngle(const CaseModel& model, std::size_t record, std::vector<DataFault>& out);
/// Readings, set-points and commands against the controller's own program, which no effect of the
/// rig changes: commands that are not those of the scenario, and readings that come late.
void CheckController(const CaseModel& model, std::size_t record,
                     const std::vector<GateColumn>& columns, std::vector<DataFault>& out);

/// Coil currents that come late or early after their own set-points in some records, while the coil
/// follows in others: no effect of the rig does that.
void CheckCurrentClocks(const CaseModel& model, const Hypothesis& h, std::vector<DataFault>& out);

/// Loads of another direction or at other instants than the scenario of a record states, and
/// commands of other sizes, where the other records agree with the model.
void CheckInputs(const CaseModel& model, const std::vector<double>& predicted, const Hypothesis& h,
                 std::vector<DataFault>& out);

/// Two records each of which agrees with the model under the scenario of the other one.
void CheckExchangedRecords(const CaseModel& model, const std::vector<double>& predicted,
                           const Hypothesis& h, std::vector<DataFault>& out);

/// Constant speeds that were not those of the scenario, in records that log no speed: told by the
/// synchronous line of their readings, where other records or the rig's own unbalance confirm that
/// lines turn with the speed.
void CheckTurningSpeeds(const CaseModel& model, const std::vector<double>& predicted,
                        std::vector<DataFault>& out);

/// Gains of the rig file's controllers against those with which the set-points of all records were
/// computed.
void CheckProgram(const CaseModel& model, std::vector<DataFault>& out);

}  // namespace ambrig
