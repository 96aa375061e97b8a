#include "effects/formula.h"

#include <algorithm>
#include <iterator>
#include <optional>

#include "effects/effect.h"
#include "effects/formula_parser.h"
#include "effects/plane_targets.h"

namespace ambrig {

namespace {

/// Where a formula's names get their values: the lists of FormulaNames, then the parameters.
/// Bearings and bus keep their addresses for the life of the plant.
class FormulaValues {
 public:
  FormulaValues(const EffectInstance& e, const Plant& plant, const BearingPlant* bearing)
      : target_(FormulaTargetOf(e.target)), bus_(&plant.bus), bearing_(bearing) {
    names_ = FormulaNames(target_);
    values_.assign(names_.size(), 0.0);
    for (std::size_t k = 0; k < e.table.size(); ++k) {
      names_.push_back(e.table[k].name);
      values_.push_back(e.values[k]);
    }
  }

  const std::vector<std::string>& names() const { return names_; }

  const double* At(const MotionState& m, double x, double y, double vx, double vy) {
    const double motion[] = {x, y, vx, vy, m.theta, m.Omega, m.t, bus_->voltage};
    std::copy(std::begin(motion), std::end(motion), values_.begin());
    if (target_ == FormulaTarget::kRig) return values_.data();
    for (int j = 0; j < kFormulaCurrents; ++j)
      values_[8 + static_cast<std::size_t>(j)] =
          j < bearing_->lanes.coils ? bearing_->lanes.i[j] : 0;
    return values_.data();
  }
  const double* AtPlane(const MotionState& m, const PlaneMap& map) {
    return At(m, map.X(m.q), map.Y(m.q), map.X(m.v), map.Y(m.v));
  }
  void SetOwnCurrent(double i) {
    if (target_ == FormulaTarget::kCoil) values_[8 + kFormulaCurrents] = i;
  }

 private:
  FormulaTarget target_;
  const BusSupply* bus_;
  const BearingPlant* bearing_;
  std::vector<std::string> names_;
  std::vector<double> values_;
};

/// One quantity of an effect: its formulas in x and y (or the only one in x), and their values.
struct Law {
  Law(const EffectInstance& e, const Plant& plant, const BearingPlant* bearing,
      const std::string& quantity)
      : values(e, plant, bearing) {
    for (const auto& [name, text] : e.formulas) {
      if (name == quantity || name == quantity + ".x") x.emplace(text, values.names(), e.where);
      if (name == quantity + ".y") y.emplace(text, values.names(), e.where);
    }
  }
  bool any() const { return x || y; }
  FormulaValues values;
  std::optional<FormulaExpression> x, y;
};

class FormulaForce : public ForceTerm {
 public:
  FormulaForce(std::unique_ptr<Law> law, const BearingPlant& b)
      : law_(std::move(law)), map_(b.plane), radial_(!b.thrust && !b.opposed) {}
  void Add(const MotionState& m, RotorForces& forces) const override {
    const double* v = law_->values.AtPlane(m, map_);
    const double fx = law_->x ? (*law_->x)(v) : 0, fy = law_->y ? (*law_->y)(v) : 0;
    map_.AddForce(fx, fy, forces.Q);
    if (!radial_) return;
    forces.stator_x += fx;
    forces.stator_y += fy;
  }

 private:
  std::unique_ptr<Law> law_;  // evaluation writes into it
  PlaneMap map_;
  bool radial_;
};

class FormulaTorque : public ForceTerm {
 public:
  explicit FormulaTorque(std::unique_ptr<Law> law) : law_(std::move(law)) {}
  void Add(const MotionState& m, RotorForces& forces) const override {
    forces.torque += (*law_->x)(law_->values.At(m, m.q[0], m.q[1], m.v[0], m.v[1]));
  }

 private:
  std::unique_ptr<Law> law_;
};

class FormulaReading : public StagedMap {
 public:
  FormulaReading(std::unique_ptr<Law> law, const PlaneMap& map)
      : StagedMap(ReadingStage::kFormula), law_(std::move(law)), map_(map) {}
  void Map(const MotionState& m, double* x, double* y) override {
    const double* v = law_->values.At(m, *x, *y, map_.X(m.v), map_.Y(m.v));
    const double next_x = law_->x ? (*law_->x)(v) : *x;
    if (law_->y) *y = (*law_->y)(v);
    *x = next_x;
  }

 private:
  std::unique_ptr<Law> law_;
  PlaneMap map_;
};

class FormulaVoltage : public VoltageTerm {
 public:
  FormulaVoltage(std::unique_ptr<Law> law, const PlaneMap& map) : law_(std::move(law)), map_(map) {}
  double Voltage(const CoilCircumstance& c) const override {
    MotionState none;
    none.t = c.t;
    const MotionState& m = c.motion ? *c.motion : none;
    law_->values.SetOwnCurrent(c.current);
    return (*law_->x)(law_->values.At(m, c.x, c.y, map_.X(m.v), map_.Y(m.v)));
  }

 private:
  std::unique_ptr<Law> law_;
  PlaneMap map_;
};

void AddVoltage(const EffectInstance& e, Plant& plant, BearingPlant& b) {
  const std::size_t at = e.target.find(".coil");
  for (int j = 0; j < b.lanes.coils; ++j) {
    if (at != std::string::npos && std::stoi(e.target.substr(at + 5)) != j + 1) continue;
    auto law = std::make_unique<Law>(e, plant, &b, "voltage");
    if (law->any())
      b.voltage[j].push_back(std::make_unique<FormulaVoltage>(std::move(law), b.plane));
  }
}

void Apply(const EffectInstance& e, Plant& plant) {
  if (e.formulas.empty()) return;
  if (FormulaTargetOf(e.target) == FormulaTarget::kRig) {
    auto torque = std::make_unique<Law>(e, plant, nullptr, "torque");
    if (torque->any())
      plant.rotor.terms.push_back(std::make_unique<FormulaTorque>(std::move(torque)));
    return;
  }
  BearingPlant& b = TargetPlane(e, plant);
  auto force = std::make_unique<Law>(e, plant, &b, "force");
  if (force->any())
    plant.rotor.terms.push_back(std::make_unique<FormulaForce>(std::move(force), b));
  auto reading = std::make_unique<Law>(e, plant, &b, "reading");
  if (reading->any())
    InsertMap(b.sensor, std::make_unique<FormulaReading>(std::move(reading), b.sensor.map));
  AddVoltage(e, plant, b);
}

}  // namespace

EffectDescription Formula() {
  EffectDescription d;
  d.id = "formula";
  d.title = "A law written by the user";
  d.physics =
      "A force, reading, voltage or torque as a formula of position, speed, angle, time and "
      "currents,\n"
      "written in the rig file with parameters of its own; fitted and adopted like any other "
      "effect.";
  d.target = TargetKind::kAny;
  d.users_own = true;
  d.shows_in = "depends on the formula";
  d.confused_with = "depends on the formula";
  d.apply = Apply;
  return d;
}

}  // namespace ambrig
