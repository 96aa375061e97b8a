#include "discovery/explain/unseen_error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace ambrig {

namespace {
constexpr double kAllExplained = 1.1;  // ratio of what is left when all is explained
constexpr double kStandsOutUnseen = 3, kHardlyShows = 1.5;  // ratio of a channel in a record
}  // namespace

std::optional<std::size_t> OnlyUnseen(const Case& c, const Explanation& e) {
  const bool open =
      e.verdict == ExplanationVerdict::kUnknown || e.verdict == ExplanationVerdict::kEffect;
  const std::vector<RemainderPlace>& where = e.remainder.where;
  if (!open || e.final_ratio_fit > kAllExplained || where.empty() ||
      where[0].ratio < kStandsOutUnseen)
    return {};
  std::optional<std::size_t> worst;
  for (std::size_t r = 0; r < c.records.size(); ++r) {
    const CaseRecord& record = c.records[r];
    const auto here = [&](const RemainderPlace& p) { return p.record == record.data_file; };
    if (!record.validate && std::ranges::any_of(where, [&](const RemainderPlace& p) {
          return here(p) && p.ratio > kHardlyShows;
        }))
      return {};
    if (record.validate && here(where[0])) worst = r;
  }
  return worst;
}

Case WithFitted(const Case& c, std::size_t record) {
  Case out = c;
  out.records[record].validate = false;
  return out;
}

Explanation TheBetter(const Case& c, std::size_t record, Explanation before, Explanation again) {
  const bool explains = again.verdict == ExplanationVerdict::kEffect &&
                        std::max(again.final_ratio_fit, again.final_ratio_validate) < kAllExplained;
  Explanation& out = explains ? again : before;
  const std::string& file = c.records[record].data_file;
  out.warnings.push_back(
      explains ? fmt::format("{} alone shows the error: it is fitted, and no unseen record "
                             "confirms what was found",
                             file)
               : fmt::format("{} alone shows the error: fitting it too explains no more", file));
  out.runs = before.runs + again.runs;
  out.seconds = before.seconds + again.seconds;
  return std::move(out);
}

}  // namespace ambrig
