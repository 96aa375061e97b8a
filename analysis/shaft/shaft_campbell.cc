#include "analysis/shaft/shaft_campbell.h"

#include <algorithm>
#include <cmath>

#include "core/math/constants.h"
#include "rotor/shaft/state_modes.h"
#include "rotor/shaft/whirl_sweep.h"

namespace ambrig {

namespace {

/// The mode at this speed that is nearest to `like`, by pole and shape.
const ClosedLoopMode* Nearest(const ClosedLoopModes& row, const ClosedLoopMode& like) {
  const ClosedLoopMode* best = nullptr;
  double least = kInfinity;
  for (const ClosedLoopMode& m : row.modes) {
    const double shape = std::norm(m.q.dot(like.q)) / (m.q.squaredNorm() * like.q.squaredNorm());
    const double away = std::abs(m.s - like.s) / std::abs(like.s) + 0.2 * (1 - shape);
    if (away < least) least = away, best = &m;
  }
  return best;
}

}  // namespace

ClosedLoopModes RowOf(double speed, const WholeBeamModes& found) {
  ClosedLoopModes row;
  row.speed = speed;
  for (const WhirlMode& m : found.oscillatory) {
    ClosedLoopMode c;
    c.s = m.s;
    c.frequency = m.omega_d / (2 * kPi);
    c.zeta = m.zeta;
    c.log_decrement = m.log_decrement;
    c.rotor_share = 1;
    c.whirl = m.whirl;
    c.q = m.shape;
    row.modes.push_back(std::move(c));
  }
  return row;
}

Eigen::MatrixXd ShapesOfBeam(const BeamRotor& beam, double speed, int modes) {
  return ShapesOf(Assemble(beam, speed), 2 * modes + 10, SupportColumns(beam));
}

std::optional<DampedCritical> SolveCritical(const BeamRotor& beam, const Eigen::MatrixXd& shapes,
                                            int modes, const DampedCritical& start) {
  DampedCritical at = start;
  double before = kRequired, gap_before = kRequired;
  LinearRotor rotor;
  for (int k = 0; k < 12; ++k) {
    AssembleInto(beam, at.speed, rotor);
    std::vector<WhirlMode> one = {MakeWhirlMode(at.mode.s, at.mode.q)};
    const ClosedLoopModes row =
        RowOf(at.speed, ContinueModes(rotor, at.speed, one)
                            ? WholeBeamModes{one, {}}
                            : FindWhirlModes(rotor, shapes, at.speed, modes));
    const ClosedLoopMode* mode = Nearest(row, at.mode);
    if (!mode) return std::nullopt;
    at.mode = *mode;
    const double gap = mode->s.imag() - at.speed;
    if (std::abs(gap) < 1e-9 * at.speed) return at;
    // A frequency that hardly moves with the speed: the slope of Im s - Omega is -1.
    const double slope =
        std::isfinite(before) && at.speed != before ? (gap - gap_before) / (at.speed - before) : -1;
    before = at.speed;
    gap_before = gap;
    at.speed -= gap / (slope < -0.05 ? slope : -1);
    if (std::abs(at.speed - start.speed) > 0.3 * start.speed) return std::nullopt;
  }
  return at;
}

ShaftCampbell FollowShaft(const BeamRotor& beam, const Eigen::MatrixXd& shapes,
                          const std::vector<double>& speeds, int modes) {
  ShaftCampbell out;
  out.least_decay = kInfinity;
  WhirlSweep sweep(beam, shapes, modes);
  for (const double speed : speeds) {
    const WholeBeamModes found = sweep.At(speed);
    out.rows.push_back(RowOf(speed, found));
    out.real.push_back(found.real);
    for (const WhirlMode& m : found.oscillatory)
      out.least_decay = std::min(out.least_decay, -m.s.real() + 1e-9 * std::abs(m.s));
    for (const double s : found.real) out.least_decay = std::min(out.least_decay, -s);
  }
  out.tracks = FollowModes(out.rows);
  for (const DampedCritical& c : FindCriticals(out.tracks))
    out.criticals.push_back(SolveCritical(beam, shapes, modes, c).value_or(c));
  return out;
}

}  // namespace ambrig
