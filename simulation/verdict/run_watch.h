#pragma once
/// Events and figures of a run, once per switching period, the same in every fidelity: contact,
/// touchdown, drop, orbit, currents, copper loss. Verdict terms:
/// simulation/verdict/contact_watch.h.
///
/// A shaft in a pole is past what the model covers. A body with one magnet alone is free
/// on the side where none stands; more than a gap away from the centre there, with nothing that
/// could catch it, it has fallen: a drop.
#include "simulation/sampled/sampled_data_loop.h"
#include "simulation/verdict/contact_watch.h"

namespace ambrig {

class RunWatch {
 public:
  RunWatch(const SampledDataLoop& loop, RunResult& result);
  /// Copper loss of some coils over a period [W], their largest current [A].
  void Coils(double copper, double peak_current) {
    copper_sum_ += copper;
    result_.metrics.peak_current = std::max(result_.metrics.peak_current, peak_current);
  }
  /// The same of a bearing's coils over a period in which they had these resistances [Ohm].
  void Coils(const Lane& resistance, const CurrentStatistics& current, int coils) {
    // On the way in registers: memory would be waited for at every coil.
    double copper = copper_sum_, peak = result_.metrics.peak_current;
    for (int j = 0; j < coils; ++j) {
      copper += resistance[j] * current.mean_square[j];
      peak = std::max(peak, current.largest[j]);
    }
    copper_sum_ = copper;
    result_.metrics.peak_current = peak;
  }
  /// After period n, with the motion at its end.
  void Period(long long n);
  void Finish();

 private:
  /// Nothing would end a fall.
  bool Uncaught() const;
  /// The distance of a bearing's shaft from its centre counts, `squared` [m²].
  void Count(const SampledBearing& b, double squared, bool late);

  const SampledDataLoop& loop_;
  RunResult& result_;
  ContactWatch contacts_;
  double copper_sum_ = 0;
  std::vector<double> orbit_squared_;  // per bearing, largest distance from the centre [m²]
  double late_squared_ = 0;            // largest in the last tenth of the run [m²]
};

}  // namespace ambrig
