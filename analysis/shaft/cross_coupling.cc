#include "analysis/shaft/cross_coupling.h"

#include <cmath>

namespace ambrig {

namespace {

/// The first forward mode over q, each time the one that is most like the one before.
class ForwardMode {
 public:
  ForwardMode(const BeamRotor& beam, double speed, int modes, double z)
      : rotor_(Assemble(beam, speed)), rows_(ShaftRows(beam, z)), speed_(speed), modes_(modes) {
    const Eigen::MatrixXd at = SupportColumns(beam);
    Eigen::MatrixXd forces(at.rows(), at.cols() + 2);
    forces << at, rows_.transpose();
    shapes_ = ShapesOf(rotor_, 3 * modes + 8, forces);
    turn_ << 0, 1, -1, 0;
  }

  /// A little coupling tells the two whirls of one frequency apart, which at 0 may be any mixture.
  bool Start(double q) {
    for (const WhirlMode& m : Modes(q))
      if (m.sense() == Whirl::kForward) return last_ = m, true;
    return false;
  }

  const WhirlMode& At(double q) {
    double best = -1;
    WhirlMode found = last_;
    for (const WhirlMode& m : Modes(q)) {
      const double like = std::norm(m.shape.dot(last_.shape)) /
                              (m.shape.squaredNorm() * last_.shape.squaredNorm()) -
                          std::abs(m.s - last_.s) / std::abs(last_.s);
      if (like > best) best = like, found = m;
    }
    return last_ = found;
  }

 private:
  std::vector<WhirlMode> Modes(double q) const {
    LinearRotor r = rotor_;
    r.K += q * rows_.transpose() * turn_ * rows_;
    return FindWhirlModes(r, shapes_, speed_, modes_).oscillatory;
  }

  LinearRotor rotor_;
  Eigen::MatrixXd rows_, shapes_;
  Eigen::Matrix2d turn_;
  double speed_;
  int modes_;
  WhirlMode last_;
};

/// Between a q with a positive and one with a negative log decrement.
double Root(ForwardMode& mode, double low, double high) {
  for (int k = 0; k < 50 && high - low > 1e-9 * high; ++k) {
    const double middle = 0.5 * (low + high);
    (mode.At(middle).log_decrement > 0 ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace

double AlfordCoupling(double power, double speed, double diameter, double width,
                      double density_ratio) {
  return 3 * power / speed / (diameter * width) * density_ratio;
}

Level1 AssessCoupling(const BeamRotor& beam, double speed, int modes, const CrossCoupling& given) {
  Level1 out;
  out.given = given;
  out.speed = speed;
  ForwardMode mode(beam, speed, modes, given.z);
  const double least = 1e-2 * given.expected;
  out.found = mode.Start(least);
  if (!out.found) return out;
  out.frequency = mode.At(least).omega_d;
  double before = 0;
  out.limit = kInfinity;
  for (int k = 0; k <= 40; ++k) {  // a quarter of Q_A a step, then growing
    const double q =
        k == 0 ? least
               : given.expected * (k <= 20 ? 0.25 * k : 5 * std::pow(200.0, (k - 20) / 20.0));
    const double decrement = mode.At(q).log_decrement;
    out.q.push_back(q);
    out.log_decrement.push_back(decrement);
    if (k == 4) out.at_expected = decrement;
    if (decrement <= 0) {
      out.limit = k == 0 ? 0 : Root(mode, before, q);
      if (k < 4) out.at_expected = mode.At(given.expected).log_decrement;
      break;
    }
    before = q;
  }
  return out;
}

}  // namespace ambrig
