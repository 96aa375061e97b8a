/// The detectors of coil faults that a study or the [detection] table of a rig file may name.
#include <fmt/format.h>

#include "core/base/errors.h"
#include "fdd/detectors/bearing_detector.h"
#include "fdd/detectors/coil_detector.h"
#include "fdd/detectors/coupled_detector.h"
#include "fdd/detectors/current_error.h"
#include "fdd/detectors/cusum.h"
#include "fdd/detectors/examined_detector.h"
#include "fdd/detectors/glrt.h"
#include "fdd/detectors/linkage_kalman.h"
#include "fdd/detectors/slope_prediction.h"
#include "fdd/detectors/slope_statistic.h"

namespace ambrig {

namespace {

using Setup = const CoilDetectorSetup&;
using Made = std::unique_ptr<CoilDetector>;
constexpr double kPaperCycle = 1.75e-3;  // [s]

Made Paper(Setup s) {
  return std::make_unique<SlopeStatistic>(s, SlopeStatistic::Thresholds::kFixed, kPaperCycle);
}
Made PaperEveryPeriod(Setup s) {
  return std::make_unique<SlopeStatistic>(s, SlopeStatistic::Thresholds::kFixed);
}
Made PaperOnline(Setup s) {
  return std::make_unique<SlopeStatistic>(s, SlopeStatistic::Thresholds::kOnline);
}
template <class Detector>
Made Make(Setup s) {
  return std::make_unique<Detector>(s);
}

std::unique_ptr<RunDetector> CoupledInRun(const RunDetectorSetup& s) {
  DetectorSettings settings = s.settings;
  if (s.threshold > 0) settings.threshold = s.threshold;
  return std::make_unique<BearingDetector>(s.model, settings);
}

// name, unit, meaning, documented threshold, threshold in a run, makers
constexpr CoilDetectorKind kKinds[] = {
    {"paper", "700 A/s", "slopes against fixed theoretical limits, once in 1.75 ms", 1, 8.06,
     Paper},
    {"paper-every-period", "700 A/s", "the same in every switching period", 1, 8.66,
     PaperEveryPeriod},
    {"paper-online", "700 A/s", "the same, limits from measured bus, resistance and gap", 1, 4.53,
     PaperOnline},
    {"paper-coupled", "700 A/s", "the same, and from the neighbours' switch states", 1, 4.53,
     Make<SlopePrediction>},
    {"current-error", "A", "mean current against its set-point, five periods in a row", kRequired,
     0.178, Make<CurrentErrorDetector>},
    {"glrt", "-", "likelihood ratio on the coupled residuals, unknown change", kRequired, 124,
     Make<GlrtDetector>},
    {"cusum", "-", "two-sided sums on the coupled residuals", kRequired, 22.1, Make<CusumDetector>},
    {"kalman", "-", "innovations of a filter of all linkages, chi-square over 18", kRequired, 11.6,
     Make<LinkageKalman>},
    {"coupled", "-", "this program's: coupled residuals, learned leakage and gap", 9, 9,
     Make<CoupledDetector>, CoupledInRun},
};

}  // namespace

std::span<const CoilDetectorKind> CoilDetectorKinds() { return kKinds; }

std::unique_ptr<RunDetector> MakeRunDetector(const std::string& kind, const std::string& where,
                                             const RunDetectorSetup& setup) {
  std::string names;
  for (const CoilDetectorKind& k : kKinds) {
    if (k.name == kind)
      return k.make_run ? k.make_run(setup) : std::make_unique<ExaminedDetector>(k, setup);
    names += fmt::format("{}{}", names.empty() ? "" : ", ", k.name);
  }
  throw InputError(fmt::format("{} = \"{}\", allowed: {}", where, kind, names));
}

}  // namespace ambrig
