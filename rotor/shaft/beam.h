#pragma once
/// Beam rotor: shaft of Timoshenko elements with disks, sleeves and spring/damper supports.
/// Axes and signs of base_model.md section 1: node dofs (x, y, alpha about x, beta about y); the
/// section rotation is beta in the x-z plane and -alpha in the y-z plane. Shaft and disks are
/// round, so both planes share M, K, C and couple through J alone. With plane dofs (w, psi) per
/// node:
///   M ux'' + C ux' + Omega J uy' + K ux = fx,   M uy'' + C uy' - Omega J ux' + K uy = fy
/// or in all dofs   M q'' + (D + Omega G) q' + K q = f,  supports included in D and K.
/// z is the file's own axis, left to right; `Totals` gives the centre of mass on it. Units SI.
#include <Eigen/Dense>
#include <array>
#include <string>
#include <vector>

#include "rotor/motion/linear_rotor.h"
#include "rotor/shaft/shaft_element.h"

namespace ambrig {

struct Disk {
  double z = kRequired;
  double mass = kRequired;               // [kg]
  double inertia_diametral = kRequired;  // about a diameter through its centre [kg m2]
  double inertia_polar = kRequired;      // [kg m2]
  std::string name;
};

inline constexpr Field<Disk> kDiskFields[] = {
    {"z", &Disk::z, "m", -1e3, 1e3, "plane of the disk on the shaft axis"},
    {"mass", &Disk::mass, "kg", 0.0, 1e6, "mass"},
    {"inertia_diametral", &Disk::inertia_diametral, "kg m2", 0.0, 1e9, "inertia about a diameter"},
    {"inertia_polar", &Disk::inertia_polar, "kg m2", 0.0, 1e9, "inertia about the shaft axis"},
};

/// A round disk of given width and diameters, its centre at z.
Disk DiskFromGeometry(double z, double width, double id, double od, double rho);

/// Linear spring and damper to ground at one plane (force on rotor = -k d - c d').
struct SpringSupport {
  double z = kRequired;
  double kxx = 0, kxy = 0, kyx = 0, kyy = 0;  // [N/m]
  double cxx = 0, cxy = 0, cyx = 0, cyy = 0;  // [N s/m]
  std::string name;
};

inline constexpr Field<SpringSupport> kSpringSupportFields[] = {
    {"z", &SpringSupport::z, "m", -1e3, 1e3, "plane of the support on the shaft axis"},
    {"kxx", &SpringSupport::kxx, "N/m", -1e15, 1e15, "stiffness"},
    {"kxy", &SpringSupport::kxy, "N/m", -1e15, 1e15, "stiffness, x force per y displacement"},
    {"kyx", &SpringSupport::kyx, "N/m", -1e15, 1e15, "stiffness, y force per x displacement"},
    {"kyy", &SpringSupport::kyy, "N/m", -1e15, 1e15, "stiffness"},
    {"cxx", &SpringSupport::cxx, "N s/m", -1e12, 1e12, "damping"},
    {"cxy", &SpringSupport::cxy, "N s/m", -1e12, 1e12, "damping, x force per y velocity"},
    {"cyx", &SpringSupport::cyx, "N s/m", -1e12, 1e12, "damping, y force per x velocity"},
    {"cyy", &SpringSupport::cyy, "N s/m", -1e12, 1e12, "damping"},
};

SpringSupport IsotropicSupport(double z, double k, double c);

/// What a person describes.
struct BeamDefinition {
  // shaft pieces and sleeves (stiff = false), may lie in layers
  std::vector<ShaftSection> sections;
  std::vector<Disk> disks;
  std::vector<SpringSupport> supports;
  std::vector<double> stations;  // further planes that become nodes (sensors, AMBs)
  int elements_per_section = 4;  // per shaft piece; planes in between split further
  BeamTheory theory;
};

/// What is computed with: nodes, elements and the matrices of one bending plane of the free shaft,
/// dofs (w, psi) per node.
struct BeamRotor {
  std::vector<double> z;               // node planes
  std::vector<ShaftElement> elements;  // element i joins nodes i and i + 1
  std::vector<Disk> disks;
  std::vector<SpringSupport> supports;
  BeamTheory theory;
  Eigen::MatrixXd M, J, K, C;
};

struct RotorTotals {
  double mass = 0;                // [kg]
  double z_com = 0;               // [m]
  double inertia_transverse = 0;  // about the centre of mass [kg m2]
  double inertia_polar = 0;       // [kg m2]
};

/// @throws InputError for gaps in the shaft, planes off the shaft or bores wider than the shaft.
BeamRotor BuildBeam(const BeamDefinition& definition);

/// Four dofs per node (x, y, alpha, beta), supports included.
LinearRotor Assemble(const BeamRotor& rotor);

/// Exact sums over sections and disks (not over the mass matrix, which lumping distorts).
RotorTotals Totals(const BeamRotor& rotor);

/// The node at z; the nearest within `tolerance` of the shaft's length. @throws std::logic_error
/// when none.
int NodeAt(const BeamRotor& rotor, double z);

}  // namespace ambrig
