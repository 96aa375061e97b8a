#include "faulttolerance/redistribution/bearing_symmetry.h"

#include <algorithm>
#include <cmath>

namespace ambrig {
namespace {

Eigen::Vector2d Direction(double angle) { return {std::cos(angle), std::sin(angle)}; }

bool Fits(const RedistributionProblem& p, const BearingSymmetry& g) {
  for (int j = 0; j < 8; ++j) {
    if ((g.R * Direction(p.angle[j]) - Direction(p.angle[g.to[j]])).norm() > 1e-9) return false;
    if (p.sign[g.to[j]] * p.sign[g.to[0]] != p.sign[j] * p.sign[0]) return false;
  }
  return true;
}

}  // namespace

std::vector<BearingSymmetry> FindSymmetries(const RedistributionProblem& p) {
  std::vector<BearingSymmetry> found;
  for (int step : {1, -1})
    for (int first = 0; first < 8; ++first) {
      BearingSymmetry g;
      for (int j = 0; j < 8; ++j) g.to[j] = (first + step * j + 8) % 8;
      const double c = std::cos(p.angle[first] - step * p.angle[0]);
      const double s = std::sin(p.angle[first] - step * p.angle[0]);
      g.R << c, -s * step, s, c * step;  // rotation by angle_first - angle_0, or reflection
      if (Fits(p, g)) found.push_back(g);
    }
  return found;
}

CoilVector Mapped(const BearingSymmetry& g, const CoilVector& per_coil) {
  CoilVector image;
  for (int j = 0; j < 8; ++j) image[g.to[j]] = per_coil[j];
  return image;
}

DistributionMatrix Mapped(const BearingSymmetry& g, const DistributionMatrix& W) {
  DistributionMatrix image;
  for (int j = 0; j < 8; ++j) {
    image(g.to[j], 0) = W(j, 0);
    image.row(g.to[j]).tail<2>() = (g.R * W.row(j).tail<2>().transpose()).transpose();
  }
  return image;
}

DistributionMatrix MappedBack(const BearingSymmetry& g, const DistributionMatrix& W) {
  DistributionMatrix image;
  for (int j = 0; j < 8; ++j) {
    image(j, 0) = W(g.to[j], 0);
    image.row(j).tail<2>() = (g.R.transpose() * W.row(g.to[j]).tail<2>().transpose()).transpose();
  }
  return image;
}

const BearingSymmetry& ToCanonical(const std::vector<BearingSymmetry>& symmetries,
                                   const CoilVector& per_coil) {
  const auto before = [&](const BearingSymmetry& a, const BearingSymmetry& b) {
    const CoilVector x = Mapped(a, per_coil), y = Mapped(b, per_coil);
    return std::lexicographical_compare(x.begin(), x.end(), y.begin(), y.end());
  };
  return *std::min_element(symmetries.begin(), symmetries.end(), before);
}

}  // namespace ambrig
