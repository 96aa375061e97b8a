#pragma once
/// Columns of a data file by the name that the person sees there: readers give channels the rig's
/// spelling (A.i1), while MATLAB shows A_i1, an HDF5 viewer /A/i1, a CSV head "A.i1 [A]" or
/// "A.i1 (A)", TDMS and dSPACE paths that end with A.i1.
#include <string>

#include "core/record/record.h"

namespace ambrig {

/// The channel of exactly that name, else the one that a MAT variable, an HDF5 path a CSV head or a
/// path of that name became; nullptr when there is none.
const Channel* FindColumn(const Record& record, const std::string& name);

/// The columns that exist, those most like `wanted` first, at most `most` of them and how many
/// more: for messages.
std::string ColumnsOf(const Record& record, const std::string& wanted, std::size_t most = 12);

}  // namespace ambrig
