#pragma once
/// A pole's reluctance 1/P as a function of its gap; base law g/(mu0 A), effects may change it.
/// The pull of a flux phi is (1/2) phi² Pull(g); by virtual work Pull is the
/// reluctance's slope dR/dg.

namespace ambrig {

/// Of the nominal gap: no gap is counted smaller, there the shaft has reached the pole.
inline constexpr double kGapAtPole = 0.02;

struct GapReluctance {
  double per_metre = 0;  // 1/(mu0 A), or 2/(mu0 A) for a thrust core [1/(H m)]
  double iron_path = 0;  // [m] added to the gap (effect iron-reluctance)
  double fringing = 0;   // area grows as 1 + fringing g/gap0 (effect fringing)
  double face_pull = 0;  // share of the fringing flux that pulls like flux through the pole's face
  double gap0 = 1;       // [m]
  double offset = 0;     // [1/H] constant part (opposed magnets: g_c)

  /// Of one gap [m], or of all lanes.
  template <class T>
  [[gnu::always_inline]] T Value(const T& g) const {
    return per_metre * ((fringing == 0 ? g : T(g / (1 + fringing * g / gap0))) + iron_path) +
           offset;
  }
  template <class T>
  [[gnu::always_inline]] T Slope(const T& g) const {
    if (fringing == 0) return per_metre;
    const T a = 1 + fringing * g / gap0;
    return per_metre / (a * a);
  }
  /// Twice the pull over the flux squared [1/(H m)].
  template <class T>
  [[gnu::always_inline]] T Pull(const T& g) const {
    return face_pull == 0 ? Slope(g) : T((1 - face_pull) * Slope(g) + face_pull * per_metre);
  }
  /// dPull/dg [1/(H m²)]: zero but for fringing.
  [[nodiscard]] double PullSlope(double g) const {
    const double a = 1 + fringing * g / gap0;
    return -2 * (1 - face_pull) * per_metre * fringing / (gap0 * a * a * a);
  }
};

}  // namespace ambrig
