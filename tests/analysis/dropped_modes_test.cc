// The residual compliance of the bending modes that a run drops.
#include "analysis/dropped_modes.h"

#include <gtest/gtest.h>

#include "core/math/constants.h"
#include "rig/rig_file.h"
#include "rotor/shaft/reduction.h"

namespace ambrig {
namespace {

RigParameters BeamRig() { return ReadRig(AMBRIG_SOURCE_DIR "/examples/tum_mbtr/rig.toml"); }

TEST(DroppedModes, KeptAndLostAreTheWholeBending) {
  const RigParameters rig = BeamRig();
  const auto m = FindDroppedModes(rig);
  ASSERT_TRUE(m);
  EXPECT_EQ(m->kept, static_cast<int>(rig.modes.size()));
  EXPECT_GT(m->dropped, 0);
  EXPECT_NEAR(m->top, rig.modes.back().omega / (2 * kPi), 1e-9);
  EXPECT_GT(m->frequency.front(), m->top);
  // Inertia relief: K u = f - M R (R'MR)^-1 R'f of the free beam, without what is rigid in u.
  const BeamRotor beam = BuildBeam(rig.beam->definition);
  Eigen::MatrixXd rigid = Eigen::MatrixXd::Zero(beam.M.rows(), 2);
  for (std::size_t i = 0; i < beam.z.size(); ++i) {
    const auto at = 2 * static_cast<Eigen::Index>(i);
    rigid(at, 0) = rigid(at + 1, 1) = 1;
    rigid(at, 1) = beam.z[i];
  }
  const Eigen::MatrixXd project =
      Eigen::MatrixXd::Identity(beam.M.rows(), beam.M.rows()) -
      rigid * (rigid.transpose() * beam.M * rigid).inverse() * rigid.transpose() * beam.M;
  for (std::size_t k = 0; k < m->bearings.size(); ++k) {
    const BearingParameters* b = rig.Find(m->bearings[k].bearing);
    const Eigen::VectorXd at = ShaftRows(beam, b->z + rig.z_origin).row(0).transpose();
    const Eigen::VectorXd read = ShaftRows(beam, b->sensor.z + rig.z_origin).row(0).transpose();
    Eigen::VectorXd f(beam.M.rows()), s(beam.M.rows());
    for (Eigen::Index i = 0; i < f.size() / 2; ++i) {  // (x, beta) of all dofs
      f(2 * i) = at(4 * i), f(2 * i + 1) = at(4 * i + 3);
      s(2 * i) = read(4 * i), s(2 * i + 1) = read(4 * i + 3);
    }
    const Eigen::VectorXd u =
        project * beam.K.completeOrthogonalDecomposition().solve(project.transpose() * f);
    EXPECT_NEAR((m->bearings[k].kept + m->bearings[k].lost) / s.dot(u), 1, 1e-6);
    EXPECT_LT(std::abs(m->bearings[k].lost), std::abs(m->bearings[k].kept));
  }
}

TEST(DroppedModes, FewerModesLoseMore) {
  RigParameters rig = BeamRig();
  double before = 0;
  while (rig.modes.size() > 1) {
    const double lost = FindDroppedModes(rig)->bearings.front().lost;
    EXPECT_GE(std::abs(lost), before);
    before = std::abs(lost);
    rig.modes.pop_back();
  }
}

TEST(DroppedModes, RigidRotorsHaveNone) {
  EXPECT_FALSE(FindDroppedModes(ReadRig(AMBRIG_SOURCE_DIR "/examples/reference/rig.toml")));
}

}  // namespace
}  // namespace ambrig
