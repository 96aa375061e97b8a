// The circuit of any stator in lanes against the network itself and a dense solution of its
// equations.
#include "actuators/magnetics/network_lanes.h"

#include <gtest/gtest.h>

#include "core/math/noise.h"
#include "tests/actuators/magnetics/template_stator.h"

namespace ambrig {
namespace {

constexpr double kAtX = 3e-5, kAtY = -5e-5;  // [m]

std::shared_ptr<const PoleNetwork> Network(const std::string& pattern, int poles = 0) {
  StatorParameters p = testing::TemplateStator(pattern, {90, 2e-4, 4e-4, 1e-3}, poles);
  if (pattern == "homopolar-pm") p.bias = {900, 8e-3, 6e-4, 1.05};
  return NetworkOf(p);
}

std::vector<std::shared_ptr<const PoleNetwork>> Networks() {
  return {Network("series-pairs", 8), Network("series-pairs", 16), Network("one-coil-per-pole", 6),
          Network("one-coil-per-pole", 8), Network("homopolar-pm")};
}

Lane Drawn(int coils, double size, std::uint32_t stream) {
  Lane out;
  for (int j = 0; j < coils; ++j)
    out[j] = size * (1 + 0.3 * Normal(7, stream, static_cast<std::uint64_t>(j)));
  return out;
}

Eigen::VectorXd CurrentOf(const PoleNetwork& n, const Lane& ampere_turns) {
  Eigen::VectorXd out(n.coils());
  for (int j = 0; j < n.coils(); ++j) out[j] = ampere_turns[j] / n.TurnsOf(j);
  return out;
}

TEST(NetworkLanes, FluxAndPullAreThoseOfTheNetwork) {
  for (const auto& n : Networks()) {
    const Lane m = Drawn(n->coils(), 300, 1);
    const NetworkPlace place = PlaceOf(*n, kAtX, kAtY);
    const Eigen::VectorXd i = CurrentOf(*n, m);
    const Eigen::Vector3d force = n->Force({kAtX, kAtY, 0}, i);
    EXPECT_LT((PullUnder(place, m) - force.head<2>()).norm(), 1e-12 * force.norm());
    const WindingMatrix linkage = n->Linkage(n->FluxAt({kAtX, kAtY, 0}).phi);
    const Eigen::VectorXd total = linkage.leftCols(n->coils()) * i + linkage.col(n->coils());
    const Lane flux = FluxUnder(place, m);
    for (int j = 0; j < n->coils(); ++j)
      EXPECT_NEAR(flux[j] * n->TurnsOf(j), total[j], 1e-12 * total.cwiseAbs().maxCoeff());
  }
}

// λ = T φ + L i of every driven coil, one that carries nothing, one beside it with a stiffer
// source.
TEST(NetworkLanes, SourcesGiveTheDenseSolution) {
  for (const auto& n : Networks()) {
    const int coils = n->coils();
    const NetworkPlace place = PlaceOf(*n, kAtX, kAtY);
    Lane source = Drawn(coils, 4000, 2), own = Drawn(coils, 3e8, 3);
    source[1] = own[1] = 0;
    own[2] *= 20, source[2] *= 20;
    Eigen::MatrixXd A = Eigen::MatrixXd::Identity(coils, coils);
    Eigen::VectorXd b(coils);
    for (int j = 0; j < coils; ++j) {
      b[j] = place.magnets.turn[j];
      for (int c = 0; c < coils; ++c) {
        A(j, c) += place.column[c].turn[j] * own[c];
        b[j] += place.column[c].turn[j] * source[c];
      }
    }
    const Eigen::VectorXd dense = A.fullPivLu().solve(b);
    const Lane flux = FluxOfSources(place, source, own);
    for (int j = 0; j < coils; ++j)
      EXPECT_NEAR(flux[j], dense[j], 1e-11 * dense.cwiseAbs().maxCoeff()) << coils << " " << j;
    // and what the sources then drive makes that flux
    Lane m;
    for (int j = 0; j < coils; ++j) m[j] = source[j] - own[j] * flux[j];
    const Lane again = FluxUnder(place, m);
    for (int j = 0; j < coils; ++j)
      EXPECT_NEAR(again[j], flux[j], 1e-9 * dense.cwiseAbs().maxCoeff());
    for (int j = coils; j < kLanes; ++j) EXPECT_EQ(flux[j], 0);
  }
}

TEST(NetworkLanes, RunsLinearlyBetweenTwoPlaces) {
  const auto n = Network("homopolar-pm");
  const NetworkPlace a = PlaceOf(*n, 0, 0), b = PlaceOf(*n, kAtX, kAtY);
  NetworkPlace between = a;
  PlaceBetween(a, b, 0.25, &between);
  const Lane m = Drawn(n->coils(), 300, 4);
  const Lane flux = FluxUnder(between, m), at_a = FluxUnder(a, m), at_b = FluxUnder(b, m);
  for (int j = 0; j < n->coils(); ++j) EXPECT_NEAR(flux[j], 0.75 * at_a[j] + 0.25 * at_b[j], 1e-14);
  EXPECT_EQ(between.pull_x[0][0], a.pull_x[0][0]);
}

}  // namespace
}  // namespace ambrig
