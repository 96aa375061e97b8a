#include "discovery/data/gate_columns.h"

#include <algorithm>
#include <utility>

namespace ambrig {

namespace {
constexpr double kZeroSds = 4;
}

double MostZero(const CaseModel& model, const std::string& channel) {
  const auto& declared = model.data().nuisances.sensor_zero;
  const auto own = declared.find(channel);
  const double usual = UsualZero(model.data().rig, channel);
  return kZeroSds * (own == declared.end() ? usual : std::max(own->second, usual));
}

double ErrorBesideZero(const GateColumn& c, const std::vector<double>& predicted, double zero) {
  double sum = 0, n = 0;
  for (std::size_t k = 0; k < c.column.size(); ++k)
    if (c.column.ok[k]) sum += c.column.measured[k] - predicted[k], n += 1;
  const double most = zero / c.floor, mean = n > 0 ? std::clamp(sum / n, -most, most) : 0;
  std::vector<double> shifted = predicted;
  for (double& p : shifted) p += mean;
  return ErrorAgainst(c.column.measured, shifted, c.column.ok);
}

std::vector<const GateColumn*> MovingColumns(const std::vector<GateColumn>& columns,
                                             std::size_t most) {
  std::vector<const GateColumn*> out;
  for (const GateColumn& c : columns)
    if (!c.explained && c.match.predicted_move > kMoves && c.match.measured_move > kMoves)
      out.push_back(&c);
  std::stable_sort(out.begin(), out.end(), [](const auto* a, const auto* b) {
    return a->match.predicted_move > b->match.predicted_move;
  });
  if (out.size() > most) out.resize(most);
  return out;
}

DataFault FaultLeaving(const CaseRecord& r, const std::string& channel, const std::string& fault,
                       double left) {
  DataFault f;
  f.record = r.data_file;
  f.channel = channel;
  f.fault = fault;
  f.probability = std::clamp(1 - left * left, 0.5, 0.999);
  return f;
}

void TellScenario(DataFault fault, std::vector<DataFault>& out) {
  std::erase_if(out, [&](const DataFault& told) {
    return told.record == fault.record && told.fault == fault.fault && told.with.empty();
  });
  out.push_back(std::move(fault));
}

}  // namespace ambrig
