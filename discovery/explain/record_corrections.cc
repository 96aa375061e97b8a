#include "discovery/explain/record_corrections.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>

#include "discovery/data/clock_shift.h"
#include "discovery/data/input_size.h"

namespace ambrig {

namespace {

/// What the answer says of this nuisance of the record; null: nothing.
NuisanceFound* FoundIn(Explanation& e, const std::string& name, const std::string& record) {
  const auto found = std::ranges::find_if(
      e.nuisances, [&](const NuisanceFound& f) { return f.name == name && f.record == record; });
  return found == e.nuisances.end() ? nullptr : &*found;
}

/// Shift of each record's clock [s]; 0 of one that is larger than MostRowsOff allows.
std::vector<double> ShiftsOfClocks(const Case& c, const std::vector<NuisanceFound>& found) {
  std::vector<double> shift(c.records.size(), 0);
  for (const NuisanceFound& f : found) {
    if (f.name != kTimeShift) continue;
    for (std::size_t r = 0; r < shift.size(); ++r) {
      const double rate = c.records[r].data.rate;
      if (c.records[r].data_file == f.record &&
          std::abs(std::lround(f.value * rate)) <= MostRowsOff(rate))
        shift[r] = f.value;
    }
  }
  return shift;
}

/// "2 rows" of a record, or "0.13 ms" where it is no whole number of them.
std::string InRows(double seconds, double rate) {
  const double rows = std::round(seconds * rate);
  if (std::abs(seconds * rate - rows) > 1e-6) return fmt::format("{:.3g} ms", 1e3 * seconds);
  return fmt::format("{} row{}", rows, rows == 1 ? "" : "s");
}

}  // namespace

void RecordCorrections::Add(const RecordCorrections& found) {
  if (!found.clocks_late.empty()) clocks_late = found.clocks_late;
  inputs_larger.resize(std::max(inputs_larger.size(), found.inputs_larger.size()), 0);
  for (std::size_t r = 0; r < found.inputs_larger.size(); ++r)
    inputs_larger[r] = (1 + inputs_larger[r]) * (1 + found.inputs_larger[r]) - 1;
}

Case Corrected(const Case& c, const RecordCorrections& corrections) {
  return WithInputs(WithClocks(c, corrections.clocks_late), corrections.inputs_larger);
}

void ReportCorrections(const Case& c, const RecordCorrections& corrections, Explanation& e) {
  const std::vector<double>& late = corrections.clocks_late;
  const std::vector<double>& larger = corrections.inputs_larger;
  e.clocks_set_right = !late.empty();
  for (std::size_t r = 0; r < late.size(); ++r) {
    const CaseRecord& record = c.records[r];
    if (late[r] == 0) continue;
    if (NuisanceFound* shift = FoundIn(e, kTimeShift, record.data_file))
      shift->value += late[r];  // what is left when the rows are moved
    else
      e.warnings.push_back(
          fmt::format("the clock of {} is {} {}: its rows are moved", record.data_file,
                      InRows(std::abs(late[r]), record.data.rate), late[r] > 0 ? "late" : "early"));
  }
  for (std::size_t r = 0; r < larger.size(); ++r) {
    const std::string& record = c.records[r].data_file;
    if (larger[r] == 0) continue;
    if (NuisanceFound* gain = FoundIn(e, kInputGain, record))
      gain->value = (1 + larger[r]) * (1 + gain->value) - 1;
    else
      e.warnings.push_back(fmt::format(
          "the commands of {} are {:.2f} % {} than its scenario says: they are simulated so",
          record, 100 * std::abs(larger[r]), larger[r] > 0 ? "larger" : "smaller"));
  }
}

std::vector<double> ClocksOf(const Case& c, const std::vector<NuisanceFound>& found) {
  std::vector<double> late = ShiftsOfClocks(c, found);
  for (std::size_t r = 0; r < late.size(); ++r) {
    const double unit = 1 / std::max(c.records[r].data.rate, c.rig.amplifier.switching_frequency);
    late[r] = unit * std::round(late[r] / unit);
  }
  return late;
}

std::optional<std::vector<double>> LateClocks(const Case& c,
                                              const std::vector<NuisanceFound>& found) {
  const std::vector<double> shift = ShiftsOfClocks(c, found);
  const auto rows = [&](std::size_t r) { return std::lround(shift[r] * c.records[r].data.rate); };
  for (std::size_t r = 1; r < shift.size(); ++r)
    if (rows(r) != rows(0)) return ClocksOf(c, found);
  return {};
}

// Pulses that an amplifier's voltage limits, or that move the instants at which its limiter lets
// go, do not grow in proportion to their set-points: a column of one slope leaves floors of error
// there. They stay free about the sizes found where the case declares them uncertain, or where they
// still differ.
std::optional<std::vector<double>> LargerInputs(const SearchModels& models,
                                                const std::vector<NuisanceKind>& of_records,
                                                const FitResult& base) {
  constexpr double kKnown = 0.1;     // of the prior's sd: the records tell the size, not the prior
  constexpr double kLeastGain = 10;  // of the score
  const auto kind = std::ranges::find(of_records, std::string(kInputGain), &NuisanceKind::name);
  if (kind == of_records.end()) return {};
  const std::vector<CaseRecord>& records = models.data().records;
  std::vector<double> larger(records.size(), 0);
  for (const NuisanceFound& f : AmountsOfNuisances(models.thinned(), base.predicted))
    for (std::size_t r = 0; r < records.size(); ++r)
      if (f.name == kInputGain && f.record == records[r].data_file && f.sd < kKnown * kind->sd)
        larger[r] = f.value;
  const Case changed = WithInputs(models.data(), larger);
  const CaseModel& full = models.full();
  CaseModel trial(changed);
  trial.stop = full.stop;
  trial.LimitAs(full);
  const auto predicted = trial.Predict(base.hypothesis);
  full.runs += trial.runs;
  if (!predicted) return {};
  FitResult by_slope = models.AtAllRows(base), simulated = by_slope;
  if (!by_slope.Stands()) return {};
  simulated.residual = Residual(full, *predicted);
  simulated.ratio_fit = Ratio(full, simulated.residual, Which::kFit);
  simulated.ratio_validate = Ratio(full, simulated.residual, Which::kValidate);
  if (models.Gain(by_slope, simulated) < kLeastGain) return {};
  return larger;
}

}  // namespace ambrig
