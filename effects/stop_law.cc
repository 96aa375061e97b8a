#include "effects/stop_law.h"

#include "actuators/magnetics/law_loop.h"

namespace ambrig {

namespace {

/// One stop operator per row, all lanes; in units of flux [Wb].
struct StopsState {
  double radius[kStops] = {};   // r_k [Wb]
  double tangent[kStops] = {};  // MMF over flux of a stop that follows [1/H]
  Lane s[kStops];
  Lane phi;
};

template <class V>
class StopsKernel {
 public:
  static constexpr bool kLinear = false;
  [[gnu::always_inline]] explicit StopsKernel(const StopsState& stops)
      : stops_(stops), phi_(LoadAs<V>(stops.phi.v)) {
    for (int k = 0; k < kStops; ++k) s_[k] = LoadAs<V>(stops.s[k].v);
  }
  [[gnu::always_inline]] void Terms(const V& phi, V* drop, V* slope) const {
    const V change = phi - phi_;
    V sum[2] = {}, tangents[2] = {};  // of even and odd stops
    for (int k = 0; k < kStops; ++k) {
      const V free = s_[k] + change, held = Held(free, stops_.radius[k]);
      sum[k % 2] += held * stops_.tangent[k];
      tangents[k % 2] += Select(held == free, V(stops_.tangent[k]), V(0.0));
    }
    *drop = sum[0] + sum[1];
    *slope = tangents[0] + tangents[1];
  }
  [[gnu::always_inline]] void Commit(const V& phi) {
    const V change = phi - phi_;
    for (int k = 0; k < kStops; ++k) s_[k] = Held(s_[k] + change, stops_.radius[k]);
    phi_ = phi;
  }
  [[gnu::always_inline]] void Keep(StopsState* stops) const {
    for (int k = 0; k < kStops; ++k) Store(stops->s[k].v, s_[k]);
    Store(stops->phi.v, phi_);
  }

 private:
  /// s + Δφ, held within ±r.
  [[gnu::always_inline]] static V Held(const V& free, double r) {
    return Min(Max(free, V(-r)), V(r));
  }

  const StopsState& stops_;
  V s_[kStops], phi_;
};
AMBRIG_LAW_LANES(Stops)
AMBRIG_LAW_COMMIT(Stops)

class StopLaw final : public FluxLaw {
 public:
  StopLaw(const std::array<double, kStops>& radius, const std::array<double, kStops>& tangent) {
    for (std::size_t k = 0; k < kStops; ++k) {
      stops_.radius[k] = radius[k];
      stops_.tangent[k] = tangent[k];
    }
  }
  void Drop(const Lane& phi, Lane* drop, Lane* slope) const override {
    StopsDrop(stops_, phi, drop, slope);
  }
  void Steady(const Lane& phi, Lane* drop, Lane* slope) const override {
    StopsDrop(AtRest(), phi, drop, slope);
  }
  void Commit(const Lane& phi) override { StopsCommit(stops_, phi); }
  int RunSamples(const LawLoop& loop, int k, int count) override {
    return StopsLoop(stops_, loop, k, count);
  }
  void Settle(const Lane& phi) override {
    stops_ = AtRest();
    StopsCommit(stops_, phi);
  }

 private:
  /// Iron that has never been magnetised.
  StopsState AtRest() const {
    StopsState stops = stops_;
    for (Lane& s : stops.s) s = Lane{};
    stops.phi = Lane{};
    return stops;
  }

  StopsState stops_;
};

}  // namespace

std::unique_ptr<FluxLaw> MakeStopLaw(const std::array<double, kStops>& radius,
                                     const std::array<double, kStops>& tangent) {
  return std::make_unique<StopLaw>(radius, tangent);
}

}  // namespace ambrig
