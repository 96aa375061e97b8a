#pragma once
/// The columns of a record as the data gate sees them, and what its checks ask of them.
#include <string>
#include <vector>

#include "discovery/data/held_values.h"
#include "discovery/data/signal_match.h"
#include "discovery/data_gate/data_gate.h"

namespace ambrig {

/// One column of one record as the gate sees it.
struct GateColumn {
  std::string name;
  MatchedColumn column;    // over the noise floor, samples that are no numbers left out
  Match match;             // of it
  double floor = 1;        // of the channel [SI]
  bool explained = false;  // a fault was found: later checks leave it out
  bool answered = false;   // a reading of which the controller's program makes the set-points
};

/// The columns of a record over time that the model predicts. `predicted`: all rows of `model`.
std::vector<GateColumn> ColumnsOf(const CaseModel& model, const std::vector<double>& predicted,
                                  std::size_t record);

/// What a run shows of a column of `data`, over its floor; empty where the run lacks the channel. A
/// run at another rate is read between its rows.
std::vector<double> ColumnOfRun(const GateColumn& c, const Record& data, const Record& run);

/// The largest zero that the sensor of a channel may have [SI]: two that stand still and differ by
/// no more are not told apart.
double MostZero(const CaseModel& model, const std::string& channel);

/// Largest value that the channel can show [SI]; infinity where nothing limits it.
double LimitOf(const RigParameters& rig, const std::string& channel);

/// rms of measured minus predicted [floors], less a constant of at most `zero` [SI].
double ErrorBesideZero(const GateColumn& c, const std::vector<double>& predicted, double zero);

/// The columns that move most, at most so many, of those that have no fault of their own.
std::vector<const GateColumn*> MovingColumns(const std::vector<GateColumn>& columns,
                                             std::size_t most);

/// The columns that a cause at one of them would move first.
struct Others {
  double error = 0;  // their median [floors]
  bool bearing =
      false;  // they are those of its bearing; false: it has few, they are all of the record
};
Others OthersOf(const std::vector<GateColumn>& columns, const GateColumn& of);
inline constexpr double kAlone =
    0.3;  // of its own error that the others of a column in error may show

/// Whether the current and the set-point of a coil show the same where the model expects something
/// else of this one of them: an amplifier that follows its set-point bears the column out, since a
/// mistake of a logger changes one of the two.
bool BorneOut(const std::vector<GateColumn>& columns, const GateColumn& c);

/// A fault of a column ("": of all) that is as probable as undoing it leaves little: `left`, a
/// share of the error.
DataFault FaultLeaving(const CaseRecord& r, const std::string& channel, const std::string& fault,
                       double left);

/// Line of a case file that leaves out `count` samples from `first` on.
std::string LeaveOutLine(const CaseRecord& r, std::size_t first, std::size_t count);

/// Tells that a column stands still for a stretch ("freeze", or "lost" where it holds 0).
void TellHeld(const CaseRecord& r, const std::string& channel, const HeldStretch& s,
              std::vector<DataFault>& out);

/// Line of a case file that gives a column its right unit, or a gain where no unit does; `factor`:
/// measured over what it should be.
std::string UnitLine(const CaseRecord& r, const std::string& channel, double factor);

/// A column that is `factor` times what it should be, a wrong sign where that is negative, with the
/// line that mends it.
DataFault FactorFault(const CaseRecord& r, const std::string& channel, double factor, double left);

/// Line of a case file that names the scenario of this file for a record.
std::string ScenarioLine(const CaseModel& model, const std::string& scenario_file);

/// Tells a fault "scenario", in place of those without a scenario that fits which were told of the
/// record before.
void TellScenario(DataFault fault, std::vector<DataFault>& out);

inline constexpr double kMoves = 8;  // floors: a column that moves less tells no time

}  // namespace ambrig
