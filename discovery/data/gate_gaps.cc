/// Blocks of rows that a record lost while its clock went on: its times tell where.
#include <fmt/format.h>

#include "discovery/data/gate_columns.h"

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
    f.mend = fmt::format("leave_out = [[{:.6g}, {:.6g}]]", from + 0.5 / r.data.rate,
                         to - 0.5 / r.data.rate);
    f.probability = 0.95;
    out.push_back(f);
  }
}

}  // namespace ambrig
