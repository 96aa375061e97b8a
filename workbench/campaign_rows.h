#pragma once
/// The rows of a campaign as they come: what its journal holds so far.
#include <nlohmann/json.hpp>
#include <string>

namespace ambrig::workbench {

/// Of a campaign's folder, rows from number `from` of the journal on: { "columns", "runs", "total",
/// "from", "rows": [ "0,scenario,A:1,..." ] }, at most some thousand at once.
/// @throws InputError when there is no journal yet
nlohmann::ordered_json CampaignRows(const std::string& folder, std::size_t from);

}  // namespace ambrig::workbench
