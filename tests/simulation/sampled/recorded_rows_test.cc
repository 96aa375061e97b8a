/// A record of some rows holds these and the last one, with the bits of the whole record.
#include <gtest/gtest.h>

#include "simulation/switching/switching_engine.h"
#include "tests/simulation/witness.h"

namespace ambrig {
namespace {

Record OfRun(double rate, const std::vector<std::size_t>* rows) {
  const RigParameters rig = BaseRig();
  Scenario s = BaseScenario("steps", rig);
  s.duration = 0.00399;
  s.record_rate = rate;
  EngineOptions o;
  o.warm_up = 0.002;
  o.recorded_rows = rows;
  return SwitchingEngine(rig, s, o).Run().record;
}

void ExpectTheRows(double rate, std::vector<std::size_t> rows) {
  const Record whole = OfRun(rate, nullptr), some = OfRun(rate, &rows);
  std::erase_if(rows, [&](std::size_t row) { return row >= whole.rows(); });
  if (rows.empty() || rows.back() + 1 < whole.rows()) rows.push_back(whole.rows() - 1);
  ASSERT_EQ(some.rows(), rows.size()) << rate;
  for (std::size_t c = 0; c < whole.channels.size(); ++c)
    for (std::size_t k = 0; k < rows.size(); ++k)
      EXPECT_EQ(some.channels[c].samples[k], whole.channels[c].samples[rows[k]])
          << rate << " " << whole.channels[c].name << " row " << rows[k];
}

TEST(RecordedRows, AreThoseOfTheWholeRecord) {
  for (const double rate : {5e3, 12.5e3, 25e3, 75e3}) {
    ExpectTheRows(rate, {0, 3, 4, 11});
    ExpectTheRows(rate, {2, 19, 99, 299, 4000});
    ExpectTheRows(rate, {});
  }
}

}  // namespace
}  // namespace ambrig
