#pragma once
/// The mistakes of practice cases: every kind in turn, of a random size.
#include "discovery/practice/laws/practice_law.h"
#include "discovery/practice/spoil.h"

namespace ambrig {

/// Number `ordinal` of the cases with wrong data; the column is sampled when it is spoilt.
Spoiling DrawMistake(std::size_t ordinal, PracticeDraw draw);

}  // namespace ambrig
