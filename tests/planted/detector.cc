// catalogue: PlantedDetector
/// Planted by tools/planted_change.py: the voltage that each coil's equation misses, the larger of
/// both phases [V].
#include <algorithm>
#include <cmath>

#include "fdd/detectors/coil_detector.h"
#include "fdd/measurement/period_slopes.h"

namespace ambrig {

namespace {

class MissingVoltage : public CoilDetector {
 public:
  explicit MissingVoltage(const CoilDetectorSetup& setup)
      : model_(setup.model), sampling_(setup.settings.sampling) {}
  Lane Period(const MeasuredPeriod& in) override {
    PeriodSlopes slopes;
    ComputePeriodSlopes(model_, sampling_, in, &slopes);
    Lane out;
    for (const PhaseSlopes& phase : slopes.phase)
      for (int j = 0; j < model_.coils; ++j)
        if (in.comparable && phase.samples[j] >= kFewestSamples)
          out[j] = std::max(out[j], std::abs(phase.residual[j]));
    return out;
  }

 private:
  LinkageModel model_;
  SamplingSettings sampling_;
};

}  // namespace

CoilDetectorKind PlantedDetector() {
  return {"planted", "V", "missing voltage", kRequired, 5, MakeDetector<MissingVoltage>};
}

}  // namespace ambrig
