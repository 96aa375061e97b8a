#include "rotor/shaft/beam.h"

#include "core/math/constants.h"
#include "rotor/shaft/beam_mesh.h"

namespace ambrig {
namespace {

void AddDisks(BeamRotor& r) {
  for (const Disk& d : r.disks) {
    const int w = 2 * NodeAt(r, d.z);
    r.M(w, w) += d.mass;
    r.M(w + 1, w + 1) += d.inertia_diametral;
    if (r.theory.gyroscopic) r.J(w + 1, w + 1) += d.inertia_polar;
  }
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

void AddSupportAtNode(const SpringSupport& s, int node, LinearRotor& out) {
  const int x = 4 * node;
  Eigen::Matrix2d k, c;
  k << s.kxx, s.kxy, s.kyx, s.kyy;
  c << s.cxx, s.cxy, s.cyx, s.cyy;
  out.K.block<2, 2>(x, x) += k;
  out.D.block<2, 2>(x, x) += c;
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

}  // namespace

Disk DiskFromGeometry(double z, double width, double id, double od, double rho) {
  const double mass = rho * kPi / 4 * (od * od - id * id) * width;
  const double radii = (od * od + id * id) / 4;
  return {z, mass, mass / 12 * (3 * radii + width * width), mass / 2 * radii, {}};
}

SpringSupport IsotropicSupport(double z, double k, double c) {
  SpringSupport s;
  s.z = z;
  s.kxx = s.kyy = k;
  s.cxx = s.cyy = c;
  return s;
}

BeamRotor BuildBeam(const BeamDefinition& d) {
  BeamMesh mesh = MakeMesh(d);
  BeamRotor r{mesh.z, mesh.elements, d.disks, d.supports, d.theory, {}, {}, {}, {}};
  const int n = 2 * static_cast<int>(r.z.size());
  for (Eigen::MatrixXd* a : {&r.M, &r.J, &r.K, &r.C}) a->setZero(n, n);
  for (int i = 0; i < static_cast<int>(r.elements.size()); ++i) {
    const PlaneElement e = ElementMatrices(r.elements[i], d.theory);
    r.M.block<4, 4>(2 * i, 2 * i) += e.M;
    r.J.block<4, 4>(2 * i, 2 * i) += e.J;
    r.K.block<4, 4>(2 * i, 2 * i) += e.K;
    r.C.block<4, 4>(2 * i, 2 * i) += e.C;
  }
  AddDisks(r);
  return r;
}

LinearRotor Assemble(const BeamRotor& r) {
  const int n = static_cast<int>(r.M.rows());
  LinearRotor out;
  for (Eigen::MatrixXd* a : {&out.M, &out.G, &out.D, &out.K}) a->setZero(2 * n, 2 * n);
  for (int a = 0; a < n; ++a)
    for (int b = 0; b < n; ++b) {
      const DofMap xa = InX(a), xb = InX(b), ya = InY(a), yb = InY(b);
      const double sign = ya.sign * yb.sign;
      out.M(xa.index, xb.index) = r.M(a, b), out.M(ya.index, yb.index) = sign * r.M(a, b);
      out.D(xa.index, xb.index) = r.C(a, b), out.D(ya.index, yb.index) = sign * r.C(a, b);
      out.K(xa.index, xb.index) = r.K(a, b), out.K(ya.index, yb.index) = sign * r.K(a, b);
      out.G(xa.index, yb.index) = yb.sign * r.J(a, b);
      out.G(ya.index, xb.index) = -ya.sign * r.J(a, b);
    }
  for (const SpringSupport& s : r.supports) AddSupportAtNode(s, NodeAt(r, s.z), out);
  for (int i = 0; i < n / 2; ++i) out.xy.push_back({4 * i, 4 * i + 1});
  return out;
}

RotorTotals Totals(const BeamRotor& r) {
  double m = 0, mz = 0, mzz = 0, ip = 0;
  for (const ShaftElement& e : r.elements)
    for (const ShaftSection& layer : e.layers) AddSectionMass(layer, m, mz, mzz, ip);
  for (const Disk& d : r.disks) {
    m += d.mass;
    mz += d.mass * d.z;
    mzz += d.mass * d.z * d.z + d.inertia_diametral;
    ip += d.inertia_polar;
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
