/// Any stator: poles, a winding matrix, permanent magnets (actuators/magnetics/pole_network.h), with
/// two axes across the shaft or one along it.
#include "effects/plant.h"
#include "rig/bearing_kinds/bearing_kind.h"
#include "rig/bearing_kinds/stator_file.h"

namespace ambrig {

namespace {

const StatorParameters& StatorOf(const BearingParameters& b) {
  const auto* p = std::any_cast<StatorParameters>(&b.own);
  Require(p != nullptr, "the reader has filled the stator");
  return *p;
}

template <bool axial>
void ReadAnyStator(const TomlTable& t, BearingParameters& b, std::vector<Tolerance>* tolerances) {
  if (!std::any_cast<StatorParameters>(&b.own)) b.own = StatorParameters{};
  ReadStator(t, axial, *std::any_cast<StatorParameters>(&b.own), tolerances);
}

void VisitStator(BearingParameters& b, const PlaceVisitor& visit) {
  auto& p = *std::any_cast<StatorParameters>(&b.own);
  VisitPlaces(p, kStatorFields, visit);
  if (!p.pattern.empty()) VisitPlaces(p, kStatorTemplateFields, visit);
  if (p.bias.mmf != 0)
    for (const Field<BiasMagnet>& f : kBiasMagnetFields)
      if (f.key == "mmf") visit({"bias.mmf", &(p.bias.*f.at), f.lo, f.hi, f.unit});
}

BiasLinearisation LineariseStator(const BearingParameters& b, double bias) {
  const StatorParameters& p = StatorOf(b);
  return LineariseAtBias(*NetworkOf(p), BiasOf(p, bias), p.axial ? 1 : 2);
}

double StatorForceConstant(const BearingParameters& b) {
  // Of a stator without magnets k does not hang on the bias.
  return LineariseStator(b, 1).k;
}

double StatorBias(const BearingParameters& b) {
  const StatorParameters& p = StatorOf(b);
  if (NetworkOf(p)->has_magnets()) return LineariseStator(b, 0).c0;
  return p.bias_current;
}

PlaneMap AxialStatorPlane(const BearingParameters&, const RotorModel&, double z) {
  PlaneMap map;
  map.z = z;
  map.Add(2, 1, 0);
  return map;
}

}  // namespace

const BearingKind& StatorBearing() {
  static constexpr BearingKind kind{
      .name = "stator",
      .acts_on = kOnStator,
      .two_axes = true,
      .coils = [](const BearingParameters& b) { return CoilsOf(PolesOf(StatorOf(b))); },
      .axes =
          [](const BearingParameters& b) {
            return std::vector<std::string>{b.name + ".x", b.name + ".y"};
          },
      .read = ReadAnyStator<false>,
      .document =
          [](std::vector<ParameterRow>& rows) {
            AddRows(rows, "[bearings.A] kind = \"stator\" or \"axial-stator\"", kStatorFields);
            AddRows(rows, "[bearings.A] template = \"...\"", kStatorTemplateFields);
            AddRows(rows, "[bearings.A] poles = [{ ... }]", kStatorPoleFields);
            AddRows(rows, "[bearings.A.bias]", kBiasMagnetFields);
          },
      .numbers = VisitStator,
      .stator = [](const BearingParameters& b) { return GeometryOf(StatorOf(b)); },
      .force_constant = StatorForceConstant,
      .own_bias = StatorBias,
      .check = [](const TomlTable& t, const BearingParameters& b, double bias,
                  bool unipolar) { CheckStator(t, StatorOf(b), bias, unipolar); },
      .linearise = LineariseStator,
      .plane = [](const BearingParameters&, const RotorModel& rotor,
                  double z) { return rotor.MakePlane(z); },
      .add_auxiliary =
          [](const BearingParameters& b, RotorModel& rotor) {
            rotor.AddAuxiliary(b.name, std::isnan(b.auxiliary_z) ? b.z : b.auxiliary_z,
                               *b.auxiliary);
          },
  };
  return kind;
}

const BearingKind& AxialStatorBearing() {
  static constexpr BearingKind kind{
      .name = "axial-stator",
      .acts_on = kOnAxialStator,
      .axial = true,
      .coils = [](const BearingParameters& b) { return CoilsOf(PolesOf(StatorOf(b))); },
      .axes = [](const BearingParameters&) { return std::vector<std::string>{"z"}; },
      .axis =
          [](const BearingParameters&) {
            return std::array<double, 3>{0, 0, 1};
          },
      .read = ReadAnyStator<true>,
      .document = [](std::vector<ParameterRow>&) {},
      .numbers = VisitStator,
      .stator = [](const BearingParameters& b) { return GeometryOf(StatorOf(b)); },
      .force_constant = StatorForceConstant,
      .own_bias = StatorBias,
      .check = [](const TomlTable& t, const BearingParameters& b, double bias,
                  bool unipolar) { CheckStator(t, StatorOf(b), bias, unipolar); },
      .linearise = LineariseStator,
      .plane = AxialStatorPlane,
      .add_auxiliary = [](const BearingParameters& b,
                          RotorModel& rotor) { rotor.SetAxialStop(*b.auxiliary); },
  };
  return kind;
}

}  // namespace ambrig
