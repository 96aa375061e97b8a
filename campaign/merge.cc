#include "campaign/merge.h"

#include <fmt/format.h>

#include <algorithm>

namespace ambrig {

namespace {

std::string Missing(const JournalContent& c) {
  std::string text;
  std::size_t count = 0;
  for (std::size_t run = 0; run < c.header.runs; ++run) {
    if (c.rows.contains(run)) continue;
    if (++count <= 5) text += (count > 1 ? ", " : "") + std::to_string(run);
  }
  return fmt::format("{} of {} runs {} missing ({}{})", count, c.header.runs,
                     count == 1 ? "is" : "are", text, count > 5 ? ", ..." : "");
}

}  // namespace

JournalContent MergeJournals(const std::vector<std::string>& folders, bool partial) {
  JournalContent all;
  for (const std::string& folder : folders) {
    JournalContent part = ReadJournal(folder);
    if (all.header.fingerprint.empty()) all.header = part.header;
    if (part.header.fingerprint != all.header.fingerprint || part.header.runs != all.header.runs)
      throw InputError(
          fmt::format("{}: belongs to another campaign, rig or version of them than {}; allowed: "
                      "shards of one campaign",
                      folder, folders.front()));
    all.damaged += part.damaged;
    for (auto& [run, row] : part.rows) {
      const auto [it, fresh] = all.rows.try_emplace(run, std::move(row));
      if (!fresh && it->second.csv != row.csv)
        throw InputError(
            fmt::format("{}: row of run {} differs from that of another folder, allowed: equal "
                        "rows (same program on all machines)",
                        folder, run));
    }
  }
  if (!partial && all.rows.size() < all.header.runs)
    throw InputError(
        fmt::format("{}: {}; allowed: all shards, or --partial", folders.front(), Missing(all)));
  return all;
}

RowCounts CountRows(const Rows& rows) {
  RowCounts n;
  for (const auto& [run, row] : rows) {
    ++n.rows;
    const std::string verdict = row.At("verdict");
    if (verdict == "error") {
      ++n.error;
      continue;
    }
    (verdict == "up" ? n.up : verdict == "touchdown" ? n.touchdown : n.drop) += 1;
    const auto judged = static_cast<std::size_t>(row.Number("judged"));
    n.faults += judged;
    n.undetected += judged - static_cast<std::size_t>(row.Number("detected"));
    n.wrong_class += judged - static_cast<std::size_t>(row.Number("right_class"));
    if (!row.At("reason").empty()) ++n.reasons[row.At("reason")];
    n.false_alarms += row.Number("false_alarms");
    n.coil_periods += row.Number("coil_periods");
    if (!row.At("detection_delay").empty())
      n.worst_delay = std::max(n.worst_delay, row.Number("detection_delay"));
    if (verdict == "up") n.largest_orbit = std::max(n.largest_orbit, row.Number("peak_orbit"));
  }
  return n;
}

}  // namespace ambrig
