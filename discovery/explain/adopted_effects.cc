#include "discovery/explain/adopted_effects.h"

#include <algorithm>

#include "discovery/search/effect_round.h"
#include "discovery/shape/shape.h"

namespace ambrig {

namespace {

// Error over the noise that the free shape of one law leaves, below which no further effect is
// sought.
constexpr double kShapeExplains = 1.08;

}  // namespace

void AdoptedEffects::AddLastOf(const FitResult& fit) {
  all_.push_back(FittedEffect(fit, fit.hypothesis.rig.effects.size() - 1));
}

void AdoptedEffects::Take(const FitResult& fit, std::size_t count) {
  all_.clear();
  for (std::size_t k = 0; k < count; ++k) all_.push_back(FittedEffect(fit, PlaceOf(k)));
}

void AdoptedEffects::Remove(std::size_t k) {
  all_.erase(all_.begin() + static_cast<std::ptrdiff_t>(k));
}

void AdoptedEffects::NoteOwnChannels(const EffectInstance& e) {
  of_own_channels_.push_back(Named(e));
}

bool AdoptedEffects::IsOfOwnChannels(const EffectInstance& e) const {
  return std::ranges::count(of_own_channels_, Named(e)) > 0;
}

void AdoptedEffects::NoteBesideShape(const EffectInstance& e) { beside_shape_.push_back(Named(e)); }

bool AdoptedEffects::IsBesideShape(const EffectInstance& e) const {
  return std::ranges::count(beside_shape_, Named(e)) > 0;
}

void AdoptedEffects::NoteSizeless(const EffectInstance& e) { sizeless_.push_back(Named(e)); }

bool AdoptedEffects::IsSizeless(const EffectInstance& e) const {
  return std::ranges::count(sizeless_, Named(e)) > 0;
}

bool AdoptedEffects::ShapeExplainsAll() const {
  return size() == 1 && shaped && shaped->Answered() < kShapeExplains;
}

bool AdoptedEffects::HoldMagnetisationOf(const EffectInstance& e) const {
  return std::ranges::any_of(all_, [&](const EffectInstance& a) {
    return a.target == e.target && ShareMagnetisation(a.name, e.name);
  });
}

}  // namespace ambrig
