#include "rotor/shaft/shaft_element.h"

#include "rotor/shaft/cross_section.h"
#include "rotor/shaft/separate_layers.h"

namespace ambrig {
namespace {

using Shape2x4 = Eigen::Matrix<double, 2, 4>;

/// Integrals of the flexibility from 0 to s; names as in psi and w of the header with M = M0 - Q s.
struct Flexibility {
  double one = 0, first = 0, second = 0;  // ∫ 1/EI, ∫ t/EI, ∫ t²/EI
  double shear = 0;                       // ∫ 1/kGA
};

Flexibility FlexibilityTo(const ShaftElement& e, const BeamTheory& theory, double s) {
  Flexibility f;
  Quadrature(s, [&](double t, double weight) {
    const CrossSection c = SectionAt(e, theory, t);
    f.one += weight / c.EI;
    f.first += weight * t / c.EI;
    f.second += weight * t * t / c.EI;
    if (theory.shear) f.shear += weight / c.kGA;
  });
  return f;
}

/// (psi - psi0, w - w0 - psi0 s) at s per (M0, Q).
Eigen::Matrix2d Deflection(const Flexibility& f, double s) {
  Eigen::Matrix2d D;
  D << f.one, -f.first, s * f.one - f.first, f.shear - (s * f.first - f.second);
  return D;
}

/// (M0, Q) per end displacements.
Shape2x4 EndForces(const Flexibility& f, double length) {
  Shape2x4 R;
  R << 0, -1, 0, 1, -1, -length, 1, 0;
  return Deflection(f, length).inverse() * R;
}

ElementShape Shape(const ShaftElement& e, const BeamTheory& theory, const Shape2x4& forces,
                   double s) {
  const Shape2x4 d = Deflection(FlexibilityTo(e, theory, s), s) * forces;
  ElementShape shape{d.row(1), d.row(0)};
  shape.w += Eigen::RowVector4d(1, s, 0, 0);
  shape.psi += Eigen::RowVector4d(0, 1, 0, 0);
  return shape;
}

void AddConsistentMass(const ShaftElement& e, const BeamTheory& theory, const Shape2x4& forces,
                       PlaneElement& out) {
  Quadrature(e.length, [&](double s, double weight) {
    const CrossSection c = SectionAt(e, theory, s);
    const ElementShape n = Shape(e, theory, forces, s);
    const Eigen::Matrix4d tilt = n.psi.transpose() * n.psi;
    out.M += weight * c.rhoA * n.w.transpose() * n.w;
    if (theory.rotary_inertia) out.M += weight * c.rhoI * tilt;
    if (theory.gyroscopic) out.J += 2 * weight * c.rhoI * tilt;
  });
}

/// Mass to the ends so that total and centre of mass stay; each half turns with its node as a rigid
/// piece.
void AddLumpedMass(const ShaftElement& e, const BeamTheory& theory, PlaneElement& out) {
  const auto add = [&](double s, double weight) {
    const CrossSection c = SectionAt(e, theory, s);
    const double t = s / e.length;
    const double arm = t < 0.5 ? s : e.length - s;
    if (theory.rotary_inertia)
      out.M(t < 0.5 ? 1 : 3, t < 0.5 ? 1 : 3) += weight * c.rhoA * arm * arm;
    for (const auto& [end, share] : {std::pair{0, 1 - t}, std::pair{2, t}}) {
      out.M(end, end) += weight * c.rhoA * share;
      if (theory.rotary_inertia) out.M(end + 1, end + 1) += weight * c.rhoI * share;
      if (theory.gyroscopic) out.J(end + 1, end + 1) += 2 * weight * c.rhoI * share;
    }
  };
  Quadrature(e.length / 2, add);
  Quadrature(e.length / 2, [&](double s, double weight) { add(e.length / 2 + s, weight); });
}

void AddTension(const ShaftElement& e, const BeamTheory& theory, const Shape2x4& forces,
                PlaneElement& out) {
  double tension = 0;
  for (const ShaftSection& l : e.layers) tension += l.axial_force;
  if (tension == 0) return;
  Quadrature(e.length, [&](double s, double weight) {
    Eigen::RowVector4d slope = Shape(e, theory, forces, s).psi;
    if (theory.shear) slope += forces.row(1) / SectionAt(e, theory, s).kGA;
    out.tension += weight * tension * slope.transpose() * slope;
  });
}

/// Matrices of layers that share w and psi.
PlaneElement Joined(const ShaftElement& e, const BeamTheory& theory) {
  PlaneElement out;
  const Flexibility f = FlexibilityTo(e, theory, e.length);
  const Shape2x4 forces = EndForces(f, e.length);
  Eigen::Matrix2d energy;
  energy << f.one, -f.first, -f.first, f.second + f.shear;
  out.K = forces.transpose() * energy * forces;
  if (theory.mass == MassKind::kConsistent)
    AddConsistentMass(e, theory, forces, out);
  else
    AddLumpedMass(e, theory, out);
  AddTension(e, theory, forces, out);
  for (const ShaftSection& l : e.layers) {
    if (!l.stiff) continue;
    out.C = l.damping_mass * out.M + l.damping_stiffness * out.K;
    break;
  }
  return out;
}

}  // namespace

ShaftSection Slice(const ShaftSection& section, double z_left, double z_right) {
  const auto at = [&](double left, double right, double z) {
    return left + (right - left) * (z - section.z0) / section.length;
  };
  ShaftSection out = section;
  out.z0 = z_left;
  out.length = z_right - z_left;
  out.od = at(section.od, section.od_right, z_left);
  out.od_right = at(section.od, section.od_right, z_right);
  out.id = at(section.id, section.id_right, z_left);
  out.id_right = at(section.id, section.id_right, z_right);
  return out;
}

double ShearCoefficientOf(ShearCoefficient kind, double bore_ratio, double nu) {
  const double m2 = bore_ratio * bore_ratio, q = (1 + m2) * (1 + m2);
  if (kind == ShearCoefficient::kCowper)
    return 6 * (1 + nu) * q / ((7 + 6 * nu) * q + (20 + 12 * nu) * m2);
  return 6 * (1 + nu) * (1 + nu) * q /
         ((7 + 12 * nu + 4 * nu * nu) * q + 4 * m2 * (5 + 6 * nu + 2 * nu * nu));
}

PlaneElement ElementMatrices(const ShaftElement& e, const BeamTheory& theory) {
  if (e.layers.empty()) return {};
  const auto joined = [&](const ShaftElement& one) { return Joined(one, theory); };
  return theory.separate_layers && e.layers.size() > 1 ? SeparateLayers<PlaneElement>(e, joined)
                                                       : joined(e);
}

Eigen::Matrix<double, 8, 8> TorqueMatrix(double length, double torque) {
  const double h = length / 2;
  Eigen::Matrix<double, 8, 8> K;
  K << 0, 0, 1, 0, 0, 0, -1, 0,  //
      0, 0, 0, 1, 0, 0, 0, -1,   //
      1, 0, 0, -h, -1, 0, 0, h,  //
      0, 1, h, 0, 0, -1, -h, 0,  //
      0, 0, -1, 0, 0, 0, 1, 0,   //
      0, 0, 0, -1, 0, 0, 0, 1,   //
      -1, 0, 0, -h, 1, 0, 0, h,  //
      0, -1, h, 0, 0, 1, -h, 0;
  return K * (torque / length);
}

ElementShape ShapeAt(const ShaftElement& element, const BeamTheory& theory, double s) {
  const Flexibility f = FlexibilityTo(element, theory, element.length);
  return Shape(element, theory, EndForces(f, element.length), s);
}

}  // namespace ambrig
