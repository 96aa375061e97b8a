#pragma once
/// The effects that a search has adopted so far. Owns them with their fitted values, and how each
/// was found where that decides what may become of it later.
#include <optional>
#include <string>
#include <vector>

#include "discovery/search/fit.h"
#include "discovery/search/stage_ratios.h"

namespace ambrig {

class AdoptedEffects {
 public:
  /// `of_rig`: number of the rig file's own effects, which stand in front of these in every
  /// hypothesis.
  explicit AdoptedEffects(std::size_t of_rig) : of_rig_(of_rig) {}

  const std::vector<EffectInstance>& all() const { return all_; }
  std::size_t size() const { return all_.size(); }
  bool empty() const { return all_.empty(); }
  const EffectInstance& operator[](std::size_t k) const { return all_[k]; }
  /// Number of effect `k` among the effects of a hypothesis.
  std::size_t PlaceOf(std::size_t k) const { return of_rig_ + k; }

  /// How many effects a fit has beside the rig file's own.
  std::size_t In(const FitResult& fit) const { return fit.hypothesis.rig.effects.size() - of_rig_; }

  /// The last effect of this fit, behind those adopted before.
  void AddLastOf(const FitResult& fit);
  /// The first `count` of a fit in place of all.
  void Take(const FitResult& fit, std::size_t count);
  /// The same number as before, which the fit holds with other values or names.
  void Renew(const FitResult& fit) { Take(fit, size()); }
  void Remove(std::size_t k);
  void Clear() { all_.clear(); }

  /// An effect that was adopted for what it explains where it acts.
  void NoteOwnChannels(const EffectInstance& e);
  bool IsOfOwnChannels(const EffectInstance& e) const;
  bool AnyOfOwnChannels() const { return !of_own_channels_.empty(); }
  /// An effect that was found beside the free shape of another one's law: beside the plain laws it
  /// explains less than it does.
  void NoteBesideShape(const EffectInstance& e);
  bool IsBesideShape(const EffectInstance& e) const;

  /// An effect whose last fit left it without a size: it is not tried again beside the others.
  void NoteSizeless(const EffectInstance& e);
  bool IsSizeless(const EffectInstance& e) const;

  /// Whether one of them is a law of the same magnetisation curve as `e` would be: a second one
  /// adds a detail of its shape.
  bool HoldMagnetisationOf(const EffectInstance& e) const;

  /// What the law of the first effect leaves in a free shape (discovery/shape/shape_names.h), where
  /// that was tried.
  std::optional<StageRatios> shaped;
  /// One effect was adopted whose law in a free shape leaves the noise: what the catalogue's law
  /// leaves is its own.
  bool ShapeExplainsAll() const;
  /// How far the first effect, or undeclared nuisances, brought the squared ratio of unseen records
  /// down [-].
  double first_fall = 0;

 private:
  std::size_t of_rig_;
  std::vector<EffectInstance> all_;
  std::vector<std::string> of_own_channels_, beside_shape_, sizeless_;  // names with targets
};

}  // namespace ambrig
