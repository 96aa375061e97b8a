#pragma once
/// What a plane ("A", "z") or axis ("A.x", "z") target means, and the order of the maps on a
/// sensor.
#include <cmath>
#include <memory>
#include <string>
#include <utility>

#include "effects/effect.h"
#include "effects/plant.h"

namespace ambrig {

/// The bearing of a plane or axis; "z" is the thrust bearing.
BearingPlant& TargetPlane(const EffectInstance& effect, Plant& plant);
/// Where a force at the target plane acts: a bearing's plane, or a disk or station of a beam rotor.
PlaneMap TargetForcePlane(const EffectInstance& effect, Plant& plant);
/// Side of the sensor that an axis target names: 0 for "A.x" and "z", 1 for "A.y".
int TargetSide(const EffectInstance& effect);
/// The auxiliary bearing at the target plane. @throws InputError when the rig has none there.
std::size_t TargetAuxiliary(const EffectInstance& effect, const Plant& plant);

struct Turned {
  double x, y;
};

/// Turns points that are fixed to the rotor. Cosine and sine of the last angle are kept: the stages
/// of a step and the planes of a shaft share theirs.
class Turning {
 public:
  /// The point at (c, s) for theta = 0, seen by the stator at `angle` = order times theta [rad].
  Turned At(double c, double s, double angle) {
    if (angle != angle_) {
      angle_ = angle;
      cosine_ = std::cos(angle);
      sine_ = std::sin(angle);
    }
    return {c * cosine_ - s * sine_, c * sine_ + s * cosine_};
  }

 private:
  double angle_ = 0, cosine_ = 1, sine_ = 0;
};

/// Readings pass the maps in this order, whatever the order in the rig file:
///   surface -> sensor axes -> gain -> offset -> electronics -> what cables pick up -> formulas
enum class ReadingStage { kSurface, kAxes, kGain, kOffset, kElectronics, kPickUp, kFormula };

/// A reading map that knows its place.
class StagedMap : public ReadingMap {
 public:
  explicit StagedMap(ReadingStage stage) : stage_(stage) {}
  ReadingStage stage() const { return stage_; }
  bool signal() const final {
    return stage_ == ReadingStage::kSurface || stage_ == ReadingStage::kPickUp;
  }

 private:
  ReadingStage stage_;
};

void InsertMap(PositionSensor& sensor, std::unique_ptr<StagedMap> map);

/// Wraps a function (state, x*, y*) as the map of one stage; a lag has a member `tau` [s].
template <class F>
void AddMap(PositionSensor& sensor, ReadingStage stage, F f) {
  struct Wrapped final : StagedMap {
    Wrapped(ReadingStage s, F function) : StagedMap(s), f(std::move(function)) {}
    void Map(const MotionState& state, double* x, double* y) override { f(state, x, y); }
    double lag() const override {
      if constexpr (requires { f.tau; })
        return f.tau;
      else
        return 0;
    }
    F f;
  };
  InsertMap(sensor, std::make_unique<Wrapped>(stage, std::move(f)));
}

/// Wraps a function (state, forces&) as a force term of the rotor.
template <class F>
void AddForceTerm(Plant& plant, F f) {
  struct Wrapped final : ForceTerm {
    explicit Wrapped(F function) : f(std::move(function)) {}
    void Add(const MotionState& state, RotorForces& forces) const override { f(state, forces); }
    mutable F f;  // may keep what it computed last: a plant is of one run
  };
  plant.rotor.terms.push_back(std::make_unique<Wrapped>(std::move(f)));
}

}  // namespace ambrig
