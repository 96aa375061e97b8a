#include "analysis/shaft/harmonic_response.h"

#include "rotor/shaft/beam_mesh.h"
#include "rotor/shaft/dynamic_matrix.h"

namespace ambrig {

namespace {

using Complex = std::complex<double>;

/// What the ground's motion does through the supports that stand on it.
Eigen::VectorXcd GroundForces(const BeamRotor& beam, const HarmonicLoad& load, double speed,
                              double w, Eigen::Index dofs) {
  Eigen::VectorXcd f = Eigen::VectorXcd::Zero(dofs);
  const Eigen::Vector2d u(load.ground_x, load.ground_y);
  if (u.isZero()) return f;
  for (const SpringSupport& s : beam.supports) {
    if (!s.on.empty() || s.between_shafts()) continue;
    const SupportCoefficients c = s.At(speed);
    Eigen::Matrix2cd z;
    z << Complex(c.kxx - w * w * c.mxx, w * c.cxx), Complex(c.kxy - w * w * c.mxy, w * c.cxy),
        Complex(c.kyx - w * w * c.myx, w * c.cyx), Complex(c.kyy - w * w * c.myy, w * c.cyy);
    const int at = s.on_shaft() ? 4 * NodeAt(beam, s.z) : HousingDof(beam, s.carries);
    f.segment<2>(at) += z * u;
  }
  return f;
}

}  // namespace

HarmonicSweep SweepHarmonic(const BeamRotor& beam, double speed, const HarmonicLoad& load,
                            const std::vector<ShaftProbe>& probes,
                            const std::vector<double>& frequencies) {
  HarmonicSweep out{speed, frequencies, {}};
  const LinearRotor rotor = Assemble(beam, speed);
  DynamicMatrix matrix(rotor, speed);
  std::vector<Eigen::MatrixXd> rows;
  for (const ShaftProbe& p : probes) {
    rows.push_back(ProbeRows(beam, p));
    out.probes.push_back({p, {}, {}, {}});
  }
  Eigen::VectorXcd forces = Eigen::VectorXcd::Zero(rotor.M.rows());
  for (const HarmonicForce& f : load.forces)
    forces += ProbeRows(beam, f.plane).transpose().cast<Complex>() *
              (Eigen::Vector2d(f.x, f.y).cast<Complex>() * std::polar(1.0, f.phase));
  for (const double w : frequencies) {
    // exactly at a pole without damping: beside it
    if (!matrix.Factorise(Complex(0, w)) && !matrix.Factorise(Complex(0, w * (1 + 1e-9))))
      throw InputError(
          "the supports leave a motion of the shaft free, allowed: supports that hold it");
    const Eigen::VectorXcd q =
        matrix.Solve(forces + GroundForces(beam, load, speed, w, rotor.M.rows()));
    for (std::size_t p = 0; p < probes.size(); ++p) {
      const Eigen::Vector2cd d = rows[p].cast<Complex>() * q;
      out.probes[p].x.push_back(d.x());
      out.probes[p].y.push_back(d.y());
    }
  }
  FindOrbitPeaks(frequencies, out.probes);
  return out;
}

}  // namespace ambrig
