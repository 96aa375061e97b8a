#include "rotor/shaft/beam_theory_file.h"

#include <fmt/format.h>

namespace ambrig {
namespace {

/// Whether the key asks for `other` instead of `usual`; absent it stays as it was.
bool Asks(const TomlTable& rotor, const char* key, const char* usual, const char* other, bool was) {
  return rotor.Choice(key, was ? other : usual, fmt::format("{}, {}", usual, other)) == other;
}

}  // namespace

BeamTheory ReadTheory(const TomlTable& rotor, BeamTheory t) {
  const bool lumped = Asks(rotor, "mass", "consistent", "lumped", t.mass == MassKind::kLumped);
  t.mass = lumped ? MassKind::kLumped : MassKind::kConsistent;
  t.shear = rotor.Bool("shear", t.shear);
  t.rotary_inertia = rotor.Bool("rotary_inertia", t.rotary_inertia);
  t.gyroscopic = rotor.Bool("gyroscopic", t.gyroscopic);
  t.separate_layers = Asks(rotor, "layers", "joined", "separate", t.separate_layers);
  const bool hutchinson = Asks(rotor, "shear_coefficient", "cowper", "hutchinson",
                               t.coefficient == ShearCoefficient::kHutchinson);
  t.coefficient = hutchinson ? ShearCoefficient::kHutchinson : ShearCoefficient::kCowper;
  const bool three =
      Asks(rotor, "element", "two_node", "three_node", t.element == ElementKind::kThreeNode);
  t.element = three ? ElementKind::kThreeNode : ElementKind::kTwoNode;
  if (three && lumped)
    rotor.Fail("element", "= \"three_node\" with mass = \"lumped\", allowed: consistent mass");
  return t;
}

}  // namespace ambrig
