#pragma once
/// Mistakes that loggers and their users make, put into a case on purpose: to practise on and to
/// test the data gate.
#include <cstdint>
#include <string>

#include "discovery/case/case.h"

namespace ambrig {

/// FAULT or FAULT@CHANNEL: what goes wrong in one record.
struct Spoiling {
  std::string fault;    // unit | sign | swap | lag | clip | freeze | lost | range | scenario
  std::string channel;  // "": drawn among those that move
};

/// Changes the data of record `record` (0: first) of the case and says what was done in one line.
/// unit: 1000 times too large; swap: with the next column of its kind; lag: 20 ms late, all columns;
/// lost: 8 % of the record missing in the middle, later rows come earlier; clip at 60 % of the
/// largest value; freeze for 15 % of the record; range: one sample 1e4 times too large; scenario:
/// the data of another record with the same start and rate are exchanged with these.
/// @throws InputError for an unknown fault or a record that cannot show it.
std::string Spoil(Case& c, std::size_t record, const Spoiling& what, std::uint64_t seed);

}  // namespace ambrig
