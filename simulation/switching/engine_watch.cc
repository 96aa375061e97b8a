/// What is looked at after every period: figures of the run, the supervisor, drawings of the flux.
#include <algorithm>

#include "simulation/switching/bearing_run.h"
#include "simulation/switching/switching_engine.h"

namespace ambrig {

void SwitchingEngine::Watch(long long n) {
  for (const BearingRun& b : bearings_)
    watch_.Coils(b.plant->lanes.resistance, b.side->current, b.plant->lanes.coils);
  watch_.Period(n);
  const std::size_t events = loop_.Supervise(n, result_);
  if (options_.snapshots && events > 0) Snapshot(result_.events.back().kind);
}

void SwitchingEngine::Snapshot(const std::string& label) {
  for (const BearingRun& b : bearings_) {
    if (b.plant->thrust) continue;
    FluxSnapshot s;
    s.t = std::max(motion_.t, 0.0);
    s.bearing = b.plant->name;
    s.label = label;
    for (int j = 0; j < b.plant->lanes.coils; ++j) {
      s.flux.push_back(b.plant->lanes.phi[j]);
      s.current.push_back(b.plant->lanes.i[j]);
    }
    s.x = b.side->true_x;
    s.y = b.side->true_y;
    result_.snapshots.push_back(std::move(s));
  }
}

}  // namespace ambrig
