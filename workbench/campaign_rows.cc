#include "workbench/campaign_rows.h"

#include <fstream>
#include <sstream>

#include "core/base/journal.h"

namespace ambrig::workbench {
namespace {
constexpr std::size_t kMostRows = 5000;
}

nlohmann::ordered_json CampaignRows(const std::string& folder, std::size_t from) {
  nlohmann::ordered_json out{{"columns", nlohmann::ordered_json::array()}, {"runs", 0}};
  std::string line, cell;
  std::ifstream table(folder + "/table.csv");
  std::getline(table, line);
  std::istringstream cells(line);
  while (std::getline(cells, cell, ',')) out["columns"].push_back(cell);
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  std::size_t total = 0;
  const JournalVisitor visit{[&](std::string_view header) {
                               const auto json = nlohmann::json::parse(header, nullptr, false);
                               if (json.is_object()) out["runs"] = json.value("runs", 0);
                             },
                             [&](const JournalEntry& entry) {
                               if (total++ >= from && rows.size() < kMostRows)
                                 rows.push_back(std::string(entry.text));
                               return true;
                             }};
  ReadJournalFile(folder + "/journal.txt", visit);
  out["total"] = total;
  out["from"] = from;
  out["rows"] = std::move(rows);
  return out;
}

}  // namespace ambrig::workbench
