#include "analysis/measured_sensitivity.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <Eigen/Eigenvalues>
#include <cmath>

#include "analysis/closed_loop.h"
#include "core/math/constants.h"
#include "core/math/linear_equations.h"
#include "core/record/channels.h"
#include "simulation/simulate.h"

namespace ambrig {

namespace {

using Complex = std::complex<double>;

constexpr double kFaded = 1e-4;  // of its size at the start: no longer there

/// Poles z of the loop that still ring after `settle` [s], one of each complex pair.
std::vector<Complex> Ringing(const OperatingPoint& point, const SineTest& test) {
  const ClosedLoop loop(point, test.speed);
  const Eigen::VectorXcd z = loop.Phi.eigenvalues();
  std::vector<Complex> out;
  for (const Complex& pole : z)
    if (pole.imag() >= 0 && std::pow(std::abs(pole), test.settle / loop.Ts()) > kFaded)
      out.push_back(pole);
  return out;
}

/// Least squares of mean + drift + Re(a e^{iωt}) + what turns with the shaft + what rings on, on
/// samples at t_k, one in every Ts. Returns a.
Complex FitSine(const std::vector<double>& t, const std::vector<double>& y, double omega,
                double speed, const std::vector<Complex>& ringing) {
  const bool turns = speed > 0 && std::abs(speed / omega - 1) > 1e-3;
  const auto rows = static_cast<Eigen::Index>(t.size()),
             free = static_cast<Eigen::Index>(2 * ringing.size());
  Eigen::MatrixXd basis(rows, (turns ? 6 : 4) + free);
  Eigen::VectorXd value(rows);
  std::vector<Complex> now(ringing.size(), 1.0);
  for (Eigen::Index k = 0; k < rows; ++k) {
    const auto i = static_cast<std::size_t>(k);
    basis.row(k).head<4>() << 1, t[i] - t.front(), std::cos(omega * t[i]), std::sin(omega * t[i]);
    if (turns) basis.row(k).segment<2>(4) << std::cos(speed * t[i]), std::sin(speed * t[i]);
    for (std::size_t m = 0; m < ringing.size(); ++m) {
      const Eigen::Index at = basis.cols() - free + static_cast<Eigen::Index>(2 * m);
      basis(k, at) = now[m].real();
      basis(k, at + 1) = now[m].imag();  // nothing of a real pole: the factorisation leaves it out
      now[m] *= ringing[m];
    }
    value(k) = y[i];
  }
  const Eigen::VectorXd c = SolveLeastSquares(basis, value);
  return {c(2), -c(3)};
}

/// Force commands of one axis of bearing `b`, from its set-points: v by least squares over the
/// coils.
std::vector<double> Commands(const Record& record, const OperatingPoint& point, std::size_t b,
                             std::size_t side) {
  const BearingControl& control = point.control()[b];
  const Eigen::Index columns = point.AxisCount(b) > 1 ? 3 : 2;
  const Eigen::MatrixXd W = control.map.W.topLeftCorner(control.coils, columns);
  const Eigen::RowVectorXd row = SolveSymmetricColumns(W.transpose() * W, W.transpose())
                                     .row(1 + static_cast<Eigen::Index>(side));
  std::vector<double> f(record.rows(), 0.0);
  for (int j = 0; j < control.coils; ++j) {
    const Channel* set = Find(record, {ChannelKind::kSetPoint, control.name, j});
    Require(set != nullptr, "set-points in the record");
    for (std::size_t k = 0; k < f.size(); ++k)
      f[k] += control.map.k * control.map.c0 * row(j) * set->samples[k];
  }
  return f;
}

}  // namespace

Complex MeasureSensitivity(const RigParameters& rig, const SineTest& test,
                           const std::atomic<bool>* stop) {
  const OperatingPoint point = FindOperatingPoint(rig);
  const std::size_t bearing = point.BearingOf(test.axis);
  Scenario s;
  s.name = "sensitivity " + point.Axes()[test.axis];
  s.noise = false;
  s.fault_tolerant = false;
  s.speed = SpeedProfile(std::vector<std::vector<double>>{{0.0, test.speed}});
  s.record_rate = rig.controller.rate;
  s.duration = test.settle + test.cycles / test.frequency;
  Excitation e;
  e.target = point.Axes()[test.axis];
  e.port = "force";
  e.kind = "sine";
  e.frequency = test.frequency;
  e.amplitude = test.amplitude;
  e.stop = s.duration + 1;
  s.excitations = {e};
  SimulateOptions options;
  options.stop = stop;
  const RunResult run = Simulate(rig, s, options);
  if (run.touchdown)
    throw InputError(
        fmt::format("a sine of {:g} N at {:g} Hz on {} drives the rotor into an auxiliary bearing, "
                    "allowed: a smaller amplitude",
                    test.amplitude, test.frequency, point.Axes()[test.axis]));
  const Record& record = run.record;
  const std::vector<double> f =
      Commands(record, point, bearing, test.axis - point.FirstAxis(bearing));
  // A row's set-points were computed one tick earlier, from the excitation at that instant.
  const double Ts = 1 / rig.controller.rate, omega = 2 * kPi * test.frequency;
  std::vector<double> t, y;
  for (std::size_t k = 0; k < f.size(); ++k)
    if (const double at = record.TimeAt(k) - Ts; at >= test.settle) {
      t.push_back(at);
      y.push_back(f[k]);
    }
  // amplitude * sin ωt
  return FitSine(t, y, omega, test.speed, Ringing(point, test)) / (test.amplitude * Complex(0, -1));
}

}  // namespace ambrig
