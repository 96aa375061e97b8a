#include "discovery/data_gate/data_gate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "discovery/data_gate/gate_checks.h"
#include "discovery/data_gate/gate_columns.h"
#include "discovery/data_gate/gate_points.h"
#include "discovery/data_gate/program_error.h"
#include "discovery/model/in_parallel.h"

namespace ambrig {

namespace {

/// Whether the model predicts any of the record: not where it loses its rotor at once.
bool Predicted(const CaseModel& model, std::size_t record) {
  return std::ranges::any_of(model.targets(), [&](const Target& t) {
    return t.record == record &&
           std::any_of(model.ok().begin() + static_cast<std::ptrdiff_t>(t.first),
                       model.ok().begin() + static_cast<std::ptrdiff_t>(t.first + t.count),
                       [](char ok) { return ok != 0; });
  });
}

std::vector<DataFault> InspectRecord(const CaseModel& model, const std::vector<double>& predicted,
                                     const Hypothesis& h, std::size_t r) {
  std::vector<DataFault> out;
  if (!OverTime(model.data().records[r])) {
    if (model.data().records[r].kind == RecordKind::kFrf) {
      CheckResponses(model, predicted, h, r, out);
      return out;
    }
    CheckTable(model, predicted, h, r, out);
    // a column in a wrong unit holds values that cannot be, too
    if (out.empty()) CheckTableRange(model, predicted, r, out);
    return out;
  }
  std::vector<GateColumn> columns = ColumnsOf(model, predicted, r);
  CheckLength(model, r, out);
  CheckGaps(model, r, out);
  CheckConstantColumns(model, r, columns, out);
  CheckRange(model, r, columns, out);
  CheckSpikes(model, r, columns, out);
  CheckHeld(model, r, columns, out);
  CheckSpeed(model, r, out);
  CheckDrives(model, r, out);
  if (!Predicted(model, r)) {
    CheckHeldFromStart(model, r, columns, out);
    return out;
  }
  const std::vector<std::string> answered = AnsweredReadings(model, r);
  for (GateColumn& c : columns) c.answered = std::ranges::count(answered, c.name) > 0;
  CheckUnits(model, r, columns, out);
  CheckSwaps(model, r, columns, out);
  CheckLevelFactors(model, r, columns, out);
  CheckTimes(model, r, columns, out);
  CheckHeldFromStart(model, r, columns, out);
  CheckSpeedTime(model, r, columns, out);
  CheckScenario(model, h, r, columns, out);
  CheckController(model, r, columns, out);
  CheckAngle(model, r, out);
  CheckCommands(model, h, r, columns, out);
  return out;
}

std::string Quantity(const DataFault& f) {
  if (f.with == kConjugate) return "has phases of the wrong sign: it is the conjugate";
  if (f.with == kPhase)
    return f.factor < 1 ? "has phases in radians, read as degrees"
                        : "has phases in degrees, read as radians";
  if (f.with == kDecibels)
    return f.factor < 1 ? "has 10 log of its magnitudes, read as 20 log"
                        : "has 20 log of its magnitudes, read as 10 log";
  if (f.with == kLevels) return "has magnitudes in dB, read as they are";
  if (f.with == kInverse) return "is one over what its name says";
  if (f.fault == "unit") return fmt::format("is {:.4g} times what it should be", f.factor);
  if (f.fault == "sign") return "has the wrong sign";
  if (f.fault == "swap")
    return (f.mend.starts_with("channels = ") ? "is exchanged with " : "holds what belongs to ") +
           f.with;
  if (f.fault == "lag")
    return fmt::format("comes {:.4g} ms {}", 1e3 * std::abs(f.seconds),
                       f.seconds > 0 ? "late" : "early");
  if (f.fault == "controller") return "had another controller than the file states";
  if (f.fault == "clip") return fmt::format("is clipped for {:.4g} ms", 1e3 * f.seconds);
  if (f.with == kOtherMachine) return "is of another machine, or of this one in another state";
  if (f.with == kEmpty) return "is empty in the whole record";
  if (f.with == kWholeColumn)
    return fmt::format("holds {} in the whole record", f.fault == "lost" ? "0" : "one value");
  if (f.fault == "freeze") return fmt::format("stands still for {:.4g} ms", 1e3 * f.seconds);
  if (f.fault == "lost") return fmt::format("lacks {:.4g} ms in the middle", 1e3 * f.seconds);
  if (f.fault == "range")
    return "holds values that cannot be" + (f.with.empty() ? "" : fmt::format(" ({})", f.with));
  if (f.seconds > 0) return fmt::format("lasts {:.4g} s longer than its scenario", f.seconds);
  return f.with.empty() ? "does not belong to its scenario" : "belongs to the scenario " + f.with;
}

/// What is to be done where no line of a case file mends a fault.
std::string Correction(const DataFault& f) {
  if (f.with == kPhase) return "state the unit of its phases in the header of the file";
  if (f.with == kLevels) return "write (dB) into the head of its magnitudes";
  if (f.with == kInverse) return "write one over it into the file";
  if (f.with == kDecibels) return "write its magnitudes into the file as 20 log, or as they are";
  if (f.fault == "range") return "correct its values in the file, or leave them empty";
  if (f.with == kOtherMachine)
    return "leave it out, or explain it with the rig file of its machine";
  if (f.fault == "scenario") return "name the scenario that was run (scenario = \"...\")";
  return "correct the file";
}

}  // namespace

std::vector<DataFault> InspectData(const CaseModel& model, const std::vector<double>& predicted,
                                   const Hypothesis& h) {
  std::vector<std::vector<DataFault>> of_record(model.data().records.size());
  InParallel(of_record.size(),
             [&](std::size_t r) { of_record[r] = InspectRecord(model, predicted, h, r); });
  std::vector<DataFault> out;
  for (std::vector<DataFault>& faults : of_record)
    std::ranges::move(faults, std::back_inserter(out));
  if (out.empty()) CheckProgram(model, out);
  if (out.empty()) CheckCurrentClocks(model, h, out);
  return out.empty() ? InspectInputs(model, predicted, h) : out;
}

std::vector<DataFault> InspectInputs(const CaseModel& model, const std::vector<double>& predicted,
                                     const Hypothesis& h) {
  std::vector<DataFault> out;
  CheckExchangedRecords(model, predicted, h, out);
  if (out.empty()) CheckTurningSpeeds(model, predicted, out);
  if (out.empty()) CheckInputs(model, predicted, h, out);
  return out;
}

std::vector<DataFault> InspectDataBelow(CaseModel& model, const std::vector<double>& predicted,
                                        const Hypothesis& h, const std::vector<double>& stated) {
  std::vector<double> own;
  for (std::size_t t = 0; t < stated.size(); ++t) {
    own.push_back(model.targets()[t].floor);
    model.targets()[t].floor = std::min(stated[t], own[t]);
  }
  std::vector<DataFault> out = InspectData(model, predicted, h);
  for (std::size_t t = 0; t < own.size(); ++t) model.targets()[t].floor = own[t];
  return out;
}

std::string FaultText(const DataFault& f) {
  const std::string correction =
      f.mend.empty() ? "no key of a case mends it: " + Correction(f) : "to mend it: " + f.mend;
  return fmt::format("{}: {} {}{}; {}", f.record, f.channel.empty() ? "the record" : f.channel,
                     Quantity(f), f.detail.empty() ? "" : ": " + f.detail, correction);
}

}  // namespace ambrig
