/// Any stator: poles, a winding matrix, permanent magnets (actuators/magnetics/pole_network.h),
/// with two axes across the shaft or one along it.
#include "rig/bearing_kinds/bearing_plane.h"
#include "rig/bearing_kinds/stator_file.h"
#include "rig/parameters/bearing_kind.h"

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

/// What both kinds have in common.
constexpr BearingKind AnyStator() {
  BearingKind kind{};
  kind.coils = [](const BearingParameters& b) { return CoilsOf(PolesOf(StatorOf(b))); };
  kind.numbers = VisitStator;
  kind.stator = [](const BearingParameters& b) { return GeometryOf(StatorOf(b)); };
  kind.force_constant = StatorForceConstant;
  kind.own_bias = StatorBias;
  kind.check = [](const TomlTable& t, const BearingParameters& b, double bias, bool unipolar) {
    CheckStator(t, StatorOf(b), bias, unipolar);
  };
  kind.linearise = LineariseStator;
  return kind;
}

constexpr BearingKind StatorAcross() {
  BearingKind kind = AnyStator();
  kind.name = "stator";
  kind.acts_on = kOnStator;
  kind.two_axes = true;
  kind.axes = AxesAcross;
  kind.read = ReadAnyStator<false>;
  kind.document = [](std::vector<ParameterRow>& rows) {
    AddRows(rows, "[bearings.A] kind = \"stator\" or \"axial-stator\"", kStatorFields);
    AddRows(rows, "[bearings.A] template = \"...\"", kStatorTemplateFields);
    AddRows(rows, "[bearings.A] poles = [{ ... }]", kStatorPoleFields);
    AddRows(rows, "[bearings.A.bias]", kBiasMagnetFields);
  };
  kind.plane = PlaneAcross;
  kind.add_auxiliary = AddAuxiliaryAtPlane;
  return kind;
}

constexpr BearingKind StatorAlong() {
  BearingKind kind = AnyStator();
  kind.name = "axial-stator";
  kind.acts_on = kOnAxialStator;
  kind.axial = true;
  kind.axes = AxisAlong;
  kind.axis = DirectionAlong;
  kind.read = ReadAnyStator<true>;
  kind.document = [](std::vector<ParameterRow>&) {};  // the rows of "stator" hold for it too
  kind.plane = PlaneAlong;
  kind.add_auxiliary = SetAxialStopOf;
  return kind;
}

}  // namespace

const BearingKind& StatorBearing() {
  static constexpr BearingKind kind = StatorAcross();
  return kind;
}

const BearingKind& AxialStatorBearing() {
  static constexpr BearingKind kind = StatorAlong();
  return kind;
}

}  // namespace ambrig
