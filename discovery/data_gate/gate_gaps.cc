/// Blocks of rows that a record lost while its clock went on: its times tell where.
#include <cmath>

#include "discovery/data_gate/gate_checks.h"
#include "discovery/data_gate/gate_columns.h"

namespace ambrig {

namespace {

constexpr std::size_t kLeastRowsLost = 5;  // fewer are left out without a word

}  // namespace

void CheckGaps(const CaseModel& model, std::size_t record, std::vector<DataFault>& out) {
  const CaseRecord& r = model.data().records[record];
  for (const auto& [from, to] : r.gaps) {
    const double lost = (to - from) * r.data.rate - 1;
    if (lost < kLeastRowsLost - 0.5) continue;
    DataFault f;
    f.record = r.data_file;
    f.fault = "lost";
    f.seconds = lost / r.data.rate;
    const auto first = std::lround((from - r.data.start) * r.data.rate) + 1;
    f.mend = LeaveOutLine(r, static_cast<std::size_t>(first),
                          static_cast<std::size_t>(std::lround(lost) - 1));
    f.probability = 0.95;
    out.push_back(f);
  }
}

}  // namespace ambrig
