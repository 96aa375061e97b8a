#include "control/synthesis/h_infinity.h"

#include <fmt/format.h>

#include <cmath>
#include <deque>
#include <mutex>
#include <optional>

#include "control/synthesis/slicot.h"
#include "core/math/linear_equations.h"

namespace ambrig {

namespace {

using Eigen::MatrixXd;

// of the bandwidth: the weight's pole, instead of a true integrator (nearer ones spoil the Riccati
// equations)
constexpr double kIntegratorShare = 1e-3;
constexpr double kLargestGamma = 1e9;
constexpr int kBisections = 12;  // least gamma within 4^(2^-12) - 1 = 3e-4

/// Gain of the closed loop at rest: there the weight is largest and the equations are hardest.
double NormAtRest(const StateSpace& P, const StateSpace& K) {
  const Eigen::Index u = K.outputs(), y = K.inputs(), w = P.inputs() - u, z = P.outputs() - y;
  const MatrixXd G = P.Response(1.0).real(), k = K.Response(1.0).real();
  const MatrixXd loop = InverseOf(MatrixXd::Identity(y, y) - G.bottomRightCorner(y, u) * k);
  const MatrixXd T =
      G.topLeftCorner(z, w) + G.topRightCorner(z, u) * k * loop * G.bottomLeftCorner(y, w);
  return T.allFinite() ? Eigen::JacobiSVD<MatrixXd>(T).singularValues()(0) : kInfinity;
}

/// W per axis: (1/y_w)(s + w_b)/(s + w_b/1e3), sampled.
StateSpace Weight(const HInfinityParameters& p, Eigen::Index axes, double Ts) {
  const StateSpace one =
      Bilinear(FromTransferFunction({1 / p.position_weight, p.bandwidth / p.position_weight},
                                    {1, p.bandwidth * kIntegratorShare}),
               Ts);
  // The state in units of the output: the weight is huge at rest.
  StateSpace scaled = one;
  const double unit = std::abs(one.B(0, 0));
  scaled.B /= unit;
  scaled.C *= unit;
  return Append(std::vector<StateSpace>(static_cast<std::size_t>(axes), scaled));
}

}  // namespace

StateSpace HInfinityPlant(const SampledPlant& plant, const HInfinityParameters& w) {
  const Eigen::Index n = plant.A.rows(), p = plant.axes(), e = plant.E.cols(), g = plant.G.cols(),
                     v = plant.V.rows(), d = e + g;
  const StateSpace weight = Weight(w, p, plant.Ts);
  const Eigen::Index m = weight.states();
  // In units of the weights: readings per sensor_noise, forces per force_weight.
  StateSpace s;
  s.A = MatrixXd::Zero(n + m, n + m);
  s.A.topLeftCorner(n, n) = plant.A;
  s.A.bottomLeftCorner(m, n) = weight.B * plant.C;
  s.A.bottomRightCorner(m, m) = weight.A;
  s.B = MatrixXd::Zero(n + m, d + 2 * p);
  s.B.topLeftCorner(n, e) = w.force_noise * plant.E;
  if (g > 0) s.B.block(0, e, n, g) = plant.G;
  s.B.topRightCorner(n, p) = w.force_weight * plant.B;
  s.C = MatrixXd::Zero(3 * p + v, n + m);
  s.C.topLeftCorner(p, n) = weight.D * plant.C;
  s.C.topRightCorner(p, m) = weight.C;
  if (v > 0) s.C.block(2 * p, 0, v, n) = plant.V;
  s.C.bottomLeftCorner(p, n) = plant.C / w.sensor_noise;
  s.D = MatrixXd::Zero(3 * p + v, d + 2 * p);
  s.D.block(p, d + p, p, p).setIdentity();
  s.D.block(2 * p + v, d, p, p).setIdentity();
  return s;
}

namespace {

/// The last designs: every run of a study's point or of a campaign asks for the same controller,
/// and a bisection of Riccati equations takes longer than many a run. What a design is made of is
/// its key, bit by bit.
class Remembered {
 public:
  static std::string Key(const StateSpace& P, const HInfinityParameters& w) {
    std::string key(reinterpret_cast<const char*>(&w), sizeof w);
    for (const MatrixXd* m : {&P.A, &P.B, &P.C, &P.D})
      key.append(reinterpret_cast<const char*>(m->data()),
                 static_cast<std::size_t>(m->size()) * sizeof(double));
    return key;
  }
  std::optional<HInfinityDesign> Find(const std::string& key) {
    const std::scoped_lock lock(mutex_);
    for (const auto& [known, design] : designs_)
      if (known == key) return design;
    return {};
  }
  void Add(const std::string& key, const HInfinityDesign& design) {
    const std::scoped_lock lock(mutex_);
    designs_.emplace_back(key, design);
    if (designs_.size() > kMost) designs_.pop_front();
  }

 private:
  static constexpr std::size_t kMost = 64;
  std::mutex mutex_;
  std::deque<std::pair<std::string, HInfinityDesign>> designs_;
};

HInfinityDesign Design(const SampledPlant& plant, const StateSpace& P, const HInfinityParameters& w,
                       const std::string& where) {
  const int axes = static_cast<int>(plant.axes());
  StateSpace found;
  const auto try_gamma = [&](double gamma) {
    HInfinityOutcome out = DiscreteHInfinity(P, axes, axes, gamma);
    if (!out.usable || NormAtRest(P, out.controller) > 1.001 * gamma) return false;
    StateSpace k = out.controller;
    k.B /= w.sensor_noise;
    k.D *= w.force_weight / w.sensor_noise;
    k.C *= w.force_weight;
    if (!(SpectralRadius(LoopMatrix(plant.FromForce(), k)) < 1)) return false;
    found = k;
    return true;
  };
  double high = 1;
  while (high < kLargestGamma && !try_gamma(high)) high *= 4;
  if (high >= kLargestGamma)
    throw InputError(
        fmt::format("{}: no H-infinity controller with these weights below gamma = {:g}; allowed: "
                    "axes that magnets and "
                    "sensors of the rig can hold, weights near its sizes",
                    where, kLargestGamma));
  double low = high / 4;
  while (low > 1e-9 && try_gamma(low)) {
    high = low;
    low /= 4;
  }
  for (int k = 0; k < kBisections; ++k) {
    const double middle = std::sqrt(low * high);
    (try_gamma(middle) ? high : low) = middle;
  }
  HInfinityDesign design;
  design.least_gamma = high;
  design.gamma = high * w.slack;
  if (!try_gamma(design.gamma)) {  // numerically next to the limit
    design.gamma = high;
    Require(try_gamma(high), "a gamma that was found");
  }
  design.controller = found;
  return design;
}

}  // namespace

HInfinityDesign DesignHInfinity(const SampledPlant& plant, const HInfinityParameters& w,
                                const std::string& where) {
  static Remembered remembered;
  const StateSpace P = HInfinityPlant(plant, w);
  const std::string key = Remembered::Key(P, w);
  if (const auto known = remembered.Find(key)) return *known;
  const HInfinityDesign design = Design(plant, P, w, where);
  remembered.Add(key, design);
  return design;
}

}  // namespace ambrig
