#include "app/pages/nuisance_tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "app/text/format.h"
#include "discovery/model/coil_errors.h"

namespace ambrig {

namespace {

bool IsSeen(const NuisanceFound& n) { return std::abs(n.value) > 2 * n.sd; }

/// Errors of the coils, each row of one bearing and kind with the numbers of its coils.
void AddCoilErrorTable(HtmlReport& report, const std::vector<NuisanceFound>& nuisances) {
  std::map<std::pair<std::string, NuisanceGroup>, std::map<int, std::string>> rows;
  int most = 0;
  for (const NuisanceFound& n : nuisances) {
    const std::size_t at = n.coil.find(".coil");
    if (at == std::string::npos || !IsSeen(n)) continue;
    const int coil = std::stoi(n.coil.substr(at + 5));
    rows[{n.coil.substr(0, at), n.group}][coil] = n.group == NuisanceGroup::kCurrentGain
                                                      ? fmt::format("{:+.2f} %", 100 * n.value)
                                                      : FormatSi(n.value, n.unit, 2);
    most = std::max(most, coil);
  }
  if (rows.empty()) return;
  std::vector<std::string> head = {"bearing", "error of coil"};
  for (int coil = 1; coil <= most; ++coil) head.push_back(std::to_string(coil));
  std::vector<std::vector<Cell>> cells;
  for (const auto& [of, amounts] : rows) {
    std::vector<Cell> row = {of.first, ToText(of.second)};
    for (int coil = 1; coil <= most; ++coil) {
      const auto found = amounts.find(coil);
      row.push_back(found == amounts.end() ? "–" : found->second);
    }
    cells.push_back(std::move(row));
  }
  report.Table(head, cells,
               "What the coils of this machine differ by, as the rig file allows; fitted with "
               "everything else (–: within two sd of nothing).");
}

}  // namespace

void AddNuisances(HtmlReport& report, const std::vector<NuisanceFound>& nuisances) {
  std::vector<std::vector<Cell>> rows;
  for (const NuisanceFound& n : nuisances)
    if (n.coil.empty() && IsSeen(n))
      rows.push_back({n.record, n.name,
                      fmt::format("{} ± {}", FormatSi(n.value, n.unit), FormatSi(n.sd, n.unit))});
  if (!rows.empty())
    report.Table({"record", "what differs", "amount"}, rows,
                 "What differs from record to record; fitted with everything else.");
  AddCoilErrorTable(report, nuisances);
}

}  // namespace ambrig
