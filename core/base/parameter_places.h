#pragma once
/// Numbers of a parameter struct by their keys, for code that walks tables of several types.
#include <functional>
#include <string_view>

#include "core/base/parameters.h"

namespace ambrig {

/// One number: where it lies, and what its table says of it.
struct ParameterPlace {
  std::string_view key;
  double* at;
  double lo, hi;  // [unit]
  std::string_view unit;
};

using PlaceVisitor = std::function<void(const ParameterPlace&)>;

template <class P, std::size_t n>
void VisitPlaces(P& p, const Field<P> (&fields)[n], const PlaceVisitor& visit) {
  for (const Field<P>& f : fields) visit({f.key, &(p.*f.at), f.lo, f.hi, f.unit});
}

}  // namespace ambrig
