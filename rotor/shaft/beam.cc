#include "rotor/shaft/beam.h"

#include <algorithm>

#include "core/math/constants.h"
#include "rotor/shaft/beam_mesh.h"
#include "rotor/shaft/three_node_element.h"

namespace ambrig {
namespace {

void AddDisks(BeamRotor& r) {
  for (const Disk& d : r.disks) {
    const int w = 2 * NodeAt(r, d.z);
    r.M(w, w) += d.mass;
    r.M(w + 1, w + 1) += d.inertia_diametral;
    if (r.theory.gyroscopic) r.J(w + 1, w + 1) += d.inertia_polar;
  }
  for (const PointMass& p : r.masses) r.M(2 * NodeAt(r, p.z), 2 * NodeAt(r, p.z)) += p.radial();
}

/// Index and sign of a plane dof among (x, y, alpha, beta): psi is beta in x-z and -alpha in y-z.
struct DofMap {
  int index;
  double sign;
};
DofMap InX(int plane_dof) { return {4 * (plane_dof / 2) + (plane_dof % 2 ? 3 : 0), 1.0}; }
DofMap InY(int plane_dof) {
  return {4 * (plane_dof / 2) + (plane_dof % 2 ? 2 : 1), plane_dof % 2 ? -1.0 : 1.0};
}

/// The (x, y) dofs of one side of a support; -1: the ground.
int SideOf(const BeamRotor& r, const std::string& housing, int otherwise) {
  return housing.empty() ? otherwise : HousingDof(r, housing);
}

void AddSupportSides(const BeamRotor& r, const SpringSupport& s, double speed, LinearRotor& out) {
  const SupportCoefficients at = s.At(speed);
  Eigen::Matrix2d k, c, m;
  k << at.kxx, at.kxy, at.kyx, at.kyy;
  c << at.cxx, at.cxy, at.cyx, at.cyy;
  m << at.mxx, at.mxy, at.myx, at.myy;
  const int other = s.between_shafts() ? 4 * NodeAt(r, s.to_z) : -1;
  const int sides[2] = {SideOf(r, s.carries, s.on_shaft() ? 4 * NodeAt(r, s.z) : -1),
                        SideOf(r, s.on, other)};
  const bool turns[2] = {s.on_shaft(), s.between_shafts()};
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < 2; ++j) {
      if (sides[i] < 0 || sides[j] < 0) continue;
      const double sign = i == j ? 1 : -1;
      if (turns[i] && turns[j]) {
        const Eigen::Vector2d kr(at.krx, at.kry), cr(at.crx, at.cry);
        out.K.block<2, 2>(sides[i] + 2, sides[j] + 2).diagonal() += sign * kr;
        out.D.block<2, 2>(sides[i] + 2, sides[j] + 2).diagonal() += sign * cr;
      }
      out.K.block<2, 2>(sides[i], sides[j]) += sign * k;
      out.D.block<2, 2>(sides[i], sides[j]) += sign * c;
      out.M.block<2, 2>(sides[i], sides[j]) += sign * m;
    }
}

void AddBodies(const BeamRotor& r, LinearRotor& out) {
  for (const PointMass& p : r.masses) {  // their mean is in the plane matrices
    const int x = 4 * NodeAt(r, p.z);
    const double half = 0.5 * (p.mass_x - p.mass_y);
    out.M(x, x) += half;
    out.M(x + 1, x + 1) -= half;
  }
  for (const Housing& h : r.housings) {
    const int x = HousingDof(r, h.name);
    out.M(x, x) += h.mass_x;
    out.M(x + 1, x + 1) += h.mass_y;
    out.xy.push_back({x, x + 1});
  }
}

void AddTorque(const BeamRotor& r, LinearRotor& out) {
  for (std::size_t i = 0; i < r.elements.size(); ++i) {
    double torque = 0;
    for (const ShaftSection& l : r.elements[i].layers) torque += l.torque;
    if (torque == 0) continue;
    const int left = 4 * static_cast<int>(i);
    out.K.block<8, 8>(left, left) += TorqueMatrix(r.elements[i].length, torque);
  }
}

/// Mass, first and second moment about z = 0 and polar inertia of a piece of shaft, by the theorem
/// that a round section has I about its diameter and 2 I about its axis.
void AddSectionMass(const ShaftSection& s, double& m, double& mz, double& mzz, double& ip) {
  // Degree 4 in t for diameters, 2 more for z²: four Gauss points are exact.
  static constexpr double t[] = {0.06943184420297371, 0.33000947820757187, 0.66999052179242813,
                                 0.93056815579702629};
  static constexpr double weight[] = {0.17392742256872693, 0.32607257743127307, 0.32607257743127307,
                                      0.17392742256872693};
  for (int i = 0; i < 4; ++i) {
    const double od = s.od + t[i] * (s.od_right - s.od), id = s.id + t[i] * (s.id_right - s.id);
    const double scale = weight[i] * s.length * s.material.rho * kPi, z = s.z0 + t[i] * s.length;
    const double dm = scale * (od * od - id * id) / 4;
    const double di = scale * (std::pow(od, 4) - std::pow(id, 4)) / 64;
    m += dm;
    mz += dm * z;
    mzz += dm * z * z + di;
    ip += 2 * di;
  }
}

template <int n, class Element>
void AddElement(const Element& e, int left_node, BeamRotor& r) {
  const int at = 2 * left_node;
  r.M.block<n, n>(at, at) += e.M;
  r.J.block<n, n>(at, at) += e.J;
  r.K.block<n, n>(at, at) += e.K;
  r.C.block<n, n>(at, at) += e.C;
  r.tension.block<n, n>(at, at) += e.tension;
}

}  // namespace

Disk DiskFromGeometry(double z, double width, double id, double od, double rho) {
  const double mass = rho * kPi / 4 * (od * od - id * id) * width;
  const double radii = (od * od + id * id) / 4;
  return {z, mass, mass / 12 * (3 * radii + width * width), mass / 2 * radii, {}};
}

BeamRotor BuildBeam(const BeamDefinition& d) {
  BeamMesh mesh = MakeMesh(d);
  BeamRotor r{mesh.z, mesh.elements, d.disks,  d.supports, d.theory, {}, {}, {}, {},
              {},     d.housings,    d.masses, d.shafts};
  const int n = 2 * static_cast<int>(r.z.size());
  for (Eigen::MatrixXd* a : {&r.M, &r.J, &r.K, &r.C, &r.tension}) a->setZero(n, n);
  for (int i = 0; i < static_cast<int>(r.elements.size()); ++i) {
    if (d.theory.element == ElementKind::kTwoNode || r.elements[i].layers.empty()) {
      AddElement<4>(ElementMatrices(r.elements[i], d.theory), i, r);
    } else {
      AddElement<6>(ThreeNodeMatrices(Whole(r.elements[i], r.elements[i + 1]), d.theory), i, r);
      ++i;
    }
  }
  AddDisks(r);
  return r;
}

LinearRotor Assemble(const BeamRotor& r, double speed) {
  LinearRotor out;
  AssembleInto(r, speed, out);
  return out;
}

void AssembleInto(const BeamRotor& r, double speed, LinearRotor& out) {
  const int n = static_cast<int>(r.M.rows()),
            dofs = 2 * n + 2 * static_cast<int>(r.housings.size());
  for (Eigen::MatrixXd* a : {&out.M, &out.G, &out.D, &out.K}) a->setZero(dofs, dofs);
  const int reach = r.theory.element == ElementKind::kTwoNode ? 3 : 5;  // two dofs a node
  for (int a = 0; a < n; ++a)
    for (int b = std::max(0, a - reach); b < std::min(n, a + reach + 1); ++b) {
      const double k = r.K(a, b) + r.tension(a, b);
      const DofMap xa = InX(a), xb = InX(b), ya = InY(a), yb = InY(b);
      const double sign = ya.sign * yb.sign;
      out.M(xa.index, xb.index) = r.M(a, b), out.M(ya.index, yb.index) = sign * r.M(a, b);
      out.D(xa.index, xb.index) = r.C(a, b), out.D(ya.index, yb.index) = sign * r.C(a, b);
      out.K(xa.index, xb.index) = k, out.K(ya.index, yb.index) = sign * k;
      out.G(xa.index, yb.index) = yb.sign * r.J(a, b);
      out.G(ya.index, xb.index) = -ya.sign * r.J(a, b);
    }
  out.xy.clear();
  for (int i = 0; i < n / 2; ++i) out.xy.push_back({4 * i, 4 * i + 1});
  AddBodies(r, out);
  AddTorque(r, out);
  for (const SpringSupport& s : r.supports) AddSupportSides(r, s, speed, out);
}

int HousingDof(const BeamRotor& r, const std::string& name) {
  for (std::size_t k = 0; k < r.housings.size(); ++k)
    if (r.housings[k].name == name)
      return 2 * static_cast<int>(r.M.rows()) + 2 * static_cast<int>(k);
  Require(false, "a housing of this name");
  return -1;
}

Eigen::MatrixXd ShaftRows(const BeamRotor& r, double z) {
  std::size_t i = 0;
  while (i + 1 < r.elements.size() && z > r.z[i + 1]) ++i;
  if (r.elements[i].layers.empty()) ++i;  // the left end of the shaft behind a gap
  const double s = std::clamp(z - r.z[i], 0.0, r.elements[i].length);
  const Eigen::RowVector4d w = ShapeAt(r.elements[i], r.theory, s).w;
  Eigen::MatrixXd rows =
      Eigen::MatrixXd::Zero(2, 2 * r.M.rows() + 2 * static_cast<Eigen::Index>(r.housings.size()));
  for (int k = 0; k < 4; ++k) {
    const DofMap x = InX(2 * static_cast<int>(i) + k), y = InY(2 * static_cast<int>(i) + k);
    rows(0, x.index) = w(k);
    rows(1, y.index) = y.sign * w(k);
  }
  return rows;
}

RotorTotals Totals(const BeamRotor& r) {
  double m = 0, mz = 0, mzz = 0, ip = 0;
  for (const ShaftElement& e : r.elements)
    for (ShaftSection layer : e.layers) {
      layer.z0 = PlaceOf(r.shafts, layer.z0);
      AddSectionMass(layer, m, mz, mzz, ip);
    }
  for (const Disk& d : r.disks) {
    const double z = PlaceOf(r.shafts, d.z);
    m += d.mass;
    mz += d.mass * z;
    mzz += d.mass * z * z + d.inertia_diametral;
    ip += d.inertia_polar;
  }
  for (const PointMass& p : r.masses) {
    const double z = PlaceOf(r.shafts, p.z);
    m += p.radial();
    mz += p.radial() * z;
    mzz += p.radial() * z * z;
  }
  const double z_com = mz / m;
  return {m, z_com, mzz - m * z_com * z_com, ip};
}

int NodeAt(const BeamRotor& r, double z) {
  int best = 0;
  for (int i = 1; i < static_cast<int>(r.z.size()); ++i)
    if (std::abs(r.z[i] - z) < std::abs(r.z[best] - z)) best = i;
  Require(std::abs(r.z[best] - z) <= 1e-6 * (r.z.back() - r.z.front()), "a node at this plane");
  return best;
}

}  // namespace ambrig
