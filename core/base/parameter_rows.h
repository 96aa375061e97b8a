#pragma once
/// Rows of the page that `ambrig parameters` prints, made of the tables that the readers walk.
#include <string>
#include <vector>

#include "core/base/parameters.h"

namespace ambrig {

/// `fallback`: nan where the file must give it.
struct ParameterRow {
  std::string section, key, unit, doc;
  double lo, hi, fallback;
};

template <class P, std::size_t n>
void AddRows(std::vector<ParameterRow>& rows, const std::string& section,
             const Field<P> (&fields)[n]) {
  for (const Field<P>& f : fields)
    rows.push_back({section, std::string(f.key), std::string(f.unit), std::string(f.doc), f.lo,
                    f.hi, P{}.*f.at});
}

}  // namespace ambrig
