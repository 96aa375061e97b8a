#include "fdd/detectors/coupled_detector.h"

#include <algorithm>

namespace ambrig {

namespace {
DetectorSettings WatchOnly(DetectorSettings s) {
  s.watch_only = true;
  return s;
}
}  // namespace

CoupledDetector::CoupledDetector(const CoilDetectorSetup& setup)
    : watch_(setup.model, WatchOnly(setup.settings)) {}

Lane CoupledDetector::Period(const MeasuredPeriod& in) {
  watch_.Period(in);
  const ResidualChart& chart = watch_.chart();
  Lane out;
  for (int j = 0; j < kLanes; ++j) out[j] = std::max({chart.G[0][j], chart.G[1][j], chart.G[2][j]});
  return out;
}

CoilDetectorKind Coupled() {
  return {"coupled",
          "-",
          "this program's: coupled residuals, learned leakage and gap",
          9,
          9,
          MakeDetector<CoupledDetector>,
          [](const RunDetectorSetup& s) -> std::unique_ptr<RunDetector> {
            DetectorSettings settings = s.settings;
            if (s.threshold > 0) settings.threshold = s.threshold;
            return std::make_unique<BearingDetector>(s.model, settings);
          }};
}

}  // namespace ambrig
