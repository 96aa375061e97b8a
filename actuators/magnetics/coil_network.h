#pragma once
/// The magnetic circuit of one bearing in continuous time, for the reference and averaged engines.
/// Written on its own from base_model.md, as a reference for actuators/magnetics/stator_lanes:
/// windings on poles, whatever they are driven by.
///
///   pole p:    φ_p R_p(g_p) = Σ_w n_w i_w - U,  Σ φ_p = 0 (floating rotor) or U = 0   [Wb]
///   winding w: λ_w = n_w φ_p + L_w i_w          (L_w: its leakage)                    [Wb]
///
/// Given the λ of the windings that conduct (a blocked or broken one has i = 0):
///   φ_p = G_p (m_p - U),  G_p = 1/(R_p + Σ n²/L),  m_p = Σ n λ/L
///
/// The same equations differentiated give dφ/dt and di/dt from dλ/dt and the gaps' speeds.
/// Source: docs/theory/base_model.md section 2, 6.
#include <array>
#include <vector>

#include "actuators/magnetics/stator_lanes.h"

namespace ambrig {

inline constexpr int kMaxWindings = 2 * kLanes;

struct Winding {
  int pole = 0;
  int coil = -1;          // the amplifier that drives it; -1: a loop of shorted turns
  double n = 0;           // signed turns
  double leakage = 0;     // [H]
  double resistance = 0;  // [ohm], of a loop with its short
  bool live = true;       // false: a loop that does not exist yet
  bool broken = false;
  bool conducts = true;
};

/// Currents and fluxes of one instant.
struct NetworkState {
  std::array<double, kLanes> phi{};      // per pole [Wb]
  std::array<double, kMaxWindings> i{};  // per winding [A]
  double fx = 0, fy = 0;                 // on the rotor [N]
};

struct NetworkRates {
  std::array<double, kLanes> phi{};      // [Wb/s]
  std::array<double, kMaxWindings> i{};  // [A/s]
};

class CoilNetwork {
 public:
  /// Geometry and windings of the assembled stator.
  explicit CoilNetwork(const StatorLanes& lanes);

  /// A loop on the pole of coil `coil`, not there until Short is called. Returns its index.
  std::size_t ReserveLoop(int coil);

  /// From linkages at the shaft position (x, y). [Wb], [m]
  void Solve(const double* lambda, double x, double y, NetworkState& s) const;
  /// Rates of `s` when the linkages change by `slope` [V] and the shaft moves with (vx, vy).
  void Rates(const NetworkState& s, const double* slope, double x, double y, double vx, double vy,
             NetworkRates& r) const;
  /// Linkages of given currents. [A] -> [Wb]
  void Linkages(const double* current, double x, double y, double* lambda) const;
  /// Linkage of an open winding: what its pole's flux makes of it. [Wb]
  double OpenLinkage(const NetworkState& s, std::size_t w) const {
    return windings[w].n * s.phi[static_cast<std::size_t>(windings[w].pole)];
  }
  /// Coil `coil` breaks: no current, the others keep their linkages.
  void Break(int coil) { windings[static_cast<std::size_t>(coil)].broken = true; }
  /// A fraction s of coil's turns is shorted through r [ohm], each turn's current and the flux are
  /// continuous; infinite r: the turns are bypassed. `loop`: from ReserveLoop, or -1.
  void Short(int coil, int loop, double s, double r, const NetworkState& now, double* lambda);

  double FieldEnergy(const NetworkState& s, double x, double y) const;  // [J]

  std::vector<Winding> windings;  // coils first, in their order, then loops
  int coils = 0;

 private:
  bool Carries(const Winding& w) const { return w.live && !w.broken && w.conducts; }
  double Gap(int pole, double x, double y) const;

  int poles_ = 0;
  bool floating_ = false;
  GapReluctance reluctance_;
  std::array<double, kLanes> dx_{}, dy_{}, gap_{};  // of a pole: pull direction, centred gap [m]
};

}  // namespace ambrig
