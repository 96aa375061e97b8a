#include "fdd/detectors/slope_prediction.h"

#include <algorithm>
#include <cmath>

namespace ambrig {

SlopePrediction::SlopePrediction(const CoilDetectorSetup& setup)
    : model_(setup.model),
      s_(setup.settings),
      resistance_(setup),
      measured_(static_cast<std::size_t>(s_.sampling.samples - 1)),
      predicted_(measured_.size()) {}

void SlopePrediction::Predict(const MeasuredPeriod& in, Lane* current) const {
  const MovingInverse inverse(model_, in);
  LinkageVector i = LinkageVector::Zero();
  for (int j = 0; j < model_.coils; ++j) i[j] = in.adc[0][j];
  LinkageVector lambda = inverse.L0 * i;
  for (int k = 0; k < s_.sampling.samples; ++k) {
    const LinkageMatrix C = inverse.At(k, s_.sampling.samples);
    i = C * lambda;
    for (int j = 0; j < model_.coils; ++j)
      // a diode blocks: the linkage follows the others' flux at zero current
      if (k > 0 && i[j] < 0) {
        const double shift = -i[j] / C(j, j);
        lambda[j] += shift;
        i += C.col(j) * shift;
      }
    for (int j = 0; j < model_.coils; ++j) {
      current[k][j] = i[j];
      lambda[j] +=
          DrivenLinkage(s_.sampling, in, j, k) - s_.sampling.step * resistance_.Value(j) * i[j];
    }
  }
}

double SlopePrediction::EvaluateStatistic(int j, const MeasuredPeriod& in, const Lane* current) {
  for (std::size_t k = 0; k < measured_.size(); ++k) {
    measured_[k] = (in.adc[k + 1][j] - in.adc[k][j]) / s_.sampling.step;
    predicted_[k] = (current[k + 1][j] - current[k][j]) / s_.sampling.step;
  }
  // The slopes that a healthy coil would keep are looked at, also where a fault left none of them.
  const std::vector<int> kept = KeptSlopes(predicted_);
  double sum[2] = {0, 0}, count[2] = {0, 0};
  for (std::size_t k = 0; k < kept.size(); ++k) {
    if (kept[k] == 0) continue;
    const std::size_t phase = kept[k] > 0 ? 0 : 1;
    sum[phase] += measured_[k] - predicted_[k];
    count[phase] += 1;
  }
  double most = 0;
  for (std::size_t q = 0; q < 2; ++q)
    if (count[q] >= kFewestSamples) most = std::max(most, std::abs(sum[q] / count[q]));
  return most / kSlopeErrorBudget;
}

Lane SlopePrediction::Period(const MeasuredPeriod& in) {
  Lane out, current[64];
  if (in.comparable) {
    Predict(in, current);
    for (int j = 0; j < model_.coils; ++j) out[j] = EvaluateStatistic(j, in, current);
  }
  resistance_.Add(in);
  return out;
}

CoilDetectorKind PaperCoupled() {
  return {"paper-coupled",
          "700 A/s",
          "the same, and from the neighbours' switch states",
          1,
          4.53,
          MakeDetector<SlopePrediction>};
}

}  // namespace ambrig
