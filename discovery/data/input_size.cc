#include "discovery/data/input_size.h"

namespace ambrig {

Case WithInputs(const Case& c, const std::vector<double>& larger) {
  Case out = c;
  for (std::size_t r = 0; r < out.records.size() && r < larger.size(); ++r)
    for (Excitation& e : out.records[r].scenario.excitations) e.amplitude *= 1 + larger[r];
  return out;
}

}  // namespace ambrig
