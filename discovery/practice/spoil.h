#pragma once
/// Mistakes that loggers and their users make, put into a case on purpose: to practise on and to
/// test the data gate.
#include <cstdint>
#include <string>

#include "discovery/case/case.h"

namespace ambrig {

/// FAULT or FAULT@CHANNEL: what goes wrong in one record.
struct Spoiling {
  // unit | sign | swap | lag | instrument | clip | freeze | lost | range | scenario
  std::string fault;
  std::string channel;  // "": sampled among those that move
  double amount = 0;    // how much goes wrong; 0: as usual
};

/// Changes the data of record `record` (0: first) of the case and says what was done in one line.
/// Amounts and what is usual: unit: times too large (1000); swap: with the column of its kind that
/// differs most; lag: seconds that all columns are late (0.02); instrument: seconds that all
/// positions are late (0.004); lost: share of the record that is missing in the middle, later rows
/// come earlier (0.08); clip: share of the largest value that is left (0.6); freeze: share of the
/// record (0.15); range: one sample so many times too large (1e4); scenario: the data of another
/// record with the same start and rate are exchanged with these.
/// @throws InputError for an unknown fault or a record that cannot show it.
std::string Spoil(Case& c, std::size_t record, const Spoiling& what, std::uint64_t seed);

/// Whether any column of the record now differs by far more than its noise from what it was.
bool ShowsMistake(const CaseRecord& before, const CaseRecord& after);

}  // namespace ambrig
