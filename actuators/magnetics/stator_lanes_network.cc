/// The general path of the lanes for any stator: the same targets λ*, solved over the
/// whole circuit (network_lanes.h), which runs linearly from the start of a period to its end, as
/// the shaft does. A loop of shorted turns adds to the ampere-turns of its coil: it has the same
/// share on each of the coil's poles.
#include "actuators/magnetics/stator_lanes.h"

namespace ambrig {

void StatorLanes::BeginNetwork(double x0, double y0, double x1, double y1) {
  const auto place = [&](double x, double y, const NetworkPlace& near) {
    return near.network == network.get() && near.x == x && near.y == y ? near
                                                                       : PlaceOf(*network, x, y);
  };
  start_ = place(x0, y0, end_);
  end_ = place(x1, y1, start_);
  now_ = start_;
  force_start_ = PullUnder(now_, AmpereTurns());
  force_end_ = force_start_;
  force_sum_.setZero();
}

void StatorLanes::PlaceNetwork(double fraction) { PlaceBetween(start_, end_, fraction, &now_); }

Lane StatorLanes::AmpereTurns() const {
  Lane out;
  for (int j = 0; j < coils; ++j) out[j] = n[j] * i[j];
  for (const ShortedTurns& s : shorts) out[s.coil] += s.n * s.i;
  return out;
}

Eigen::VectorXd StatorLanes::CountedCurrents(const double* current) const {
  Eigen::VectorXd counted(coils);
  for (int j = 0; j < coils; ++j) counted[j] = n[j] / network->TurnsOf(j) * current[j];
  return counted;
}

void StatorLanes::TakeNetwork() {
  force_end_ = PullUnder(now_, AmpereTurns());
  force_sum_ += force_end_;
}

void StatorLanes::SettleNetwork(double x, double y) {
  now_ = PlaceOf(*network, x, y);
  for (ShortedTurns& s : shorts) s.i = 0;
  phi = FluxUnder(now_, AmpereTurns());
}

}  // namespace ambrig
