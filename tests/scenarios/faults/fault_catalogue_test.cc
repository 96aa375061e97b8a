// The catalogue of faults and what ends by itself.
#include <gtest/gtest.h>

#include <set>

#include "fdd/diagnosis.h"
#include "scenarios/faults/fault_ends.h"
#include "scenarios/faults/fault_file.h"
#include "scenarios/faults/faulted_plant.h"

namespace ambrig {
namespace {

std::set<std::string> Classes() {
  std::set<std::string> names;
  for (const FaultClass c :
       {FaultClass::kOpen, FaultClass::kPartialShort, FaultClass::kAmplifierOff,
        FaultClass::kSwitchStuckOn, FaultClass::kCurrentSensor, FaultClass::kPositionSensor,
        FaultClass::kBusSag})
    names.insert(ToText(c));
  return names;
}

TEST(FaultCatalogue, EveryKindIsDescribedAndSeenAsAClassOfFaultDetection) {
  std::set<std::string_view> kinds;
  for (const Fault* f : Faults()) {
    EXPECT_TRUE(kinds.insert(f->kind).second) << f->kind;
    EXPECT_EQ(&FaultByKind(f->kind), f);
    EXPECT_FALSE(f->doc.empty()) << f->kind;
    EXPECT_NE(f->apply, nullptr) << f->kind;
    EXPECT_EQ(f->duration != nullptr, f->end != nullptr) << f->kind;
    EXPECT_EQ(f->observer == FaultObserver::kNobody, f->seen_as.empty()) << f->kind;
    if (!f->seen_as.empty()) {
      EXPECT_TRUE(Classes().contains(std::string(f->seen_as))) << f->kind;
    }
    for (const FaultParameter& p : f->parameters) {
      EXPECT_FALSE(p.key.empty() || p.unit.empty() || p.doc.empty()) << f->kind;
      EXPECT_LT(p.lo, p.hi) << f->kind << " " << p.key;
    }
  }
  EXPECT_THROW(FaultByKind("none"), std::logic_error);
}

TEST(FaultCatalogue, EveryClassOfFaultDetectionIsOneThatAScenarioMayExpect) {
  const std::string names = ", " + FaultClassNames() + ",";
  for (const std::string& c : Classes())
    EXPECT_NE(names.find(", " + c + ","), std::string::npos) << c;
}

FaultSpec Sag(double time, double duration, const std::string& target = "rig") {
  FaultSpec f;
  f.time = time;
  f.target = target;
  f.kind = "bus-sag";
  f.parameters["duration"] = duration;
  return f;
}

TEST(FaultEnds, ComeInOrderAndALaterFaultTakesTheEarlierEndsPlace) {
  const Fault& kind = FaultByKind("bus-sag");
  const FaultSpec first = Sag(0.1, 0.3), other = Sag(0.15, 0.05, "elsewhere"),
                  second = Sag(0.2, 0.5);
  FaultEnds ends;
  EXPECT_EQ(ends.next(), kInfinity);
  ends.Add(kind, first);
  EXPECT_DOUBLE_EQ(ends.next(), 0.4);
  ends.Add(kind, other);
  EXPECT_DOUBLE_EQ(ends.next(), 0.2);
  EXPECT_EQ(&ends.Take(), &other);
  ends.Add(kind, second);  // the first one's end no longer comes
  EXPECT_DOUBLE_EQ(ends.next(), 0.7);
  EXPECT_EQ(&ends.Take(), &second);
  EXPECT_EQ(ends.next(), kInfinity);
  EXPECT_THROW(ends.Take(), std::logic_error);
}

TEST(FaultEnds, AFaultWithoutAnEndHasNone) {
  const FaultSpec open{0.1, "A.coil1", "open", {}, ""};
  FaultEnds ends;
  ends.Add(FaultByKind("open"), open);
  EXPECT_EQ(ends.next(), kInfinity);
}

}  // namespace
}  // namespace ambrig
