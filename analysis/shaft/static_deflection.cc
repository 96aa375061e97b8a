#include "analysis/shaft/static_deflection.h"

#include <cmath>

#include "rotor/shaft/beam_mesh.h"
#include "rotor/shaft/dynamic_matrix.h"

namespace ambrig {

namespace {

using Eigen::VectorXd;

/// Shear and moment at both ends of every element from the displacements of the y-z plane.
void AddSections(const BeamRotor& beam, const VectorXd& u, double g, StaticDeflection& out) {
  for (std::size_t i = 0; i < beam.elements.size(); ++i) {
    if (beam.elements[i].layers.empty()) continue;  // a gap between shafts
    const PlaneElement e = ElementMatrices(beam.elements[i], beam.theory);
    Eigen::Vector4d ends;
    const Eigen::Index left = 4 * static_cast<Eigen::Index>(i), right = left + 4;
    ends << u(left + 1), -u(left + 2), u(right + 1), -u(right + 2);  // psi = -alpha in y-z
    const Eigen::Vector4d lift(1, 0, 1, 0);
    const Eigen::Vector4d force = (e.K + e.tension) * ends + g * (e.M * lift);
    out.at.insert(out.at.end(), {beam.z[i], beam.z[i + 1]});
    out.shear.insert(out.shear.end(), {force(0), -force(2)});
    out.moment.insert(out.moment.end(), {-force(1), force(3)});
  }
}

VectorXd Weight(const BeamRotor& beam, double g) {
  const Eigen::Index n = beam.M.rows();
  VectorXd lift = VectorXd::Zero(n);
  for (Eigen::Index k = 0; k < n; k += 2) lift(k) = 1;
  const VectorXd plane = -g * (beam.M * lift);
  VectorXd f = VectorXd::Zero(2 * n + 2 * static_cast<Eigen::Index>(beam.housings.size()));
  for (Eigen::Index k = 0; k < n; k += 2) {
    f(2 * k + 1) = plane(k);
    f(2 * k + 2) = -plane(k + 1);
  }
  // The plane matrices carry the mean of a point mass in x and y.
  for (const PointMass& p : beam.masses)
    f(4 * NodeAt(beam, p.z) + 1) -= g * (p.mass_y - p.radial());
  for (const Housing& h : beam.housings) f(HousingDof(beam, h.name) + 1) -= g * h.mass_y;
  return f;
}

Eigen::Vector2d SideOf(const BeamRotor& beam, const VectorXd& u, const std::string& housing,
                       int otherwise) {
  const int dof = housing.empty() ? otherwise : HousingDof(beam, housing);
  return dof < 0 ? Eigen::Vector2d::Zero() : Eigen::Vector2d(u.segment<2>(dof));
}

}  // namespace

StaticDeflection DeflectUnderWeight(const BeamRotor& beam, double speed, double gravity) {
  StaticDeflection out;
  const LinearRotor r = Assemble(beam, speed);
  const VectorXd f = Weight(beam, gravity);
  for (Eigen::Index k = 1; k < 2 * beam.M.rows(); k += 4) out.weight -= f(k);
  DynamicMatrix matrix(r, 0);
  if (!matrix.Factorise(0)) return out;
  const VectorXd u = matrix.Solve(f.cast<std::complex<double>>()).real();
  // A motion that nothing holds leaves a matrix that is singular but for rounding.
  const double span = beam.z.back() - beam.z.front();
  out.held = u.allFinite() && (r.K * u - f).norm() < 1e-6 * f.norm() &&
             u.cwiseAbs().maxCoeff() < 10 * span;
  if (!out.held) return out;
  for (std::size_t i = 0; i < beam.z.size(); ++i) {
    out.z.push_back(beam.z[i]);
    out.x.push_back(u(4 * static_cast<Eigen::Index>(i)));
    out.y.push_back(u(4 * static_cast<Eigen::Index>(i) + 1));
  }
  AddSections(beam, u, gravity, out);
  for (const SpringSupport& s : beam.supports) {
    const SupportCoefficients c = s.At(speed);
    const Eigen::Vector2d d =
        SideOf(beam, u, s.carries, s.on_shaft() ? 4 * NodeAt(beam, s.z) : -1) -
        SideOf(beam, u, s.on, s.between_shafts() ? 4 * NodeAt(beam, s.to_z) : -1);
    out.reactions.push_back({s.name, s.on_shaft() ? s.z : kRequired,
                             -(c.kxx * d.x() + c.kxy * d.y()), -(c.kyx * d.x() + c.kyy * d.y())});
  }
  return out;
}

}  // namespace ambrig
