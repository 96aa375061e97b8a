#include "campaign/plants.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "campaign/parameter_draw.h"
#include "core/base/toml_checked.h"
#include "core/math/copper.h"
#include "core/math/normal_distribution.h"
#include "effects/catalogue.h"
#include "rig/parameters/bearing_kind.h"
#include "rig/rig_figures.h"
#include "rig/true_rig.h"

namespace ambrig {

namespace {

constexpr long long kMostMixtures = 100000;
constexpr int kMostShown = 2;  // parameters of an effect in a table
constexpr Range kWarmer{"K", -100, 200, "copper, since the commissioning"};
constexpr Range kSensorDrift{"m", 0, 1e-3,
                             "zeros of the position sensors, since the commissioning"};

/// Numbers that depend on the seed and on their order only.
class Draw {
 public:
  explicit Draw(std::uint64_t seed) : state_(Mixed(seed)) {}
  double Uniform() {
    state_ = Mixed(state_);
    return (static_cast<double>(state_ >> 11) + 0.5) * 0x1p-53;
  }
  std::size_t Index(std::size_t n) {
    return std::min(n - 1, static_cast<std::size_t>(Uniform() * static_cast<double>(n)));
  }

 private:
  std::uint64_t state_;
};

/// Whether plants have it: what has no usual range stays out.
bool IsDrawn(const EffectDescription& d, const EffectParameter& p) {
  return d.Switches(p) && p.typical_lo > 0 && p.typical_hi > 0;
}

/// `size`: 0 the weak end of the usual range, 1 the strong one.
double ValueOf(const EffectParameter& p, double size, bool negative) {
  const bool falls = std::isinf(p.null_value);  // the smaller the stronger
  const double weak = falls ? p.typical_hi : p.typical_lo,
               strong = falls ? p.typical_lo : p.typical_hi;
  const double distance = weak * std::pow(strong / weak, size);
  if (falls) return distance;
  const double signed_distance = negative && p.lo <= p.null_value - distance ? -distance : distance;
  return std::clamp(p.null_value + signed_distance, p.lo, p.hi);
}

/// Where the effects of the plants act.
struct Ground {
  const RigParameters& rig;
  std::vector<std::string> bearings;  // by name; empty: all radial ones
};

/// Whether the target is the bearing, its plane, or an axis or a coil of it.
bool IsOf(const BearingParameters& b, const std::string& target) {
  const std::vector<std::string> axes = b.Axes();
  return target == b.name || target.starts_with(b.name + ".") ||
         std::count(axes.begin(), axes.end(), target) > 0;
}

std::vector<std::string> TargetsIn(const EffectDescription& d, const Ground& at, Draw& draw) {
  const std::vector<std::string> all = TargetsOf(d, TargetsOfEffects(at.rig));
  std::vector<std::string> whole, own;  // bearings; what belongs to those that are named
  for (const BearingParameters& b : at.rig.bearings) {
    const bool named = std::count(at.bearings.begin(), at.bearings.end(), b.name) > 0;
    if (!(at.bearings.empty() ? b.kind->two_axes : named)) continue;
    if (std::count(all.begin(), all.end(), b.name) > 0) whole.push_back(b.name);
    if (named)
      std::ranges::copy_if(all, std::back_inserter(own),
                           [&](const std::string& target) { return IsOf(b, target); });
  }
  if (!whole.empty() && d.target != TargetKind::kPlane && d.target != TargetKind::kPlaneOrZ &&
      d.target != TargetKind::kPlaneOrRig)
    return whole;
  if (std::count(all.begin(), all.end(), "rig") > 0) return {"rig"};
  const std::vector<std::string>& some = own.empty() ? all : own;
  if (some.empty()) return {};
  return {some[draw.Index(some.size())]};
}

void AddPlant(const EffectDescription& d, const Ground& at, double size, Draw& draw,
              CampaignPlant* plant) {
  for (const std::string& target : TargetsIn(d, at, draw)) {
    EffectInstance e = MakeInstance(d, target);
    for (std::size_t k = 0; k < e.table.size(); ++k)
      if (IsDrawn(d, e.table[k])) e.values[k] = ValueOf(e.table[k], size, draw.Uniform() < 0.5);
    plant->effects.push_back(std::move(e));
  }
}

Ground GroundOf(const TomlTable& t, const RigParameters& rig) {
  Ground at{rig, t.Has("bearings") ? t.Strings("bearings") : std::vector<std::string>{}};
  std::vector<std::string> known;
  for (const BearingParameters& b : rig.bearings) known.push_back(b.name);
  if (t.Has("bearings") && at.bearings.empty())
    t.Fail("bearings", fmt::format("= [], allowed: some of {}", fmt::join(known, ", ")));
  for (const std::string& name : at.bearings)
    if (std::count(known.begin(), known.end(), name) == 0)
      t.Fail("bearings",
             fmt::format("= \"{}\", allowed: some of {}", name, fmt::join(known, ", ")));
  return at;
}

std::vector<const EffectDescription*> EffectsOf(const TomlTable& t, const RigParameters& rig) {
  std::vector<const EffectDescription*> out;
  std::vector<std::string> known;
  for (const EffectDescription& d : Catalogue())
    if (!d.users_own && !TargetsOf(d, TargetsOfEffects(rig)).empty()) known.push_back(d.id);
  for (const std::string& id : t.Has("effects") ? t.Strings("effects") : known) {
    if (std::count(known.begin(), known.end(), id) == 0)
      t.Fail("effects", fmt::format("= \"{}\", allowed: {}", id, fmt::join(known, ", ")));
    out.push_back(FindEffect(id));
  }
  return out;
}

std::vector<std::string> SizesOf(const TomlTable& t) {
  const std::vector<std::string> sizes =
      t.Has("sizes") ? t.Strings("sizes") : std::vector<std::string>{"low", "typical", "high"};
  for (const std::string& s : sizes)
    if (s != "low" && s != "typical" && s != "high")
      t.Fail("sizes", fmt::format("= \"{}\", allowed: low, typical, high", s));
  return sizes;
}

double Share(const std::string& size) { return size == "low" ? 0 : size == "high" ? 1 : 0.5; }

/// Machines by their effects alone; the first has none.
std::vector<CampaignPlant> Machines(const TomlTable& t, const Ground& at, std::uint64_t seed) {
  const auto effects = EffectsOf(t, at.rig);
  std::vector<CampaignPlant> out(1);
  out[0].label = out[0].effect = "none";
  for (const EffectDescription* d : effects)
    for (const std::string& size : SizesOf(t)) {
      CampaignPlant p;
      p.effect = d->id;
      p.size = size;
      p.label = d->id + " " + size;
      Draw draw(seed * 7919 + out.size());
      AddPlant(*d, at, Share(size), draw, &p);
      out.push_back(std::move(p));
    }
  const long long mixtures = t.Integer("mixtures", 0);
  if (mixtures < 0 || mixtures > kMostMixtures)
    t.Fail("mixtures", fmt::format("= {}, allowed: 0 to {}", mixtures, kMostMixtures));
  const std::vector<double> of = t.Numbers("mixture_of", {3, 6});
  if (of.size() != 2 || of[0] < 1 || of[1] < of[0] ||
      (mixtures > 0 && of[1] > static_cast<double>(effects.size())))
    t.Fail("mixture_of", fmt::format("allowed: [least, most], from 1 to {}", effects.size()));
  for (long long k = 0; k < mixtures; ++k) {
    Draw draw(seed * 104729 + static_cast<std::uint64_t>(k) + 1);
    std::vector<const EffectDescription*> left = effects;
    const auto n =
        static_cast<std::size_t>(of[0]) + draw.Index(static_cast<std::size_t>(of[1] - of[0]) + 1);
    CampaignPlant p;
    p.effect = "mixture";
    p.label = fmt::format("{}: ", k + 1);
    for (std::size_t m = 0; m < n; ++m) {
      const std::size_t which = draw.Index(left.size());
      p.label += (m > 0 ? "+" : "") + left[which]->id;
      AddPlant(*left[which], at, draw.Uniform(), draw, &p);
      left.erase(left.begin() + static_cast<std::ptrdiff_t>(which));
    }
    out.push_back(std::move(p));
  }
  return out;
}

/// A zero of every sensor of a levitated axis that has moved by `distance` [m], up or down.
std::vector<EffectInstance> DriftOf(const RigParameters& rig, double distance, Draw draw) {
  std::vector<EffectInstance> out;
  if (distance == 0) return out;
  for (const std::string& axis : AxisNames(rig)) {
    out.push_back(MakeInstance(EffectNamed("sensor-offset"), axis));
    out.back().Set("offset", draw.Uniform() < 0.5 ? -distance : distance);
  }
  return out;
}

std::vector<bool> CommissionedOf(const TomlTable& t) {
  const std::string which = t.Choice("commissioned", "both", "both, yes, no");
  if (which == "both") return {false, true};
  return {which == "yes"};
}

}  // namespace

std::vector<CampaignPlant> ReadPlants(const TomlTable& t, const RigParameters& rig) {
  const long long seed = t.Integer("seed", 1);
  if (seed < 0) t.Fail("seed", fmt::format("= {}, allowed: 0 or more", seed));
  const std::vector<double> scales =
      t.IsNumber("scale") ? std::vector<double>{t.Number("scale")} : t.Numbers("scale", {1.0});
  for (const double s : scales)
    if (!(s >= 0 && s <= 10)) t.Fail("scale", fmt::format("= {}, allowed: 0 to 10 sd", s));
  if (scales.empty()) t.Fail("scale", "= [], allowed: at least one number from 0 to 10 sd");
  const std::vector<bool> commissioned = CommissionedOf(t);
  const double warmer = Within(t, "warmer", 0, kWarmer),
               drift = Within(t, "sensor_drift", 0, kSensorDrift);
  const auto start = static_cast<std::uint64_t>(seed);
  std::vector<CampaignPlant> out;
  for (const CampaignPlant& machine : Machines(t, GroundOf(t, rig), start))
    for (const double scale : scales) {
      CampaignPlant p = machine;
      p.scale = scale;
      p.unit = static_cast<double>(out.size() + 1);
      p.warmer = warmer;
      p.drift = DriftOf(rig, drift, Draw(start * 32452843 + out.size()));
      Draw draw(start * 15485863 + out.size());
      for (const Tolerance& tolerance : rig.tolerances)
        if (tolerance.sd > 0) p.deviates.push_back(scale * NormalQuantile(draw.Uniform()));
      for (const bool learnt : commissioned) {
        p.commissioned = learnt;
        out.push_back(p);
      }
    }
  t.RejectUnknownKeys();
  return out;
}

std::string EffectSizeText(const std::string& effect, const std::string& size) {
  const EffectDescription* d = FindEffect(effect);
  if (!d) return "";
  const EffectInstance e = MakeInstance(*d, "");
  std::string text;
  int shown = 0;
  for (const EffectParameter& p : e.table) {
    if (!IsDrawn(*d, p)) continue;
    if (++shown > kMostShown) return text + ", ...";
    const double rounded = std::stod(fmt::format("{:.3g}", ValueOf(p, Share(size), false)));
    text += fmt::format("{}{} {:g}{}{}", text.empty() ? "" : ", ", p.name, rounded,
                        p.unit == "-" ? "" : " ", p.unit == "-" ? "" : p.unit);
  }
  return text;
}

void DrawTolerances(const std::vector<double>& deviates, RigParameters* rig) {
  std::size_t k = 0;
  for (Tolerance& t : rig->tolerances) {
    if (!(t.sd > 0) || deviates.empty()) continue;
    const double* value = ParameterAt(*rig, t.path);
    double lo = 0, hi = 0;
    std::string unit;
    const bool ranged = ParameterRange(*rig, t.path, &lo, &hi, &unit);
    const double z = deviates[k++];
    if (!value) continue;
    const double drawn = (std::isnan(t.true_value) ? *value : t.true_value) + t.sd * z;
    t.true_value = ranged ? std::clamp(drawn, lo, hi) : drawn;
  }
}

void ApplyPlant(const CampaignPlant& plant, RigParameters* rig) {
  rig->effects.insert(rig->effects.end(), plant.effects.begin(), plant.effects.end());
  DrawTolerances(plant.deviates, rig);
  rig->amplifier.unit = plant.unit;
}

void AgePlant(const CampaignPlant& plant, RigParameters* rig) {
  rig->effects.insert(rig->effects.end(), plant.drift.begin(), plant.drift.end());
  if (plant.warmer == 0) return;
  for (const BearingParameters& b : rig->bearings) {
    const std::string path = "bearings." + b.name + ".resistance";
    if (std::ranges::count(rig->tolerances, path, &Tolerance::path) == 0)
      rig->tolerances.push_back({path, 0, kRequired});
    Tolerance& t = *std::ranges::find(rig->tolerances, path, &Tolerance::path);
    const double before = std::isnan(t.true_value) ? *ParameterAt(*rig, path) : t.true_value;
    t.true_value = before * (1 + kCopperPerKelvin * plant.warmer);
  }
}

}  // namespace ambrig
