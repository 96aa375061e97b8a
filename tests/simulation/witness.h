#pragma once
/// Rigs, scenarios and comparisons that the tests of the fidelities share.
#include <algorithm>
#include <cmath>
#include <string>

#include "core/record/read_record.h"
#include "rig/rig_file.h"
#include "scenarios/scenario.h"

namespace ambrig {

inline const std::string kBaseRecords = AMBRIG_SOURCE_DIR "/tests/data/base-records/";

inline RigParameters BaseRig() { return ReadRig(kBaseRecords + "rig.toml"); }
inline Scenario BaseScenario(const std::string& name, const RigParameters& rig) {
  return ReadScenario(kBaseRecords + name + ".toml", rig);
}

/// Difference of two records over the rows that both have, by kind of channel.
struct Difference {
  double current = 0, set_point = 0, position = 0, force = 0;  // largest [A], [A], [m], [N]
  double current_rms = 0;                                      // over all coils and rows [A]
  std::size_t rows = 0;
};

inline Difference Compare(const Record& a, const Record& b) {
  Difference d;
  double sum = 0, count = 0;
  for (const Channel& x : a.channels) {
    const Channel* y = b.Find(x.name);
    if (!y) continue;
    const std::size_t rows = std::min(x.samples.size(), y->samples.size());
    d.rows = std::max(d.rows, rows);
    const bool current = x.name.find(".i") != std::string::npos;
    for (std::size_t k = 0; k < rows; ++k) {
      const double e = std::abs(x.samples[k] - y->samples[k]);
      double& worst = current         ? d.current
                      : x.unit == "m" ? d.position
                      : x.unit == "N" ? d.force
                                      : d.set_point;
      if (x.unit == "A" || x.unit == "m" || x.unit == "N")
        worst = std::isfinite(e) ? std::max(worst, e) : kInfinity;
      if (!current) continue;
      sum += e * e;
      count += 1;
    }
  }
  d.current_rms = count > 0 ? std::sqrt(sum / count) : 0;
  return d;
}

}  // namespace ambrig
