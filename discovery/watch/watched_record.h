#pragma once
/// A new record of a rig that is known: the same experiment as a record of its case, made later.
#include <string>
#include <vector>

#include "discovery/case/case.h"

namespace ambrig {

/// Names of the data files of the case's records over time, in order; of others "".
std::vector<std::string> RecordStems(const std::string& text, const std::string& file);

/// Number of the record that a new data file repeats: the one whose stem its name begins with, the
/// longest of several, "step-05-march.csv" of "step-05.csv"; the only one of a case with one
/// record. -1: none.
int RepeatedRecord(const std::vector<std::string>& stems, const std::string& data);

/// The text of case `file` with its record number `record` alone, which reads `data` and is fitted.
/// @throws InputError
std::string CaseOfOneRecord(const std::string& text, const std::string& file, std::size_t record,
                            const std::string& data);

}  // namespace ambrig
