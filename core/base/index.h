#pragma once
/// Coils, poles and degrees of freedom are counted by int, as in the equations and in Eigen; the
/// containers of the standard library count by std::size_t.
#include <concepts>
#include <cstddef>

namespace ambrig {

/// An index or a count that is not negative, for a container of the standard library.
template <std::signed_integral Int>
constexpr std::size_t AsSize(Int k) {
  return static_cast<std::size_t>(k);
}

}  // namespace ambrig
