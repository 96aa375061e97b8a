/// With a flux linear over a step of h the relaxations are exact:
///
///   e_k <- a_k e_k + b_k Δφ,   a_k = exp(-p_k h),   b_k = w_k (1 - a_k)/(p_k h)
///
/// so that M is linear in the flux at the end of the step (one round of Newton).
#include "effects/relaxation_law.h"

#include <cmath>

#include "actuators/magnetics/law_loop.h"

namespace ambrig {

namespace {

/// Coefficients of a step and what the flux has left behind.
template <int kPoles>
struct RelaxationState {
  double a[kPoles] = {}, b[kPoles] = {};  // [-], [1/H]
  double ab = 0;                          // Σ a_k b_k [1/H]
  double moving = 0;                      // Σ b_k + tail/h: against a change of the flux [1/H]
  double slope = 0;                       // moving + the part at rest [1/H]
  Lane e[kPoles];                         // [A]
  Lane phi;                               // committed [Wb]
  Lane base;                              // drop of the next step less slope * φ [A]

  void SetStep(const Relaxations<kPoles>& r, double h) {
    moving = r.tail / h;
    ab = 0;
    for (int k = 0; k < kPoles; ++k) {
      const double x = r.pole[k] * h;
      a[k] = std::exp(-x);
      b[k] = r.weight[k] * -std::expm1(-x) / x;
      ab += a[k] * b[k];
      moving += b[k];
    }
    slope = moving + r.rest;
    Rebase();
  }

  void Settle(const Lane& at) {
    for (Lane& one : e) one = Lane{};
    phi = at;
    Rebase();
  }

 private:
  void Rebase() {
    for (int j = 0; j < kLanes; ++j) {
      double kept = 0;
      for (int k = 0; k < kPoles; ++k) kept += a[k] * e[k][j];
      base[j] = kept - moving * phi[j];
    }
  }
};

/// Σ x(k) over the poles, in pairs: no long chain of sums.
template <int kPoles, class F>
[[gnu::always_inline]] inline auto SumOverPoles(const F& x) {
  static_assert(kPoles == 8 || kPoles == 10);
  const auto eight = ((x(0) + x(1)) + (x(2) + x(3))) + ((x(4) + x(5)) + (x(6) + x(7)));
  if constexpr (kPoles == 8)
    return eight;
  else
    return decltype(eight)(eight + (x(8) + x(9)));
}

template <class V, int kPoles>
class RelaxationKernel {
 public:
  static constexpr bool kLinear = true;
  [[gnu::always_inline]] explicit RelaxationKernel(const RelaxationState<kPoles>& s)
      : state_(s), phi_(LoadAs<V>(s.phi.v)), base_(LoadAs<V>(s.base.v)) {
    for (int k = 0; k < kPoles; ++k) e_[k] = LoadAs<V>(s.e[k].v);
  }
  [[gnu::always_inline]] const V& Base() const { return base_; }
  [[gnu::always_inline]] double Slope() const { return state_.slope; }
  [[gnu::always_inline]] void Terms(const V& phi, V* drop, V* slope) const {
    *drop = base_ + phi * state_.slope;
    *slope = state_.slope;
  }
  [[gnu::always_inline]] void Commit(const V& phi) {
    // Σ a_k e_k of the new e_k, in what is known before φ and what is not.
    const auto& a = state_.a;
    const V known = SumOverPoles<kPoles>([&](int k) __attribute__((always_inline)) {
      return e_[k] * (a[k] * a[k]);
    });
    const V change = phi - phi_;
    for (int k = 0; k < kPoles; ++k) e_[k] = e_[k] * a[k] + change * state_.b[k];
    base_ = known + change * state_.ab - phi * state_.moving;
    phi_ = phi;
  }
  [[gnu::always_inline]] void Keep(RelaxationState<kPoles>* s) const {
    for (int k = 0; k < kPoles; ++k) Store(s->e[k].v, e_[k]);
    Store(s->phi.v, phi_);
    Store(s->base.v, base_);
  }

 private:
  const RelaxationState<kPoles>& state_;
  V e_[kPoles], phi_, base_;
};

// The numbers of poles that there are.
using EightState = RelaxationState<8>;
using TenState = RelaxationState<10>;
template <class V>
using EightKernel = RelaxationKernel<V, 8>;
template <class V>
using TenKernel = RelaxationKernel<V, 10>;
AMBRIG_LAW_LANES(Eight)
AMBRIG_LAW_COMMIT(Eight)
AMBRIG_LAW_LANES(Ten)
AMBRIG_LAW_COMMIT(Ten)

template <int kPoles, auto kDrop, auto kCommit, auto kLoop>
class RelaxationLaw final : public FluxLaw {
 public:
  explicit RelaxationLaw(const Relaxations<kPoles>& r) : relaxations_(r) {}

  bool linear() const override { return true; }

  void SetStep(double h) override {
    if (h == h_) return;
    h_ = h;
    state_.SetStep(relaxations_, h);
  }

  void Drop(const Lane& phi, Lane* drop, Lane* slope) const override {
    kDrop(state_, phi, drop, slope);
  }
  void Steady(const Lane& phi, Lane* drop, Lane* slope) const override {
    for (int j = 0; j < kLanes; ++j) {
      (*drop)[j] += relaxations_.rest * phi[j];
      (*slope)[j] += relaxations_.rest;
    }
  }
  // e_k = w_k (φ - z_k)
  std::optional<LinearDrop> LinearAt(const Lane& /*phi*/) const override {
    LinearDrop out;
    double at_once = relaxations_.rest;
    for (int k = 0; k < kPoles; ++k) {
      if (relaxations_.weight[k] == 0) continue;
      out.relaxations.push_back({relaxations_.pole[k], relaxations_.weight[k]});
      at_once += relaxations_.weight[k];
    }
    for (double& slope : out.slope.v) slope = at_once;
    out.damping = relaxations_.tail;
    return out;
  }
  void Commit(const Lane& phi) override { kCommit(state_, phi); }
  int RunSamples(const LawLoop& loop, int k, int count) override {
    return kLoop(state_, loop, k, count);
  }
  void Settle(const Lane& phi) override { state_.Settle(phi); }

 private:
  Relaxations<kPoles> relaxations_;
  double h_ = 0;
  RelaxationState<kPoles> state_;
};

}  // namespace

std::unique_ptr<FluxLaw> MakeRelaxationLaw(const Relaxations<8>& r) {
  return std::make_unique<RelaxationLaw<8, EightDrop, EightCommit, EightLoop>>(r);
}

std::unique_ptr<FluxLaw> MakeRelaxationLaw(const Relaxations<10>& r) {
  return std::make_unique<RelaxationLaw<10, TenDrop, TenCommit, TenLoop>>(r);
}

}  // namespace ambrig
