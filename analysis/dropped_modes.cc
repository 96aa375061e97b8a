#include "analysis/dropped_modes.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "core/math/constants.h"
#include "rig/bearing_kinds/bearing_kind.h"
#include "rotor/shaft/reduction.h"

namespace ambrig {

namespace {

constexpr std::size_t kDroppedShown = 4;

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
  out.kept = static_cast<int>(rig.modes.size());
  out.dropped = all.modes() - out.kept;
  out.top = rig.modes.empty() ? 0 : rig.modes.back().omega / (2 * kPi);
  for (int k = out.kept; k < all.modes() && out.frequency.size() < kDroppedShown; ++k)
    out.frequency.push_back(all.omega[static_cast<std::size_t>(k)] / (2 * kPi));
  for (const BearingParameters& b : rig.bearings) {
    if (!b.kind->two_axes) continue;
    out.bearings.push_back(
        LostAt(all, out.kept, 2 * kPi * out.top, b.z + rig.z_origin, b.sensor.z + rig.z_origin));
    out.bearings.back().bearing = b.name;
  }
  return out;
}

std::string DroppedModesText(const DroppedModes& m) {
  if (m.dropped == 0) return fmt::format("all {} bending modes of the beam are kept", m.kept);
  std::string text =
      fmt::format("{} of {} bending modes are kept, up to {:.0f} Hz; dropped from {:.0f} Hz on",
                  m.kept, m.kept + m.dropped, m.top, m.frequency.front());
  const auto micrometres = [](double c) { return c * 1e9; };  // per kN
  for (const LostCompliance& b : m.bearings) {
    text += fmt::format("; they would give way by {:.3g} um/kN at {} ({:.2g} % of the bending)",
                        micrometres(b.lost), b.bearing,
                        100 * std::abs(b.lost) / std::max(std::abs(b.kept + b.lost), 1e-300));
    if (m.top > 0) text += fmt::format(", {:.3g} at {:.0f} Hz", micrometres(b.lost_at_top), m.top);
  }
  return text;
}

}  // namespace ambrig
