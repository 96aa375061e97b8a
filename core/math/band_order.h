#pragma once
/// An order of unknowns that brings the entries of a sparse matrix close to its diagonal.
/// Source: Cuthill and McKee, Proc. 24th ACM conference, 1969.
#include <vector>

namespace ambrig {

/// Unknowns that stand in one equation with each unknown, either way round.
using Neighbours = std::vector<std::vector<int>>;

/// Largest distance between two neighbours when unknown i stands at place[i].
int BandWidth(const Neighbours& neighbours, const std::vector<int>& place);

/// The place of each unknown: as they are where that is within `enough`, else by Cuthill and McKee.
std::vector<int> BandOrder(const Neighbours& neighbours, int enough);

}  // namespace ambrig
