#pragma once
/// A record from a file of any known kind.
#include <string>

#include "core/record/record.h"

namespace ambrig {

/// By extension (.h5 .hdf5, .csv .txt .tsv, .mat), else by the first bytes of the file. Units as in
/// the file. @throws InputError
Record ReadRecord(const std::string& path);

}  // namespace ambrig
