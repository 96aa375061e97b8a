/// The detectors of coil faults that a study may name.
#include "fdd/detectors/coil_detector.h"
#include "fdd/detectors/coupled_detector.h"
#include "fdd/detectors/current_error.h"
#include "fdd/detectors/cusum.h"
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

constexpr CoilDetectorKind kKinds[] = {
    {"paper", "700 A/s", "slopes against fixed theoretical limits, once in 1.75 ms", 1, Paper},
    {"paper-every-period", "700 A/s", "the same in every switching period", 1, PaperEveryPeriod},
    {"paper-online", "700 A/s", "the same, limits from measured bus, resistance and gap", 1,
     PaperOnline},
    {"paper-coupled", "700 A/s", "the same, and from the neighbours' switch states", 1,
     Make<SlopePrediction>},
    {"current-error", "A", "mean current against its set-point, five periods in a row", kRequired,
     Make<CurrentErrorDetector>},
    {"glrt", "-", "likelihood ratio on the coupled residuals, unknown change", kRequired,
     Make<GlrtDetector>},
    {"cusum", "-", "two-sided sums on the coupled residuals", kRequired, Make<CusumDetector>},
    {"kalman", "-", "innovations of a filter of all linkages, chi-square over 18", kRequired,
     Make<LinkageKalman>},
    {"coupled", "-", "this program's: coupled residuals, learned leakage and gap", 9,
     Make<CoupledDetector>},
};

}  // namespace

std::span<const CoilDetectorKind> CoilDetectorKinds() { return kKinds; }

}  // namespace ambrig
