#include "discovery/model/record_rows.h"

namespace ambrig {

Record AtRowsOf(const Record& data, const Record& simulated) {
  Record out = data;
  for (Channel& c : out.channels) {
    const Channel* from = simulated.Find(c.name);
    if (!from || from->samples.empty()) continue;
    for (std::size_t k = 0; k < c.samples.size(); ++k)
      c.samples[k] = AtRow(from->samples, simulated.rate, data, k);
  }
  return out;
}

}  // namespace ambrig
