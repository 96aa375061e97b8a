#include "analysis/campbell.h"

#include <algorithm>
#include <cmath>

#include "core/math/constants.h"

namespace ambrig {

namespace {

/// 1 for equal shapes, 0 for orthogonal ones (modal assurance criterion).
double Likeness(const Eigen::VectorXcd& a, const Eigen::VectorXcd& b) {
  const double scale = a.squaredNorm() * b.squaredNorm();
  return scale > 0 ? std::norm(a.dot(b)) / scale : 0;
}

double Distance(const ClosedLoopMode& a, const ClosedLoopMode& b) {
  return std::abs(a.s - b.s) / std::max(std::abs(a.s), std::abs(b.s)) +
         0.2 * (1 - Likeness(a.q, b.q));
}

constexpr double kFarthest = 0.5;  // beyond it a mode starts a track of its own

struct Pairing {
  double distance;
  std::size_t track, mode;
};

/// Continues the tracks that end at `before` with the modes of `row`, nearest pairs first.
void Continue(std::vector<ModeTrack>& tracks, double before, const ClosedLoopModes& row) {
  std::vector<Pairing> pairs;
  for (std::size_t t = 0; t < tracks.size(); ++t)
    for (std::size_t m = 0; m < row.modes.size(); ++m)
      if (tracks[t].speed.back() == before)
        if (const double d = Distance(tracks[t].modes.back(), row.modes[m]); d < kFarthest)
          pairs.push_back({d, t, m});
  std::sort(pairs.begin(), pairs.end(),
            [](const auto& a, const auto& b) { return a.distance < b.distance; });
  std::vector<bool> used_track(tracks.size(), false), used_mode(row.modes.size(), false);
  for (const Pairing& p : pairs) {
    if (used_track[p.track] || used_mode[p.mode]) continue;
    used_track[p.track] = used_mode[p.mode] = true;
    tracks[p.track].speed.push_back(row.speed);
    tracks[p.track].modes.push_back(row.modes[p.mode]);
  }
  for (std::size_t m = 0; m < row.modes.size(); ++m)
    if (!used_mode[m]) tracks.push_back({{row.speed}, {row.modes[m]}});
}

}  // namespace

bool ModeTrack::of_rotor() const {
  double share = 0;
  for (const ClosedLoopMode& m : modes) share += m.rotor_share;
  return share >= 0.3 * static_cast<double>(modes.size());
}

Whirl ModeTrack::sense() const { return modes.back().sense(); }

std::vector<ModeTrack> FollowModes(const std::vector<ClosedLoopModes>& rows) {
  std::vector<ModeTrack> tracks;
  for (std::size_t k = 0; k < rows.size(); ++k)
    Continue(tracks, k > 0 ? rows[k - 1].speed : -1, rows[k]);
  return tracks;
}

std::vector<DampedCritical> FindCriticals(const std::vector<ModeTrack>& tracks) {
  std::vector<DampedCritical> out;
  for (const ModeTrack& t : tracks) {
    // an unbalance does not push along the axis
    if (!t.of_rotor() || !t.modes.front().lateral) continue;
    for (std::size_t k = 1; k < t.speed.size(); ++k) {
      const double a = t.modes[k - 1].s.imag() - t.speed[k - 1],
                   b = t.modes[k].s.imag() - t.speed[k];
      if (a * b > 0 || a == b) continue;
      const double fraction = a / (a - b);
      out.push_back(
          {std::lerp(t.speed[k - 1], t.speed[k], fraction), t.modes[fraction < 0.5 ? k - 1 : k]});
    }
  }
  std::sort(out.begin(), out.end(), [](const auto& a, const auto& b) { return a.speed < b.speed; });
  return out;
}

}  // namespace ambrig
