// What each kind of fault does to a plant, and that it does nothing else.
#include <gmock/gmock.h>

#include <cmath>

#include "core/base/errors.h"
#include "scenarios/faults/fault_file.h"
#include "scenarios/faults/faulted_plant.h"
#include "tests/actuators/magnetics/reference_lanes.h"

namespace ambrig {
namespace {

using ::testing::HasSubstr;

/// A plant that writes down what is done to its coil.
class Watched : public FaultedPlant {
 public:
  Watched(Plant& plant, const FaultPlace& place) : FaultedPlant(plant, place, 30) {}
  double Current() const override { return 1.75; }
  void BreakCoil() override { ++broken; }
  void ShortTurns(double fraction, double resistance) override {
    shorted = fraction;
    closed_by = resistance;
  }
  int broken = 0;
  double shorted = 0, closed_by = 0;
};

class FaultEffect : public ::testing::Test {
 protected:
  static FaultSpec Spec(const std::string& kind, const std::string& target,
                        std::map<std::string, double> parameters = {}) {
    FaultSpec f;
    f.kind = kind;
    f.target = target;
    f.parameters = std::move(parameters);
    return f;
  }
  Watched Apply(const FaultSpec& f) {
    Watched w(plant_, PlaceOf(f, ReferenceLanesRig()));
    FaultByKind(f.kind).apply(f, w);
    return w;
  }
  BearingPlant& B() { return plant_.bearings[1]; }
  Plant plant_ = BuildPlant(TrueRig(ReferenceLanesRig()));
};

TEST_F(FaultEffect, PlacesAreCoilsAndSidesOfBearings) {
  const RigParameters& rig = ReferenceLanesRig();
  const auto place = [&](const char* target) { return PlaceOf(Spec("open", target), rig); };
  EXPECT_EQ(place("A.coil1").coil, 0);
  EXPECT_EQ(place("B.coil8").bearing, 1u);
  EXPECT_EQ(place("B.coil8").coil, 7);
  EXPECT_EQ(place("Z.coil4").bearing, 2u);
  EXPECT_EQ(place("B.y").side, 1);
  EXPECT_EQ(place("B.y").coil, -1);
  EXPECT_EQ(place("z").bearing, 2u);
  EXPECT_EQ(place("z").side, 0);
  EXPECT_EQ(place("rig").side, -1);
}

TEST_F(FaultEffect, AnOpenCoilIsBrokenAndNothingElse) {
  const Watched w = Apply(Spec("open", "B.coil3"));
  EXPECT_EQ(w.broken, 1);
  EXPECT_EQ(w.shorted, 0);
  EXPECT_FALSE(w.bridge_changed() || w.sensor_changed() || w.bus_changed());
}

TEST_F(FaultEffect, AShortTakesTurnsAndMayCloseAWinding) {
  const FaultSpec bypassed = Spec("partial-short", "B.coil3", {{"fraction", 0.25}}),
                  closed = Spec("partial-short", "B.coil3",
                                {{"fraction", 0.5}, {"short_resistance", 0.1}});
  EXPECT_EQ(Apply(bypassed).shorted, 0.25);
  EXPECT_TRUE(std::isinf(Apply(bypassed).closed_by));
  EXPECT_EQ(Apply(closed).closed_by, 0.1);
  const Fault& kind = FaultByKind("partial-short");
  EXPECT_FALSE(kind.adds_winding(bypassed));
  EXPECT_TRUE(kind.adds_winding(closed));
  EXPECT_EQ(kind.turns_left(closed), 0.5);
}

TEST_F(FaultEffect, BridgesFailInTheirOwnCoil) {
  EXPECT_TRUE(Apply(Spec("amplifier-off", "B.coil3")).bridge_changed());
  EXPECT_TRUE(Apply(Spec("switch-stuck-on", "B.coil4")).bridge_changed());
  for (std::size_t j = 0; j < 8; ++j) {
    EXPECT_EQ(B().bridge[j].off, j == 2);
    EXPECT_EQ(B().bridge[j].stuck_on, j == 3);
    EXPECT_FALSE(plant_.bearings[0].bridge[j].off);
  }
}

// Two faults of one sensor add up: gains multiply, offsets add, a stuck reading is today's current.
TEST_F(FaultEffect, CurrentSensorsKeepWhatWasWrongBefore) {
  const Watched w = Apply(Spec("current-sensor", "B.coil2", {{"gain", 1.5}, {"offset", 0.1}}));
  EXPECT_TRUE(w.sensor_changed());
  EXPECT_FALSE(w.bridge_changed());
  Apply(Spec("current-sensor", "B.coil2", {{"gain", 2}, {"offset", 0.2}}));
  const CurrentSensor& s = B().current_sensor[1];
  EXPECT_DOUBLE_EQ(s.gain, 3);
  EXPECT_DOUBLE_EQ(s.offset, 0.3);
  EXPECT_FALSE(s.stuck);
  Apply(Spec("current-sensor", "B.coil2", {{"stuck", 1}}));
  EXPECT_TRUE(s.stuck);
  EXPECT_EQ(s.stuck_at, 1.75);
  EXPECT_EQ(B().current_sensor[0].gain, 1);
}

TEST_F(FaultEffect, PositionSensorsOfOneAxis) {
  Apply(Spec("position-sensor", "B.y", {{"offset", 2e-5}}));
  Apply(Spec("position-sensor", "B.y", {{"offset", 1e-5}}));
  EXPECT_DOUBLE_EQ(B().sensor.fault[1].Apply(4e-5), 7e-5);
  EXPECT_DOUBLE_EQ(B().sensor.fault[0].Apply(4e-5), 4e-5);
  Apply(Spec("position-sensor", "B.y", {{"lost", 1}}));
  EXPECT_EQ(B().sensor.fault[1].Apply(4e-5), 0);
}

TEST_F(FaultEffect, TheBusSagsAndComesBack) {
  const Watched deep = Apply(Spec("bus-sag", "rig", {{"voltage", 12}, {"duration", 0.01}}));
  EXPECT_TRUE(deep.bus_changed());
  EXPECT_EQ(plant_.bus.source, 12);
  EXPECT_EQ(plant_.bus.voltage, 12);
  const Fault& kind = FaultByKind("bus-sag");
  EXPECT_EQ(kind.duration(Spec("bus-sag", "rig", {{"duration", 0.01}})), 0.01);
  EXPECT_TRUE(std::isinf(kind.duration(Spec("bus-sag", "rig"))));
  Watched end(plant_, {});
  kind.end(end);
  EXPECT_EQ(plant_.bus.source, 30);
  Apply(Spec("bus-sag", "rig"));
  EXPECT_DOUBLE_EQ(plant_.bus.source, 24);  // 0.8 of the nominal one
}

// A supply with an impedance follows by itself: only its source changes at once.
TEST_F(FaultEffect, ASoftBusFollowsItsSource) {
  plant_.bus.resistance = 0.1;
  plant_.bus.capacitance = 1e-3;
  Apply(Spec("bus-sag", "rig", {{"voltage", 12}}));
  EXPECT_EQ(plant_.bus.source, 12);
  EXPECT_EQ(plant_.bus.voltage, 30);
}

TEST_F(FaultEffect, APartThatIsNotThereIsTheCallersMistake) {
  Watched w(plant_, PlaceOf(Spec("open", "rig"), ReferenceLanesRig()));
  EXPECT_THROW(w.Bridge(), std::logic_error);
  EXPECT_THROW(w.CoilSensor(), std::logic_error);
  EXPECT_THROW(w.Reading(), std::logic_error);
}

std::string FaultMessage(const std::string& text) {
  const TomlTable root = TomlTable::FromText("[[fault]]\n" + text, "s.toml");
  constexpr FaultTarget kAny[] = {FaultTarget::kCoil, FaultTarget::kAxis, FaultTarget::kRig};
  std::map<std::string, double> parameters;
  try {
    ReadFault(root.Tables("fault")[0], FaultKindNames(kAny), ReferenceLanesRig(), &parameters);
  } catch (const InputError& e) {
    return e.what();
  }
  return "no mistake";
}

TEST(FaultFile, MistakesSayWhatIsAllowed) {
  EXPECT_THAT(FaultMessage("kind = \"broken\""), HasSubstr("allowed: open, partial-short"));
  EXPECT_THAT(FaultMessage("kind = \"partial-short\""), HasSubstr("fraction is missing"));
  EXPECT_THAT(FaultMessage("kind = \"partial-short\"\nparameters = { fraction = 1.0 }"),
              HasSubstr("fraction = 1, allowed: above 0 to below 1"));
  EXPECT_THAT(FaultMessage("kind = \"current-sensor\"\nparameters = { gain = 1.0 }"),
              HasSubstr("change nothing, allowed with kind current-sensor: gain, offset, stuck"));
  EXPECT_THAT(FaultMessage("kind = \"open\"\nparameters = { depth = 1.0 }"),
              HasSubstr("unknown key, allowed with kind open: none"));
  EXPECT_THAT(FaultMessage("kind = \"bus-sag\"\nparameters = { duration = 0.0 }"),
              HasSubstr("duration = 0 s, allowed: above 0 to inf s"));
  EXPECT_EQ(FaultMessage("kind = \"bus-sag\"\nparameters = { duration = inf }"), "no mistake");
  EXPECT_THAT(FaultMessage("kind = \"bus-sag\"\nparameters = { voltage = 60.0 }"),
              HasSubstr("voltage = 60 V, allowed: 0 to below 30 V"));
  EXPECT_EQ(FaultMessage("kind = \"position-sensor\"\nparameters = { stuck = true }"),
            "no mistake");
}

TEST(FaultFile, KindsAreListedByTheirTarget) {
  constexpr FaultTarget axis[] = {FaultTarget::kAxis}, rig[] = {FaultTarget::kRig};
  EXPECT_EQ(FaultKindNames(axis), "position-sensor");
  EXPECT_EQ(FaultKindNames(rig), "bus-sag");
}

}  // namespace
}  // namespace ambrig
