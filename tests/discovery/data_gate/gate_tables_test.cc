// Mistakes in static tables are named; what the machine does to all of their forces is not.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "discovery/model/static_predictor.h"
#include "tests/discovery/bench_case.h"
#include "tests/discovery/data_gate/gate_case.h"

namespace ambrig {
namespace {

using testing::CaseOf;
using testing::FaultsOf;
using testing::TemporaryFolder;
using testing::WriteBytes;

constexpr const char* kTable =
    "[[record]]\ndata = \"t.csv\"\nkind = \"static\"\nsd = { \"A.fx\" = 0.02, \"A.fy\" = 0.02 }\n";

/// Faults told of a table of forces over positions and two currents; `write` changes a row before
/// it is written: x [m], i1 [A], i3 [A], fx [N], fy [N].
std::vector<DataFault> FaultsOfTable(const std::function<void(std::vector<double>&)>& write) {
  const TemporaryFolder folder;
  std::vector<std::vector<double>> rows;
  for (const double x : {-5e-5, 0.0, 6e-5})
    for (const double i1 : {0.5, 1.0, 1.8})
      for (const double i3 : {0.3, 1.5}) rows.push_back({x, i1, i3, 0, 0});
  const auto file = [&](bool changed) {
    std::string text = "A.x [m],A.i1 [A],A.i3 [A],A.fx [N],A.fy [N]\n";
    for (std::vector<double> row : rows) {
      if (changed) write(row);
      text += fmt::format("{:.9g},{:.9g},{:.9g},{:.9g},{:.9g}\n", row[0], row[1], row[2], row[3],
                          row[4]);
    }
    WriteBytes(folder.File("t.csv"), text);
    return CaseOf(folder, kTable);
  };
  const Case blank = file(false);
  std::vector<std::vector<double>> columns;
  EXPECT_TRUE(StaticPredictor(blank, blank.records[0]).Predict(blank.rig, columns));
  std::mt19937 draw(9);
  std::normal_distribution<double> noise(0, 0.02);
  for (std::size_t k = 0; k < rows.size(); ++k)
    for (std::size_t o = 0; o < 2; ++o)
      rows[k][3 + o] = columns[o][k] * blank.records[0].table.sd[o][k] + noise(draw);
  return FaultsOf(file(true));
}

void ExpectOfTable(const std::function<void(std::vector<double>&)>& write,
                   const std::vector<std::string>& columns, double factor) {
  const auto faults = FaultsOfTable(write);
  ASSERT_EQ(faults.size(), columns.size()) << columns[0] << " " << factor;
  for (std::size_t k = 0; k < columns.size(); ++k) {
    EXPECT_EQ(faults[k].fault, factor < 0 ? "sign" : "unit") << FaultText(faults[k]);
    EXPECT_EQ(faults[k].channel, columns[k]);
    EXPECT_NEAR(faults[k].factor, factor, 0.02 * std::abs(factor));
    EXPECT_FALSE(faults[k].mend.empty());
  }
}

TEST(GateTables, FactorsOfTables) {
  EXPECT_TRUE(FaultsOfTable([](std::vector<double>&) {}).empty());
  ExpectOfTable([](auto& row) { row[3] *= 1e-3; }, {"A.fx"}, 1e-3);
  ExpectOfTable([](auto& row) { row[4] *= -1; }, {"A.fy"}, -1);
  ExpectOfTable([](auto& row) { row[3] *= 2.3; }, {"A.fx"}, 2.3);
  ExpectOfTable([](auto& row) { row[3] /= 9.80665e-3, row[4] /= 9.80665e-3; }, {"A.fx", "A.fy"},
                1e3 / 9.80665);
  // larger forces in both directions are the machine's
  EXPECT_TRUE(FaultsOfTable([](auto& row) { row[3] *= 1.7, row[4] *= 1.7; }).empty());
}

// A table has no key that leaves out a row: the file has to be corrected, and the row is named.
TEST(GateTables, ReadingsOfATableThatCannotBe) {
  for (const auto& [column, value] : {std::pair{3, 1e30}, {1, 100.0}}) {
    std::size_t row = 0;
    const auto faults = FaultsOfTable([&](auto& cells) {
      if (++row == 5) cells[column] = value;
    });
    ASSERT_EQ(faults.size(), 1U) << value;
    EXPECT_EQ(faults[0].fault, "range");
    EXPECT_EQ(faults[0].channel, column == 3 ? "A.fx" : "A.i1");
    EXPECT_TRUE(FaultText(faults[0]).ends_with(
        "(row 5); no key of a case mends it: correct its values in the file, or leave them empty"))
        << FaultText(faults[0]);
  }
}

TEST(GateTables, WhatWasSetInATable) {
  ExpectOfTable([](auto& row) { row[1] *= 1e-3, row[2] *= 1e-3; }, {"A.i1", "A.i3"}, 1e-3);
  // currents beyond all that an amplifier gives, but all of them
  ExpectOfTable([](auto& row) { row[1] *= 1e3, row[2] *= 1e3; }, {"A.i1", "A.i3"}, 1e3);
  ExpectOfTable([](auto& row) { row[0] *= -1; }, {"A.x"}, -1);
}

}  // namespace
}  // namespace ambrig
