#include "scenarios/expect_file.h"

#include <fmt/format.h>

#include "core/base/toml_checked.h"
#include "scenarios/faults/fault_file.h"

namespace ambrig {

std::string WhyUnwatched(const RigParameters& rig, const Scenario& s) {
  if (s.start == StartState::kClamped) return "the rotor is clamped";
  // The detectors' model of a coil's voltage is that of this bridge.
  if (rig.amplifier.modulation != Modulation::kBiState)
    return "it needs bi-state amplifiers, which the rig does not have";
  return "";
}

void ReadExpect(const TomlTable& root, const RigParameters& rig, Scenario& s) {
  const auto t = root.Table("expect");
  if (!t) return;
  const auto number = [&](const char* key, std::optional<double>& out, const Range& range) {
    if (t->Has(key)) out = Within(*t, key, kRequired, range);
  };
  const auto flag = [&](const char* key, std::optional<bool>& out) {
    if (t->Has(key)) out = t->Bool(key, false);
  };
  number("detected_within", s.expect.detected_within, {"s", 0, 1e5, "delay of the detection"});
  number("max_orbit", s.expect.max_orbit, {"m", 0, 1, "largest orbit"});
  number("max_false_alarms", s.expect.max_false_alarms, {"-", 0, 1e9, "alarms without a fault"});
  number("rests_within", s.expect.rests_within, {"m", 0, 1, "orbit at the end"});
  flag("touchdown", s.expect.touchdown);
  flag("drop", s.expect.drop);
  flag("redistributed", s.expect.redistributed);
  if (t->Has("classified")) s.expect.classified = t->Choice("classified", "", FaultClassNames());
  t->RejectUnknownKeys();
  const std::string_view key = s.expect.NeedsDetection();
  if (const std::string why = WhyUnwatched(rig, s);
      s.fault_tolerant && !key.empty() && !why.empty())
    t->Fail(key, fmt::format("asks for fault detection, which this run does not have: {}; allowed: "
                             "a scenario that is watched, or without it",
                             why));
}

}  // namespace ambrig
