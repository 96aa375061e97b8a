#include "rotor/shaft/three_node_element.h"

#include "rotor/shaft/cross_section.h"
#include "rotor/shaft/separate_layers.h"

namespace ambrig {
namespace {

using LoadRow = Eigen::RowVector4d;              // per (M0, Q0, q, m)
using LoadPair = Eigen::Matrix<double, 2, 4>;    // rows w, psi
using LoadShares = Eigen::Matrix<double, 4, 6>;  // (M0, Q0, q, m) per u
using NodeRow = Eigen::Matrix<double, 1, 6>;     // per u

LoadRow MomentAt(const BeamTheory& theory, double s) {
  return {1, -s, -s * s / 2, theory.shear ? s : -s * s * s / 6};
}

LoadRow ShearAt(const BeamTheory& theory, double s) {
  return {0, 1, s, theory.shear ? 0 : s * s / 2};
}

/// (w, psi) at s of an element clamped at 0: psi = ∫ M/EI dt,
/// w = ∫ (s - t) M/EI + Q/(kappa G A) dt.
LoadPair ClampedDeflection(const ShaftElement& e, const BeamTheory& theory, double s) {
  LoadPair out = LoadPair::Zero();
  Quadrature(s, [&](double t, double weight) {
    const CrossSection c = SectionAt(e, theory, t);
    const LoadRow bend = weight / c.EI * MomentAt(theory, t);
    out.row(0) += (s - t) * bend;
    out.row(1) += bend;
    if (theory.shear) out.row(0) += weight / c.kGA * ShearAt(theory, t);
  });
  return out;
}

LoadShares SharesOf(const ShaftElement& e, const BeamTheory& theory) {
  const double h = e.length / 2, L = e.length;
  Eigen::Matrix4d D;
  D << ClampedDeflection(e, theory, h), ClampedDeflection(e, theory, L);
  LoadShares relative;  // w and psi of the other nodes less the rigid motion of the left one
  relative << -1, -h, 1, 0, 0, 0,  //
      0, -1, 0, 1, 0, 0,           //
      -1, -L, 0, 0, 1, 0,          //
      0, -1, 0, 0, 0, 1;
  return D.fullPivLu().solve(relative);
}

void AddAt(const ShaftElement& e, const BeamTheory& theory, const LoadShares& shares, double s,
           double weight, ThreeNodePlaneElement& out) {
  const CrossSection c = SectionAt(e, theory, s);
  const NodeRow moment = MomentAt(theory, s) * shares, shear = ShearAt(theory, s) * shares;
  out.K += weight / c.EI * moment.transpose() * moment;
  if (theory.shear) out.K += weight / c.kGA * shear.transpose() * shear;
  const LoadPair clamped = ClampedDeflection(e, theory, s);
  NodeRow w = clamped.row(0) * shares, psi = clamped.row(1) * shares;
  w(0) += 1;
  w(1) += s;
  psi(1) += 1;
  out.M += weight * c.rhoA * w.transpose() * w;
  const Matrix6 tilt = weight * c.rhoI * psi.transpose() * psi;
  if (theory.rotary_inertia) out.M += tilt;
  if (theory.gyroscopic) out.J += 2 * tilt;
  double tension = 0;
  for (const ShaftSection& l : e.layers) tension += l.axial_force;
  const NodeRow slope = theory.shear ? NodeRow(psi + shear / c.kGA) : psi;
  out.tension += weight * tension * slope.transpose() * slope;
}

ThreeNodePlaneElement JoinedThree(const ShaftElement& e, const BeamTheory& theory) {
  ThreeNodePlaneElement out;
  const LoadShares shares = SharesOf(e, theory);
  Quadrature(e.length, [&](double s, double weight) { AddAt(e, theory, shares, s, weight, out); });
  for (const ShaftSection& l : e.layers) {
    if (!l.stiff) continue;
    out.C = l.damping_mass * out.M + l.damping_stiffness * out.K;
    break;
  }
  return out;
}

}  // namespace

ThreeNodePlaneElement ThreeNodeMatrices(const ShaftElement& e, const BeamTheory& theory) {
  if (!theory.separate_layers || e.layers.size() < 2) return JoinedThree(e, theory);
  return SeparateLayers<ThreeNodePlaneElement>(
      e, [&](const ShaftElement& one) { return JoinedThree(one, theory); });
}

std::array<ShaftElement, 2> Halves(const ShaftElement& e) {
  const double middle = e.z0 + e.length / 2;
  std::array<ShaftElement, 2> out{ShaftElement{e.z0, e.length / 2, {}},
                                  ShaftElement{middle, e.length / 2, {}}};
  for (const ShaftSection& l : e.layers) {
    out[0].layers.push_back(Slice(l, l.z0, middle));
    out[1].layers.push_back(Slice(l, middle, l.z0 + l.length));
  }
  return out;
}

ShaftElement Whole(const ShaftElement& left, const ShaftElement& right) {
  ShaftElement out = left;
  out.length += right.length;
  for (std::size_t i = 0; i < out.layers.size(); ++i) {
    out.layers[i].length += right.layers[i].length;
    out.layers[i].od_right = right.layers[i].od_right;
    out.layers[i].id_right = right.layers[i].id_right;
  }
  return out;
}

}  // namespace ambrig
