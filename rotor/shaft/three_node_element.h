#pragma once
/// A Timoshenko shaft element with a node in its middle, of fourth order with shear; the element
/// of two nodes (rotor/shaft/shaft_element.h) has no shear of its own inertia load and is of second
/// order there. Values at 0, L/2 and L: u = (w0, psi0, w1, psi1, w2, psi2). Its shapes are the
/// static deflections under end forces, a constant load q and a constant moment load m along the
/// element, in the signs of shaft_element.h:
///   Q(s) = Q0 + q s,  M(s) = M0 - Q0 s - q s²/2 + m s,  psi' = M/EI,  w' = psi + Q/(kappa G A)
/// with the true EI(s), GA(s). q and m are what inertia does: rho A w'' and rho I psi''. Without
/// shear m bends as Q0 does, and a load that grows with s takes its place: Q = q s²/2, M = -q s³/6.
///   K = ∫ M²/EI + Q²/(kappa G A);  M, J and the tension's part as there.
/// Units SI.
#include <array>

#include "rotor/shaft/shaft_element.h"

namespace ambrig {

using Matrix6 = Eigen::Matrix<double, 6, 6>;

struct ThreeNodePlaneElement {
  Matrix6 M = Matrix6::Zero(), J = M, K = M, C = M, tension = M;
};

/// `element` over its whole length; of consistent mass. Layers joined or separate as
/// the theory says.
ThreeNodePlaneElement ThreeNodeMatrices(const ShaftElement& element, const BeamTheory& theory);

/// Both halves of an element.
std::array<ShaftElement, 2> Halves(const ShaftElement& element);

/// The element of two halves.
ShaftElement Whole(const ShaftElement& left, const ShaftElement& right);

}  // namespace ambrig
