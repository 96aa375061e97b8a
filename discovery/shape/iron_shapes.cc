/// Free shapes of the iron: magnetisation curve, relaxations of eddy currents, operators of
/// hysteresis.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>

#include "core/base/errors.h"
#include "core/math/box_solver.h"
#include "discovery/shape/shape.h"
#include "effects/catalogue.h"
#include "effects/diffusion_fit.h"
#include "effects/law_tables.h"
#include "effects/steel_curve.h"
#include "rig/clearance.h"

namespace ambrig {

namespace {

using Complex = std::complex<double>;

double GapAt(const RigParameters& rig, const std::string& target) {
  const BearingParameters* b = rig.Find(target);
  Require(b != nullptr, "the target of an iron effect is a bearing");
  return GapOf(*b);
}

/// An effect of the shape with its first `skip` rows set already, the others are the sizes.
void AddSizes(Shape& shape, std::size_t skip, const std::vector<double>& sizes) {
  for (std::size_t k = 0; k < sizes.size(); ++k) {
    shape.rows.push_back(skip + k);
    shape.effect.values[skip + k] = sizes[k];
  }
}

/// ∫ path db / mu0 of a path linear between its nodes, constant after the last. [A]
double BhDrop(const std::vector<double>& path, double reach, double B) {
  const double spacing = reach / (kBhNodes - 1);
  double sum = 0;
  for (int k = 0; k < kBhNodes - 1 && B > spacing * k; ++k) {
    const double part = std::min(1.0, B / spacing - k);
    const auto i = static_cast<std::size_t>(k);
    sum += spacing * part * (path[i] + 0.5 * part * (path[i + 1] - path[i]));
  }
  if (B > reach) sum += (B - reach) * path.back();
  return sum / kMu0;
}

/// Incremental path of the iron's MMF at low flux, threshold x/(1 + x) with x = B/0.2 T
/// (effects/iron_reluctance.cc). [m]
double ThresholdPath(const EffectInstance& reluctance, double B) {
  constexpr double kHalf = 0.2;  // [T]
  const double away = 1 + B / kHalf;
  return kMu0 * reluctance.Value("threshold") / (kHalf * away * away);
}

Shape BhShape(const EffectInstance& named, const ShapeReach& reach) {
  Shape s;
  s.effect = MakeInstance(EffectNamed("bh-curve"), named.target);
  s.effect.Set("reach", reach.density);
  std::vector<double> path;
  for (int k = 0; k < kBhNodes; ++k) {
    double at = named.Value("path");
    if (named.name == "saturation") {
      const double knee = named.Value("knee");
      double H, slope;
      SteelCurve(reach.density * k / (kBhNodes - 1) / knee, &H, &slope);
      at *= kMu0 * slope / knee;
    }
    if (named.name == "iron-reluctance")
      at += ThresholdPath(named, reach.density * k / (kBhNodes - 1));
    path.push_back(at);
    s.knots.push_back(reach.density * k / (kBhNodes - 1));
  }
  AddSizes(s, 1, path);
  double mean = 0;
  for (const double p : path) mean += p / kBhNodes;
  s.step = Eigen::VectorXd::Constant(kBhNodes, std::max(0.3 * mean, 1e-7));
  s.roughness = Differences(kBhNodes, 2);
  s.u_name = "flux density of the pole";
  s.u_unit = "T";
  s.value_name = "MMF of the iron per gap";
  s.value_unit = "A";
  s.u = CurvePlaces(reach.density);
  s.value = [reach = reach.density](const std::vector<double>& c, double u) {
    return BhDrop(c, reach, u);
  };
  return s;
}

Complex Relaxation(int k, double f) {
  const Complex s(0, f);
  return s / (s + RelaxationFrequency(k));
}

/// Sizes of the relaxations that come nearest to a law of frequency, relative error.
std::vector<double> NearestRelaxations(const std::function<Complex(double)>& law) {
  Eigen::MatrixXd A = 1e-12 * Eigen::MatrixXd::Identity(kRelaxations, kRelaxations);
  Eigen::VectorXd b = Eigen::VectorXd::Zero(kRelaxations);
  for (double f = 20; f < 4e5; f *= 1.1) {
    const Complex wanted = law(f);
    if (std::abs(wanted) == 0) continue;
    Eigen::VectorXcd row(kRelaxations);
    for (int k = 0; k < kRelaxations; ++k) row(k) = Relaxation(k, f) / wanted;
    A += (row.conjugate() * row.transpose()).real();
    b += row.real();
  }
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(kRelaxations);
  const Eigen::VectorXd x =
      SolveInBox(A, b, none, Eigen::VectorXd::Constant(kRelaxations, kInfinity));
  return {x.data(), x.data() + x.size()};
}

Shape EddyShape(const EffectInstance& named, const RigParameters& rig) {
  Shape s;
  s.effect = MakeInstance(EffectNamed("eddy-impedance"), named.target);
  const double gap = GapAt(rig, named.target), cutoff = named.Value("cutoff"),
               rho = named.Value("path") / gap;
  std::vector<double> sizes =
      NearestRelaxations([&](double f) { return Diffusion(Complex(0, 2 * kPi * f), cutoff, rho); });
  sizes.insert(sizes.begin(), 0.0);  // path
  AddSizes(s, 0, sizes);
  const auto n = static_cast<Eigen::Index>(sizes.size());
  s.step = Eigen::VectorXd(n);
  s.step(0) = 0.05 * gap;
  s.knots.push_back(std::nan(""));
  // the half order has sizes that grow with the root of the frequency: the same number of steps
  // each
  for (int k = 0; k < kRelaxations; ++k) {
    s.step(k + 1) = 0.3 * std::sqrt(RelaxationFrequency(k) / cutoff);
    s.knots.push_back(RelaxationFrequency(k));
  }
  // the last one stands for everything above it
  s.roughness = Eigen::MatrixXd::Zero(kRelaxations - 3, n);
  s.roughness.middleCols(1, kRelaxations - 1) = Differences(kRelaxations - 1, 2);
  s.u_name = "frequency";
  s.u_unit = "Hz";
  s.value_name = "MMF of the iron over that of the gap";
  s.value_unit = "-";
  s.logarithmic = true;
  for (int k = 0; k < kCurvePoints; ++k)
    s.u.push_back(10 * std::pow(3e4, k / (kCurvePoints - 1.0)));
  s.value = [gap](const std::vector<double>& c, double f) {
    Complex sum = c[0] / gap;
    for (int k = 0; k < kRelaxations; ++k)
      sum += c[static_cast<std::size_t>(k) + 1] * Relaxation(k, f);
    return std::abs(sum);
  };
  return s;
}

Shape HysteresisShape(const EffectInstance& named, const ShapeReach& reach) {
  constexpr double kOfWidestLoop =
      3;  // times the law's: how far the operators reach, if any flux does
  Shape s;
  s.effect = MakeInstance(EffectNamed("play-hysteresis"), named.target);
  const double of_law = named.Value("width"),
               width = std::min(reach.density, kOfWidestLoop * of_law),
               coercive = named.Value("coercive");
  s.effect.Set("width", width);
  std::vector<double> sizes;
  s.step = Eigen::VectorXd(kPlayOperators);
  for (int k = 1; k <= kPlayOperators; ++k) {
    const double r = width * PlayRadius(k), below = width * PlayRadius(k - 1);
    s.knots.push_back(r);
    // the law's radii are evenly spread up to its width
    sizes.push_back(std::min(r, of_law) - std::min(below, of_law));
    s.step(k - 1) = std::max(0.3 * coercive * std::sqrt(PlayRadius(k) - PlayRadius(k - 1)), 1e-6);
  }
  const double sum = std::min(width, of_law);
  for (double& c : sizes) c *= coercive / sum;
  AddSizes(s, 1, sizes);
  s.roughness = Differences(kPlayOperators, 1);
  s.u_name = "flux density after leaving the virgin state";
  s.u_unit = "T";
  s.value_name = "branch, as current of one coil";
  s.value_unit = "A";
  s.u = CurvePlaces(width);
  s.value = [width](const std::vector<double>& c, double u) {
    double value = 0;
    for (int k = 1; k <= kPlayOperators; ++k)
      value += c[static_cast<std::size_t>(k) - 1] * std::min(1.0, u / (width * PlayRadius(k)));
    return value;
  };
  return s;
}

}  // namespace

double SaturatingShare(const std::vector<double>& path) {
  const auto least = std::min_element(path.begin(), path.end());
  double all = 0, rise = 0;
  for (auto p = path.begin(); p != path.end(); ++p) {
    all += *p;
    if (p > least) rise += *p - *least;
  }
  return all > 0 ? rise / all : 0;
}

Shape IronShape(const EffectInstance& named, const RigParameters& rig, const ShapeReach& reach) {
  if (named.name == "eddy-currents") return EddyShape(named, rig);
  if (reach.density <= 0)
    throw InputError(
        fmt::format("{} at {}: no record of this case drives flux through this "
                    "bearing's iron, allowed: a case whose records do",
                    named.name, named.target));
  return named.name == "hysteresis" ? HysteresisShape(named, reach) : BhShape(named, reach);
}

}  // namespace ambrig
