/// Templates of stators: a few numbers expand to poles. Angles of poles are evenly spaced.
#include <cmath>

#include "actuators/magnetics/stator_parameters.h"
#include "core/base/errors.h"

namespace ambrig {

namespace {

/// Winding sense of pole k: letters are repeated, without any they alternate.
double SenseOf(const StatorParameters& p, int k) {
  const std::string letters = p.winding.empty() ? "NS" : p.winding;
  return letters[static_cast<std::size_t>(k) % letters.size()] == 'N' ? 1 : -1;
}

bool Joined(const StatorParameters& p, const char* word, bool first = false) {
  return p.connection.empty() ? first : p.connection == word;
}

int CountOf(const StatorParameters& p, int fallback) {
  return p.pole_count > 0 ? static_cast<int>(p.pole_count) : fallback;
}

StatorPole PoleAt(const StatorParameters& p, int k, int count, double first) {
  StatorPole pole;
  const double from = std::isnan(p.first_pole_angle_deg) ? first : p.first_pole_angle_deg;
  pole.angle_deg = from + 360.0 * k / count;
  pole.area = p.pole_area;
  pole.gap = p.gap;
  pole.cone_deg = p.cone_deg;
  return pole;
}

/// 0: +x, 1: +y, 2: -x, 3: -y.
int QuadrantOf(double angle_deg) {
  return static_cast<int>(std::floor(angle_deg / 90 + 0.5 + 8)) % 4;
}

/// Poles all round, alternately wound; `coil(k, angle)` carries pole k.
template <typename CoilOfPole>
std::vector<StatorPole> PolesRound(const StatorParameters& p, int fallback, CoilOfPole coil) {
  std::vector<StatorPole> poles;
  const int count = CountOf(p, fallback);
  for (int k = 0; k < count; ++k) {
    StatorPole pole = PoleAt(p, k, count, 180.0 / count);
    pole.turns[coil(k, pole.angle_deg)] = SenseOf(p, k) * p.turns;
    poles.push_back(pole);
  }
  return poles;
}

std::vector<StatorPole> SeriesPairs(const StatorParameters& p) {
  return PolesRound(p, 8, [](int, double angle_deg) { return QuadrantOf(angle_deg); });
}

std::vector<StatorPole> OneCoilPerPole(const StatorParameters& p) {
  return PolesRound(p, 6, [](int k, double) { return k; });
}

/// Two planes; more current of a coil of one pole strengthens its bias.
std::vector<StatorPole> HomopolarMagnet(const StatorParameters& p) {
  std::vector<StatorPole> poles;
  const int count = CountOf(p, 4);
  for (int plane = 0; plane < 2; ++plane)
    for (int k = 0; k < count; ++k) {
      StatorPole pole = PoleAt(p, k, count, 0);
      pole.plane = plane + 1;
      const double with_bias = plane == 0 ? 1 : -1, axis = k < count / 2 ? 1 : -1;
      if (Joined(p, "pole"))
        pole.turns[plane * count + k] = with_bias * p.turns;
      else if (Joined(p, "axis"))
        pole.turns[k % 2] = with_bias * axis * p.turns;
      else
        pole.turns[plane * (count / 2) + k % (count / 2)] = with_bias * axis * p.turns;
      poles.push_back(pole);
    }
  return poles;
}

/// A magnet in every pole, of the polarity of its winding.
std::vector<StatorPole> HeteropolarMagnet(const StatorParameters& p) {
  std::vector<StatorPole> poles;
  const int count = CountOf(p, 8);
  for (int k = 0; k < count; ++k) {
    StatorPole pole = PoleAt(p, k, count, 180.0 / count);
    const double sense = SenseOf(p, k);
    const int quadrant = QuadrantOf(pole.angle_deg);
    pole.magnet = p.bias;
    pole.magnet->mmf *= sense;
    if (Joined(p, "axis"))
      pole.turns[quadrant % 2] = sense * (quadrant < 2 ? 1 : -1) * p.turns;
    else
      pole.turns[quadrant] = sense * p.turns;
    poles.push_back(pole);
  }
  return poles;
}

/// Four cores of three poles: the middle one wound and of twice the area, the outer ones 30 degrees
/// beside it.
std::vector<StatorPole> ECores(const StatorParameters& p) {
  std::vector<StatorPole> poles;
  for (int core = 0; core < 4; ++core)
    for (int leg = -1; leg <= 1; ++leg) {
      StatorPole pole = PoleAt(p, core, 4, 0);
      pole.angle_deg += 30.0 * leg;
      if (leg == 0) {
        pole.area = 2 * p.pole_area;
        pole.turns[core] = SenseOf(p, core) * p.turns;
      }
      poles.push_back(pole);
    }
  return poles;
}

/// A core on each side of the disk, its coil round the inner one of two faces of equal area.
std::vector<StatorPole> AxialPair(const StatorParameters& p) {
  std::vector<StatorPole> poles;
  for (int side = 0; side < 2; ++side)
    for (int face = 0; face < 2; ++face) {
      StatorPole pole = PoleAt(p, 0, 1, 0);
      pole.side = side == 0 ? 1 : -1;
      pole.plane = side + 1;
      if (face == 0) {
        pole.turns[Joined(p, "two-a-side") ? 2 * side : side] = p.turns;
        if (Joined(p, "two-a-side")) pole.turns[2 * side + 1] = p.turns;
      }
      poles.push_back(pole);
    }
  return poles;
}

/// One core with a face on each side of the disk; the magnet's flux comes back beside them.
std::vector<StatorPole> AxialMagnet(const StatorParameters& p) {
  std::vector<StatorPole> poles;
  for (int side = 0; side < 2; ++side) {
    StatorPole pole = PoleAt(p, 0, 1, 0);
    pole.side = side == 0 ? 1 : -1;
    if (Joined(p, "side"))
      pole.turns[side] = p.turns;
    else
      pole.turns[0] = (side == 0 ? 1 : -1) * p.turns;
    poles.push_back(pole);
  }
  return poles;
}

}  // namespace

const std::vector<StatorTemplate>& StatorTemplates() {
  static const std::vector<StatorTemplate> all = {
      {"series-pairs", "four coils, each the poles of a quadrant in series", false, 8, 4, 32, 4, "",
       false, SeriesPairs},
      {"one-coil-per-pole", "a coil on each pole, all independent", false, 6, 3, 8, 1, "", false,
       OneCoilPerPole},
      {"homopolar-pm", "two planes with a magnet between them", false, 4, 4, 4, 4, "pair,axis,pole",
       true, HomopolarMagnet},
      {"heteropolar-pm", "one plane with a magnet in every pole", false, 8, 4, 32, 4,
       "quadrant,axis", true, HeteropolarMagnet},
      {"e-core", "four cores of three poles, the middle one wound", false, 0, 12, 12, 12, "", false,
       ECores},
      {"conical", "series-pairs on a cone", false, 8, 4, 32, 4, "", false, SeriesPairs},
      {"axial", "a core on each side of a disk", true, 0, 4, 4, 4, "one-a-side,two-a-side", false,
       AxialPair},
      {"axial-pm", "a face on each side of a disk, biased by a magnet", true, 0, 2, 2, 2,
       "series,side", true, AxialMagnet},
  };
  return all;
}

const StatorTemplate* FindStatorTemplate(const std::string& name) {
  for (const StatorTemplate& t : StatorTemplates())
    if (name == t.name) return &t;
  return nullptr;
}

}  // namespace ambrig
