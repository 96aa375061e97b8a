#pragma once
/// The relative excess c of every coil (slope_excess.h) as ratios of sums over the last 1, 3, 10,
/// 40 and 160 periods, raw and projected:
///
///   projected   what a fit of [1, cos, sin] over the coils leaves, over the share of a single
///               coil's c that it leaves (5/8 of eight): errors common to the bearing and a
///               displaced shaft drop out, a single coil's fault does not. Turns lost by a winding
///               of a thrust side raise the c of its partner, too, and the share counts that: 1/3
///   used        of both the smaller where they have one sign, else 0
///
/// Bearings with fewer than four judged coils have raw values only.
#include <vector>

#include "fdd/commissioned/excess_lanes.h"

namespace ambrig {

class ExcessWindows {
 public:
  explicit ExcessWindows(const LinkageModel& nominal);

  /// One period; coils with gross[j] > 0 add nothing.
  void Add(const SlopeExcess& period, const Lane& without);
  /// Coils that are not judged any more leave the pattern.
  void Leave(int coil);
  void Return(int coil);
  /// Whether the sense of the windings counts as a pattern of the bearing, too: ampere-turns of one
  /// coil that are not what they are taken for move the rotor's potential, which is in c of all
  /// coils with the sign of their windings.
  void TakeSense(bool taken);
  void Clear();

  /// Used c of every coil over window w, 0 while there are too few periods or where its noise is
  /// above `noisiest` [-].
  Lane Used(int w, double noisiest) const;
  /// The same over every window, whose noise is at most its least band over `below`.
  void UsedOfAll(double below, Lane (&used)[kExcessWindows]) const;
  /// Whether surely no used |c| is above its band, nor Pattern(w) above `pattern`: told from the
  /// raw c, which is never smaller. False says nothing.
  bool Calm(const Lane (&band)[kExcessWindows], int w, double pattern) const;
  Lane Raw(int w) const;
  /// c of one phase of one coil over the last `periods` <= 40; 0: not judged.
  double OfPhase(int coil, int phase, int periods) const;
  /// Fit of [1, cos, sin] to c over the judged coils; 0 without a pattern.
  Lane Common(const Lane& c) const;
  /// Largest common, cos or sin part of the raw c over window w [-].
  double Pattern(int w) const;
  long long count() const { return count_; }

 private:
  static constexpr int kRing = 256;
  struct Sums {
    Lane top, bottom;  // of all periods so far
  };
  /// The sums before window w, which is full, and those at its end.
  const Sums& Before(int w) const;
  WindowSums FullWindows() const;
  const Sums& Last() const { return total_[static_cast<std::size_t>((count_ - 1) % kRing)]; }
  struct Phases {
    Lane top[2], bottom[2];
  };
  void Basis();
  void Window(int w, Lane* c, Lane* bottom) const;

  LinkageModel model_;
  std::vector<Sums> total_;
  std::vector<Phases> phases_;
  static constexpr int kMostDirections = 4;
  void AddDirection(const Lane& direction);
  /// What the projection leaves of a coil's c.
  double ShareLeft(int coil) const;

  Lane judged_;
  bool sense_ = false;                    // the windings' sense is taken off
  Lane basis_[kMostDirections];           // orthonormal over the judged coils
  double largest_[kMostDirections] = {};  // element of each
  Lane inverse_share_;  // over what the projection leaves of a fault's c, 0: no projection
  int directions_ = 0;
  long long count_ = 0;
};

}  // namespace ambrig
