#pragma once
/// Beam rotor: shaft of Timoshenko elements with disks, sleeves and spring/damper supports.
/// Axes and signs of base_model.md section 1: node dofs (x, y, alpha about x, beta about y); the
/// section rotation is beta in the x-z plane and -alpha in the y-z plane. Shaft and disks are
/// round, so both planes share M, K, C and couple through J alone. With plane dofs (w, psi) per
/// node:
///   M ux'' + C ux' + Omega J uy' + K ux = fx,   M uy'' + C uy' - Omega J ux' + K uy = fy
/// or in all dofs   M q'' + (D + Omega G) q' + K q = f,  supports included in D and K.
/// or, with the tension N of the sections, K + N-part (Assemble; not in K of BeamRotor).
/// z is the file's own axis, left to right; `Totals` gives the centre of mass on it. Several
/// shafts, coaxial or in line, lie one after the other on one axis of nodes
/// (rotor/shaft/several_shafts.h). Units SI.
#include <Eigen/Dense>
#include <array>
#include <string>
#include <vector>

#include "rotor/linear/linear_rotor.h"
#include "rotor/shaft/several_shafts.h"
#include "rotor/shaft/shaft_element.h"
#include "rotor/shaft/support.h"

namespace ambrig {

struct Disk {
  double z = kRequired;
  double mass = kRequired;               // [kg]
  double inertia_diametral = kRequired;  // about a diameter through its centre [kg m2]
  double inertia_polar = kRequired;      // [kg m2]
  std::string name, shaft{};
};

inline constexpr Field<Disk> kDiskFields[] = {
    {"z", &Disk::z, "m", -1e3, 1e3, "plane of the disk on the shaft axis"},
    {"mass", &Disk::mass, "kg", 0.0, 1e6, "mass"},
    {"inertia_diametral", &Disk::inertia_diametral, "kg m2", 0.0, 1e9, "inertia about a diameter"},
    {"inertia_polar", &Disk::inertia_polar, "kg m2", 0.0, 1e9, "inertia about the shaft axis"},
};

/// A round disk of given width and diameters, its centre at z.
Disk DiskFromGeometry(double z, double width, double id, double od, double rho);

/// What a person describes.
struct BeamDefinition {
  // shaft pieces and sleeves (stiff = false), may lie in layers
  std::vector<ShaftSection> sections;
  std::vector<Disk> disks;
  std::vector<SpringSupport> supports;
  std::vector<double> stations;  // further planes that become nodes (sensors, AMBs)
  int elements_per_section = 4;  // per shaft piece; planes in between split further
  BeamTheory theory;
  std::vector<Housing> housings;  // what supports may stand on
  std::vector<PointMass> masses;
  std::vector<PlacedShaft> shafts{};  // empty: one
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
  Eigen::MatrixXd tension;  // of the axial forces, beside K: free modes are those without them
  std::vector<Housing> housings;
  std::vector<PointMass> masses;
  std::vector<PlacedShaft> shafts{};
};

struct RotorTotals {
  double mass = 0;                // [kg]
  double z_com = 0;               // [m]
  double inertia_transverse = 0;  // about the centre of mass [kg m2]
  double inertia_polar = 0;       // [kg m2]
};

/// @throws InputError for gaps in the shaft, planes off the shaft or bores wider than the shaft.
BeamRotor BuildBeam(const BeamDefinition& definition);

/// Four dofs per node (x, y, alpha, beta), then (x, y) of each housing; axial forces
/// and supports as they are at `speed` [rad/s] included. `xy`: the nodes of the shaft,
/// then the housings.
LinearRotor Assemble(const BeamRotor& rotor, double speed = 0);
/// The same into matrices that are there, for one speed after the other.
void AssembleInto(const BeamRotor& rotor, double speed, LinearRotor& out);

/// The first dof of a housing among those of Assemble.
int HousingDof(const BeamRotor& rotor, const std::string& name);

/// Displacement (x, y) of the shaft at any z on it over the dofs of Assemble (2 x dofs), by the
/// elements' own interpolation; its transpose takes forces in.
Eigen::MatrixXd ShaftRows(const BeamRotor& rotor, double z);

/// Exact sums over sections and disks (not over the mass matrix, which lumping distorts).
RotorTotals Totals(const BeamRotor& rotor);

/// The node at z; the nearest within `tolerance` of the shaft's length. @throws std::logic_error
/// when none.
int NodeAt(const BeamRotor& rotor, double z);

}  // namespace ambrig
