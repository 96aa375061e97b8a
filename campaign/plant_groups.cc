#include "campaign/plant_groups.h"

#include <algorithm>
#include <cmath>

namespace ambrig {

namespace {

constexpr double kHarmedOrbit = 1.1;  // times that without fault tolerance

int Rank(const std::string& verdict) {
  return verdict == "up" ? 0 : verdict == "touchdown" ? 1 : 2;
}

bool Harmed(const Row& r) {
  const std::string without = r.At("verdict_without");
  if (without.empty()) return false;
  const int with = Rank(r.At("verdict"));
  const bool grown = r.Number("peak_orbit") > kHarmedOrbit * r.Number("orbit_without");
  if (without == "up") return with > 0 || grown;
  // A rotor that bounces either way: whether the run ends in a contact, and then counts as a drop,
  // is chance.
  return with > Rank(without) && (grown || r.Number("false_actions") > 0);
}

void AddFault(const Row& r, FaultsOnPlants* f) {
  f->blamed += r.Number("false_actions") > 0;
  f->lost += r.At("verdict") != "up";
  f->lost_alone += !r.At("verdict_without").empty() && r.At("verdict_without") != "up";
  if (r.Number("judged") == 0) return;  // the rotor was lost before the fault came
  ++f->runs;
  const bool found = r.Number("detected") >= r.Number("judged");
  f->found += found;
  if (found && !r.At("detection_delay").empty()) f->delay.push_back(r.Number("detection_delay"));
}

}  // namespace

double FaultsOnPlants::Delay(double share) const {
  if (delay.empty()) return kRequired;
  std::vector<double> v = delay;
  std::sort(v.begin(), v.end());
  return v[static_cast<std::size_t>(std::ceil(share * static_cast<double>(v.size() - 1)))];
}

std::size_t FaultsOnPlants::FoundWithin(double most) const {
  return static_cast<std::size_t>(
      std::ranges::count_if(delay, [&](double d) { return d <= most; }));
}

void PlantGroup::Add(const Row& r) {
  if (r.Number("failed") > 0) {
    AddFault(r, &kinds[r.At("kind")]);
    return;
  }
  const std::string plant = r.At("plant") + " " + r.At("spread");
  plants.insert(plant);
  coil_periods += r.Number("coil_periods");
  if (!r.At("doubtful_share").empty())
    doubtful_periods += r.Number("doubtful_share") * r.Number("coil_periods");
  if (r.Number("false_alarms") > 0) alarmed.insert(plant);
  if (r.Number("false_actions") > 0) acted.insert(plant);
  if (Harmed(r)) harmed.insert(plant);
  if (r.At("doubtful") == "yes") doubtful.insert(plant);
  if (r.At("verdict") != "up" || r.At("verdict_without") != "up") return;
  const double with = r.Number("peak_orbit"), without = r.Number("orbit_without");
  if (orbit == 0 || with * orbit_without > orbit * without) {
    orbit = with;
    orbit_without = without;
  }
}

void PlantGroup::Add(const PlantGroup& other, const std::string& prefix) {
  for (const auto& [of, set] : {std::pair{&other.plants, &plants},
                                {&other.alarmed, &alarmed},
                                {&other.acted, &acted},
                                {&other.harmed, &harmed},
                                {&other.doubtful, &doubtful}})
    for (const std::string& p : *of) set->insert(prefix + p);
  coil_periods += other.coil_periods;
  doubtful_periods += other.doubtful_periods;
  if (orbit == 0 || other.orbit * orbit_without > orbit * other.orbit_without) {
    orbit = other.orbit;
    orbit_without = other.orbit_without;
  }
  for (const auto& [kind, f] : other.kinds) {
    FaultsOnPlants& sum = kinds[kind];
    sum.runs += f.runs;
    sum.found += f.found;
    sum.blamed += f.blamed;
    sum.lost += f.lost;
    sum.lost_alone += f.lost_alone;
    sum.delay.insert(sum.delay.end(), f.delay.begin(), f.delay.end());
  }
}

double UpperBound95(std::size_t hits, std::size_t trials) {
  if (trials == 0 || hits >= trials) return 1;
  const auto n = static_cast<double>(trials);
  // P(at most `hits` of n) = 5 %, by bisection over p.
  const auto at_most = [&](double p) {
    double sum = 0;
    for (std::size_t k = 0; k <= hits; ++k) {
      const auto m = static_cast<double>(k);
      sum += std::exp(std::lgamma(n + 1) - std::lgamma(m + 1) - std::lgamma(n - m + 1) +
                      m * std::log(p) + (n - m) * std::log1p(-p));
    }
    return sum;
  };
  double lo = 1e-12, hi = 1 - 1e-12;
  for (int k = 0; k < 60; ++k) {
    const double p = 0.5 * (lo + hi);
    (at_most(p) > 0.05 ? lo : hi) = p;
  }
  return hi;
}

}  // namespace ambrig
