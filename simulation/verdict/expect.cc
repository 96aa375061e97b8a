#include "simulation/verdict/expect.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/counted.h"
#include "simulation/verdict/detection_score.h"

namespace ambrig {

namespace {

/// A quantity in the unit that a reader is shown: factor 1e6 and "um" of metres.
struct Shown {
  double factor = 1;
  const char* unit = "";
};
constexpr Shown kMilliSeconds{1e3, " ms"}, kMicroMetres{1e6, " um"};

ExpectResult AtMost(const std::string& key, double limit, double got, bool exists,
                    const Shown& shown = {}) {
  return {key, fmt::format("<= {:.6g}{}", limit * shown.factor, shown.unit),
          exists ? fmt::format("{:.6g}{}", got * shown.factor, shown.unit) : "none",
          exists && got <= limit};
}

ExpectResult Equal(const std::string& key, bool wanted, bool got) {
  return {key, wanted ? "true" : "false", got ? "true" : "false", wanted == got};
}

/// `got` of the faults that are judged, with those that are not.
std::string WithUnjudged(const std::string& got, const DetectionScore& score) {
  const std::size_t unjudged = score.faults.size() - score.judged();
  if (unjudged == 0) return got;
  if (score.judged() == 0) return "not judged: the rotor was lost";
  return fmt::format("{} ({} not judged: the rotor was lost)", got, Counted(unjudged, "fault"));
}

/// Every fault that is judged has an alarm of its own target, the latest of them within the limit.
ExpectResult Detected(const Scenario& s, const DetectionScore& score) {
  ExpectResult r = AtMost("detected_within", *s.expect.detected_within, score.longest_detection(),
                          score.all_detected() && score.judged() > 0, kMilliSeconds);
  r.got = WithUnjudged(r.got, score);
  return r;
}

/// The last class given to the target of each fault that is judged is the wanted one.
ExpectResult Classified(const Scenario& s, const DetectionScore& score) {
  std::string got;
  bool met = score.judged() > 0;
  for (const FaultScore& fault : score.faults) {
    if (!fault.judged) continue;
    const std::string last = fault.last_class.empty() ? "none" : fault.last_class;
    met = met && last == *s.expect.classified;
    if (got.find(last) == std::string::npos) got += (got.empty() ? "" : ", ") + last;
  }
  return {"classified", *s.expect.classified, WithUnjudged(got, score), met};
}

/// Every fault that is judged was followed by a redistribution of its own bearing; none, where that
/// is wanted.
ExpectResult Redistributed(const Scenario& s, const DetectionScore& score) {
  const std::size_t got = score.redistributed();
  ExpectResult r = Equal("redistributed", *s.expect.redistributed, got > 0);
  if (got > 0 && got < score.judged_coils()) {
    r.got = fmt::format("of {} of {} faults", got, score.judged_coils());
    r.met = false;
  }
  r.got = WithUnjudged(r.got, score);
  return r;
}

}  // namespace

std::vector<ExpectResult> CheckExpectations(const Scenario& s, const RunResult& r) {
  std::vector<ExpectResult> out;
  const Expectation& e = s.expect;
  const DetectionScore score = ScoreDetection(s.faults, r.events);
  if (e.detected_within) out.push_back(Detected(s, score));
  if (e.classified) out.push_back(Classified(s, score));
  if (e.touchdown) out.push_back(Equal("touchdown", *e.touchdown, r.touchdown));
  if (e.drop) out.push_back(Equal("drop", *e.drop, r.drop));
  if (e.redistributed) out.push_back(Redistributed(s, score));
  if (e.max_orbit) {
    double most = 0;
    for (const auto& [name, orbit] : r.metrics.max_orbit) most = std::max(most, orbit);
    out.push_back(AtMost("max_orbit", *e.max_orbit, most, true, kMicroMetres));
  }
  if (e.max_false_alarms)
    out.push_back(AtMost("max_false_alarms", *e.max_false_alarms, r.metrics.false_alarms, true));
  if (e.rests_within)
    out.push_back(
        AtMost("rests_within", *e.rests_within, r.metrics.settled_orbit, true, kMicroMetres));
  return out;
}

bool AllMet(const std::vector<ExpectResult>& results) {
  return std::all_of(results.begin(), results.end(), [](const ExpectResult& r) { return r.met; });
}

}  // namespace ambrig
