// Records with imposed currents: measured currents in gaps that follow the measured positions move
// the rotor, circuits and controller play no part. The data come from levitated runs under the
// controller.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/math/constants.h"
#include "core/record/channels.h"
#include "discovery/model/record_traits.h"
#include "simulation/switching/switching_engine.h"
#include "tests/discovery/model/imposed_case.h"

namespace ambrig {
namespace {

class ImposedCurrents : public ImposedCase {
 protected:
  /// Currents of the levitated records are imposed.
  void SetUp() override {
    data_ = hidden_->data;
    std::erase_if(data_.records, [](const CaseRecord& r) {
      return r.scenario.start == StartState::kClamped || !r.data.Find("A.i1");
    });
    for (CaseRecord& r : data_.records) r.imposed = Imposed::kCurrents;
    ASSERT_FALSE(data_.records.empty());
  }
};

TEST_F(ImposedCurrents, OnlyReadingsArePredicted) {
  for (const CaseRecord& r : data_.records)
    for (const Channel& c : r.data.channels)
      EXPECT_EQ(IsPredicted(r, c.name), IsOfKind(c.name, ChannelKind::kReading)) << c.name;
}

TEST_F(ImposedCurrents, TheTrueRotorLeavesNothingButNoise) {
  const double ratio = ErrorOverFloor(data_);
  EXPECT_GT(ratio, 0.8);
  EXPECT_LT(ratio, 1.3);
}

TEST_F(ImposedCurrents, AWrongRotorShows) {
  const double right = ErrorOverFloor(data_);
  ASSERT_TRUE(SetParameter(data_.rig, "rotor.mass", 1.1 * data_.rig.rotor.mass));
  EXPECT_GT(ErrorOverFloor(data_), 3 * right);
}

TEST_F(ImposedCurrents, WrongCircuitsAndControllersPlayNoPart) {
  const double right = ErrorOverFloor(data_);
  ASSERT_TRUE(SetParameter(data_.rig, "bearings.A.leakage_inductance", 1e-3));
  ASSERT_TRUE(SetParameter(data_.rig, "bearings.A.resistance", 3));
  data_.rig.controller.pid.kp *= 0.5;
  EXPECT_NEAR(ErrorOverFloor(data_), right, 1e-6 * right);
}

// A constant force that the model does not know, at z_F from the mass centre: at rest e = F/(m ω²)
// in the mass centre and a tilt F z_F/(I ω²), which a sensor at z_s reads as F z_F z_s/(I ω²) more.
TEST_F(ImposedCurrents, AConstantForceIsTheObserversOffset) {
  const CaseRecord& r = data_.records.front();
  const RigParameters& rig = data_.rig;
  const Record driving = DrivingRecord(rig, r);
  const auto reading = [&](double extra) {
    Scenario s = r.scenario;
    s.noise = false;
    s.loads.clear();
    LoadSpec load;
    load.fy = extra;
    load.z = 0.5 * (rig.bearings[0].z + rig.bearings[1].z);
    load.start = 0;
    load.stop = 1e9;
    s.loads.push_back(load);
    EngineOptions o;
    o.watch = false;
    o.forced = &driving;
    o.observer = 40;
    return SwitchingEngine(rig, s, o).Run().record.Find("A.y")->samples.back();
  };
  const double omega = 2 * kPi * 40;
  const double force = 2, z_force = 0.5 * (rig.bearings[0].z + rig.bearings[1].z),
               z_sensor = rig.bearings[0].sensor.z;
  const double offset = force *
                        (1 / rig.rotor.mass + z_force * z_sensor / rig.rotor.inertia_transverse) /
                        (omega * omega);
  EXPECT_GT(std::abs(offset * rig.rotor.mass * omega * omega / force - 1), 0.05);  // it tilts
  EXPECT_NEAR(reading(force) - reading(0), offset, 0.005 * offset);
}

}  // namespace
}  // namespace ambrig
