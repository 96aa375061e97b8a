#pragma once
/// One Timoshenko shaft element in one bending plane. Displacement w(s), section rotation psi(s),
/// 0 <= s <= L; end values u = (w0, psi0, w1, psi1). Static laws without load between the ends:
///   psi' = M/EI,  w' = psi + Q/(kappa G A),  M(s) = M0 - Q s,  Q constant,
/// integrated with the true EI(s), GA(s), so nodal statics are exact for any taper and the shape
/// functions are the static deflections; a uniform element is the usual interdependent one.
///   M = ∫ rho A w'w + rho I psi'psi,   J = ∫ 2 rho I psi'psi (gyroscopic)
///   K = ∫ M²/EI + Q²/(kappa G A)
/// An axial force N (tension) adds ∫ N w'w' (dead load; in bending alone). A torque couples
/// both planes (TorqueMatrix).
/// Layers of one element share w and psi: shaft layers add mass and stiffness, sleeves and
/// laminations (`stiff` = false) mass alone. With `separate_layers` they share end values
/// alone and each is an element of its own, as in ROSS. Units SI. Sources: Timoshenko beam
/// theory; kappa of Cowper (J. Appl. Mech. 33, 1966) or Hutchinson (J. Appl. Mech. 68, 2001) for
/// a hollow circle.
#include <Eigen/Dense>
#include <string>
#include <vector>

#include "core/base/parameters.h"

namespace ambrig {

struct Material {
  double E = kRequired;    // Young's modulus [N/m2]
  double rho = kRequired;  // density [kg/m3]
  double nu = 0.3;         // Poisson's ratio
  double shear_modulus() const { return E / (2 * (1 + nu)); }
};

inline constexpr Field<Material> kMaterialFields[] = {
    {"E", &Material::E, "N/m2", 2e3, 1e13, "Young's modulus"},
    {"rho", &Material::rho, "kg/m3", 0.0, 1e5, "density"},
    {"nu", &Material::nu, "-", -0.99, 0.5, "Poisson's ratio"},
};

/// A cylindrical or conical piece with a bore: diameters linear from left to right.
struct ShaftSection {
  double z0 = 0;              // left end [m]
  double length = kRequired;  // [m]
  double od = kRequired, id = 0;
  double od_right = kRequired, id_right = 0;
  Material material;
  bool stiff = true;             // false: sleeve or lamination stack, mass without stiffness
  double damping_mass = 0;       // Rayleigh: C = damping_mass M + damping_stiffness K [1/s]
  double damping_stiffness = 0;  // [s]
  std::string name;
  double axial_force = 0;  // tension [N]
  double torque = 0;       // [N m]
  std::string shaft{};     // of several, by name
};

inline constexpr Field<ShaftSection> kShaftSectionFields[] = {
    {"length", &ShaftSection::length, "m", 1e-6, 1e3, "length of the section"},
    {"od", &ShaftSection::od, "m", 1e-5, 1e2, "outer diameter (left end)"},
    {"id", &ShaftSection::id, "m", 0.0, 1e2, "inner diameter (left end)"},
    {"od_right", &ShaftSection::od_right, "m", 1e-5, 1e2,
     "outer diameter at the right end, default od"},
    {"id_right", &ShaftSection::id_right, "m", 0.0, 1e2,
     "inner diameter at the right end, default id"},
    {"damping_mass", &ShaftSection::damping_mass, "1/s", 0.0, 1e6, "Rayleigh damping with mass"},
    {"damping_stiffness", &ShaftSection::damping_stiffness, "s", 0.0, 1.0,
     "Rayleigh damping with stiffness"},
    {"axial_force", &ShaftSection::axial_force, "N", -1e9, 1e9, "tension, below 0 compression"},
    {"torque", &ShaftSection::torque, "N m", -1e9, 1e9,
     "torque that the section transmits, about +z on its right end"},
};

enum class MassKind { kConsistent, kLumped };
enum class ShearCoefficient { kCowper, kHutchinson };
enum class ElementKind { kTwoNode, kThreeNode };

/// What is modelled, the same for every element of a rotor.
struct BeamTheory {
  MassKind mass = MassKind::kConsistent;
  bool shear = true;
  bool rotary_inertia = true;
  bool gyroscopic = true;
  ShearCoefficient coefficient = ShearCoefficient::kCowper;
  bool separate_layers = false;
  ElementKind element = ElementKind::kTwoNode;  // kThreeNode: rotor/shaft/three_node_element.h
};

/// One element: all layers span exactly [z0, z0 + length].
struct ShaftElement {
  double z0 = 0, length = 0;
  std::vector<ShaftSection> layers;
};

struct PlaneElement {
  Eigen::Matrix4d M = Eigen::Matrix4d::Zero(), J = M, K = M, C = M, tension = M;
};

struct ElementShape {
  Eigen::RowVector4d w, psi;  // times u: displacement and section rotation
};

/// The part of a section between z_left and z_right (which it must cover).
ShaftSection Slice(const ShaftSection& section, double z_left, double z_right);

/// kappa of a hollow circular section with bore ratio id/od.
double ShearCoefficientOf(ShearCoefficient kind, double bore_ratio, double nu);

PlaneElement ElementMatrices(const ShaftElement& element, const BeamTheory& theory);

/// Stiffness of a torque T along the axis over (x, y, alpha, beta) of both ends: virtual work
/// T ∫ (x'' dy' - y'' dx') of the cubic shapes, with a torque that keeps the axis' direction at
/// both ends; what two elements of one torque do at their common node cancels. T counts about +z on
/// the right end. Source: Friswell et al., Dynamics of Rotating Machines, 2010, 5.4.
Eigen::Matrix<double, 8, 8> TorqueMatrix(double length, double torque);

/// Static shape functions at distance s from the left end.
ElementShape ShapeAt(const ShaftElement& element, const BeamTheory& theory, double s);

}  // namespace ambrig
