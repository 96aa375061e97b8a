#include "analysis/shaft/shaft_unbalance.h"

#include <cmath>

#include "core/math/constants.h"
#include "rotor/shaft/beam_mesh.h"
#include "rotor/shaft/dynamic_matrix.h"
#include "rotor/shaft/rotor_modes.h"

namespace ambrig {

namespace {

using Complex = std::complex<double>;
using Eigen::MatrixXcd;

/// Unit columns of every case: Omega² U e^{i phase} (1, -i) without Omega².
MatrixXcd UnitForces(const BeamRotor& beam, const std::vector<UnbalanceCase>& cases) {
  MatrixXcd f;
  for (std::size_t k = 0; k < cases.size(); ++k)
    for (const PlaneUnbalance& u : cases[k].planes) {
      const Eigen::MatrixXd rows = ShaftRows(beam, u.z);
      if (f.size() == 0) f.setZero(rows.cols(), static_cast<Eigen::Index>(cases.size()));
      const Complex push = std::polar(u.magnitude, u.phase);
      f.col(static_cast<Eigen::Index>(k)) +=
          rows.transpose().cast<Complex>() * Eigen::Vector2cd(push, Complex(0, -1) * push);
    }
  return f;
}

Eigen::Vector2cd Moved(const BeamRotor& beam, const Eigen::VectorXcd& q, const std::string& housing,
                       int otherwise) {
  const int dof = housing.empty() ? otherwise : HousingDof(beam, housing);
  return dof < 0 ? Eigen::Vector2cd::Zero() : Eigen::Vector2cd(q.segment<2>(dof));
}

Eigen::Vector2cd ForceOf(const BeamRotor& beam, const SpringSupport& s, const Eigen::VectorXcd& q,
                         double w) {
  const SupportCoefficients c = s.At(w);
  const Eigen::Vector2cd d =
      Moved(beam, q, s.carries, s.on_shaft() ? 4 * NodeAt(beam, s.z) : -1) -
      Moved(beam, q, s.on, s.between_shafts() ? 4 * NodeAt(beam, s.to_z) : -1);
  Eigen::Matrix2cd z;
  z << Complex(c.kxx - w * w * c.mxx, w * c.cxx), Complex(c.kxy - w * w * c.mxy, w * c.cxy),
      Complex(c.kyx - w * w * c.myx, w * c.cyx), Complex(c.kyy - w * w * c.myy, w * c.cyy);
  return -(z * d);
}

/// Share of the weight [N] of every plane of the shaft that a support holds; housings stand
/// between.
std::vector<std::pair<double, double>> Loads(const BeamRotor& beam,
                                             const StaticDeflection& weight) {
  std::vector<std::pair<double, double>> out;
  for (std::size_t k = 0; k < weight.reactions.size(); ++k)
    if (const SupportReaction& r = weight.reactions[k];
        std::isfinite(r.z) && r.fy != 0 && !beam.supports[k].between_shafts())
      out.emplace_back(r.z, std::abs(r.fy));
  return out;
}

}  // namespace

Eigen::MatrixXd ProbeRows(const BeamRotor& beam, const ShaftProbe& p) {
  if (p.housing.empty()) return ShaftRows(beam, p.z);
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(
      2, 2 * beam.M.rows() + 2 * static_cast<Eigen::Index>(beam.housings.size()));
  const int at = HousingDof(beam, p.housing);
  rows(0, at) = rows(1, at + 1) = 1;
  return rows;
}

void FindOrbitPeaks(const std::vector<double>& at, std::vector<ProbeOrbit>& probes) {
  for (ProbeOrbit& p : probes) {
    std::vector<double> major;
    for (std::size_t k = 0; k < p.x.size(); ++k) major.push_back(AxesOfOrbit(p.x[k], p.y[k]).major);
    p.peaks = FindPeaks(at, major);
  }
}

double NodalAngle(Complex x, Complex y) {
  const Complex forward = x + Complex(0, 1) * y, backward = std::conj(x - Complex(0, 1) * y);
  return 0.5 * std::arg(forward * backward);
}

std::vector<ShaftSweep> SweepShaft(const BeamRotor& beam, const std::vector<UnbalanceCase>& cases,
                                   const std::vector<ShaftProbe>& probes,
                                   const std::vector<double>& speeds) {
  std::vector<ShaftSweep> out;
  if (cases.empty()) return out;
  std::vector<Eigen::MatrixXd> rows;
  for (const ShaftProbe& p : probes) rows.push_back(ProbeRows(beam, p));
  for (const UnbalanceCase& c : cases) {
    out.push_back({c, speeds, {}, {}});
    for (const ShaftProbe& p : probes) out.back().probes.push_back({p, {}, {}, {}});
    for (const SpringSupport& s : beam.supports) out.back().forces.push_back({s.name, {}, {}});
  }
  const MatrixXcd unit = UnitForces(beam, cases);
  LinearRotor rotor;
  for (const double w : speeds) {
    AssembleInto(beam, w, rotor);
    DynamicMatrix matrix(rotor, w);
    // exactly at a pole without damping: beside it
    if (!matrix.Factorise(Complex(0, w)) && !matrix.Factorise(Complex(0, w * (1 + 1e-9))))
      throw InputError(
          "the supports leave a motion of the shaft free, allowed: supports that hold it");
    const MatrixXcd q = matrix.Solve(w * w * unit);
    for (std::size_t k = 0; k < cases.size(); ++k) {
      const Eigen::VectorXcd of = q.col(static_cast<Eigen::Index>(k));
      for (std::size_t p = 0; p < probes.size(); ++p) {
        const Eigen::Vector2cd d = rows[p].cast<Complex>() * of;
        out[k].probes[p].x.push_back(d.x());
        out[k].probes[p].y.push_back(d.y());
      }
      for (std::size_t s = 0; s < beam.supports.size(); ++s) {
        const Eigen::Vector2cd f = ForceOf(beam, beam.supports[s], of, w);
        out[k].forces[s].x.push_back(f.x());
        out[k].forces[s].y.push_back(f.y());
      }
    }
  }
  for (ShaftSweep& sweep : out) FindOrbitPeaks(speeds, sweep.probes);
  return out;
}

std::vector<UnbalanceCase> GradeUnbalance(const BeamRotor& beam, const StaticDeflection& weight,
                                          double grade, double speed) {
  const auto loads = Loads(beam, weight);
  double total = 0;
  for (const auto& [z, load] : loads) total += load;
  const double whole = Totals(beam).mass * grade / speed;
  std::vector<UnbalanceCase> out = {{"static", {}}, {"couple", {}}};
  for (std::size_t k = 0; k < loads.size(); ++k) {
    const double magnitude = whole * loads[k].second / total;
    out[0].planes.push_back({loads[k].first, magnitude, 0});
    out[1].planes.push_back({loads[k].first, magnitude, k % 2 ? kPi : 0});
  }
  return out;
}

std::vector<UnbalanceCase> ApiUnbalance(const BeamRotor& beam, const StaticDeflection& weight,
                                        double speed) {
  std::vector<UnbalanceCase> out = {{"static", {}}, {"couple", {}}, {"middle", {}}};
  const auto loads = Loads(beam, weight);
  const double per_kilogram = 6350.0 / (speed / kRpm) * 1e-6;  // [kg m] per kg of load
  double sum = 0;
  for (std::size_t k = 0; k < loads.size(); ++k) {
    const double magnitude = per_kilogram * loads[k].second / kStandardGravity;
    out[0].planes.push_back({loads[k].first, magnitude, 0});
    out[1].planes.push_back({loads[k].first, magnitude, k % 2 ? kPi : 0});
    sum += magnitude;
  }
  out[2].planes.push_back({Totals(beam).z_com, sum, 0});
  return out;
}

}  // namespace ambrig
