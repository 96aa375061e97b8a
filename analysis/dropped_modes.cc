#include "analysis/dropped_modes.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "core/math/constants.h"
#include "rig/parameters/bearing_kind.h"
#include "rotor/shaft/reduction.h"

namespace ambrig {

namespace {

constexpr std::size_t kDroppedShown = 4;

/// What residual modes give way at the frequency w.
double ResidualCompliance(const RigParameters& rig, int kept, double w,
                          const BearingParameters& b) {
  double sum = 0;
  for (std::size_t k = static_cast<std::size_t>(kept); k < rig.modes.size(); ++k) {
    const BendingMode& m = rig.modes[k];
    sum += m.Gain(b.z) * m.Gain(b.sensor.z) / (m.omega * m.omega - w * w);
  }
  return sum;
}

LostCompliance LostAt(const ReducedRotor& all, int kept, double top, double magnet, double sensor) {
  const Eigen::VectorXd at = StationAt(all, magnet).phi, read = StationAt(all, sensor).phi;
  LostCompliance out;
  for (int k = 0; k < all.modes(); ++k) {
    const double w2 =
        all.omega[static_cast<std::size_t>(k)] * all.omega[static_cast<std::size_t>(k)];
    const double gain = at(k) * read(k);
    (k < kept ? out.kept : out.lost) += gain / w2;
    if (k >= kept) out.lost_at_top += gain / (w2 - top * top);
  }
  return out;
}

}  // namespace

std::optional<DroppedModes> FindDroppedModes(const RigParameters& rig) {
  if (!rig.beam) return std::nullopt;
  const BeamRotor beam = BuildBeam(rig.beam->definition);
  const ReducedRotor all = Reduce(beam, static_cast<int>(beam.M.rows()), {0.0});
  DroppedModes out;
  out.kept = std::min(static_cast<int>(rig.modes.size()), rig.beam->modes);
  out.dropped = all.modes() - out.kept;
  out.top = out.kept == 0 ? 0 : rig.modes[static_cast<std::size_t>(out.kept) - 1].omega / (2 * kPi);
  for (std::size_t k = static_cast<std::size_t>(out.kept); k < rig.modes.size(); ++k)
    out.residual.push_back(rig.modes[k].omega / (2 * kPi));
  for (int k = out.kept; k < all.modes() && out.frequency.size() < kDroppedShown; ++k)
    out.frequency.push_back(all.omega[static_cast<std::size_t>(k)] / (2 * kPi));
  for (const BearingParameters& b : rig.bearings) {
    if (!b.kind->two_axes) continue;
    out.bearings.push_back(
        LostAt(all, out.kept, 2 * kPi * out.top, b.z + rig.z_origin, b.sensor.z + rig.z_origin));
    LostCompliance& last = out.bearings.back();
    last.bearing = b.name;
    const double carried = ResidualCompliance(rig, out.kept, 0, b);
    last.kept += carried;
    last.lost -= carried;
    last.lost_at_top -= ResidualCompliance(rig, out.kept, 2 * kPi * out.top, b);
  }
  return out;
}

std::string DroppedModesText(const DroppedModes& m) {
  if (m.dropped == 0) return fmt::format("all {} bending modes of the beam are kept", m.kept);
  std::string text =
      fmt::format("{} of {} bending modes are kept, up to {:.0f} Hz; dropped from {:.0f} Hz on",
                  m.kept, m.kept + m.dropped, m.top, m.frequency.front());
  const auto micrometres = [](double c) { return c * 1e9; };  // per kN
  if (!m.residual.empty()) {
    text += fmt::format("; residual modes at {:.0f} Hz carry the static compliance of the dropped",
                        fmt::join(m.residual, ", "));
    for (const LostCompliance& b : m.bearings)
      if (m.top > 0)
        text += fmt::format("; at {:.0f} Hz {:.3g} um/kN are missing at {}", m.top,
                            micrometres(b.lost_at_top), b.bearing);
    return text;
  }
  for (const LostCompliance& b : m.bearings) {
    text += fmt::format("; they would give way by {:.3g} um/kN at {} ({:.2g} % of the bending)",
                        micrometres(b.lost), b.bearing,
                        100 * std::abs(b.lost) / std::max(std::abs(b.kept + b.lost), 1e-300));
    if (m.top > 0) text += fmt::format(", {:.3g} at {:.0f} Hz", micrometres(b.lost_at_top), m.top);
  }
  return text;
}

}  // namespace ambrig
