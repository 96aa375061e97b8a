#include "discovery/model/row_stretches.h"

#include "discovery/model/case_model.h"

namespace ambrig {

namespace {

constexpr std::size_t kLengths[] = {1024, 512, 256};  // rows of a stretch

void AddStretches(const CaseModel& model, const Target& t, std::size_t length,
                  std::vector<RowStretch>& out) {
  for (std::size_t first = t.first; first + length <= t.first + t.count;) {
    std::size_t bad = length;
    while (bad > 0 && model.ok()[first + bad - 1]) --bad;
    if (bad > 0) {
      first += bad;
      continue;
    }
    out.push_back({&t, first, length});
    first += length;
  }
}

}  // namespace

std::vector<RowStretch> StretchesOf(const CaseModel& model, const std::vector<const Target*>& of,
                                    std::size_t fewest) {
  for (const std::size_t length : kLengths) {
    std::vector<RowStretch> out;
    for (const Target* t : of) AddStretches(model, *t, length, out);
    if (out.size() >= fewest) return out;
  }
  return {};
}

}  // namespace ambrig
