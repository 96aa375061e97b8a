#include "fdd/detectors/slope.h"

#include <cmath>

namespace ambrig {

double SlopeConverter::Slope(long a, long next) const {
  return attenuation * static_cast<double>(next - a) * reference /
         (std::exp2(bits) * sampling_resistance * period);
}

long SlopeConverter::Code(double current) const {
  return std::lround(current * sampling_resistance / attenuation / reference * std::exp2(bits));
}

double IncreasingSlope(const SlopeCircuit& c, double i0) {
  return (c.bus - 2 * c.switch_drop - i0 * c.resistance) / c.inductance;
}

double DecreasingSlope(const SlopeCircuit& c, double i0) {
  return -(c.bus + 2 * c.diode_drop + i0 * c.resistance) / c.inductance;
}

SlopeRange IncreasingRange(const SlopeCircuit& c, double i0, double margin) {
  const double k = IncreasingSlope(c, i0);
  return {k * std::exp(-0.5 * c.switching_period * c.resistance / c.inductance) - margin,
          k + margin};
}

SlopeRange DecreasingRange(const SlopeCircuit& c, double i0, double margin) {
  const double k = DecreasingSlope(c, i0);
  return {k - margin,
          k * std::exp(-0.5 * c.switching_period * c.resistance / c.inductance) + margin};
}

std::vector<int> KeptSlopes(const std::vector<double>& k) {
  std::vector<int> kept(k.size(), 0);
  for (std::size_t j = 1; j + 1 < k.size(); ++j) {
    if (k[j - 1] > 0 && k[j] > 0 && k[j + 1] > 0) kept[j] = 1;
    if (k[j - 1] < 0 && k[j] < 0 && k[j + 1] < 0) kept[j] = -1;
  }
  return kept;
}

MeanSlopes MeanSlopesOf(const SlopeConverter& converter, const std::vector<long>& codes) {
  MeanSlopes out;
  std::vector<double> k;
  for (std::size_t j = 0; j + 1 < codes.size(); ++j)
    k.push_back(converter.Slope(codes[j], codes[j + 1]));
  const std::vector<int> kept = KeptSlopes(k);
  for (std::size_t j = 0; j < k.size(); ++j) {
    out.kept_increasing += kept[j] > 0 ? 1 : 0;
    out.kept_decreasing += kept[j] < 0 ? 1 : 0;
    out.cancelled += kept[j] == 0 ? 1 : 0;
    if (kept[j] > 0) out.increasing += k[j];
    if (kept[j] < 0) out.decreasing += k[j];
  }
  if (out.kept_increasing > 0) out.increasing /= out.kept_increasing;
  if (out.kept_decreasing > 0) out.decreasing /= out.kept_decreasing;
  return out;
}

bool SlopeDetector::Sample(long code, double i0) {
  queue_.push_back(code);
  since_ += s_.converter.period;
  if (static_cast<int>(queue_.size()) < s_.samples_per_period) return false;
  const bool due = since_ >= s_.cycle * (1 - 1e-9);
  const bool fresh = due && EvaluateStatistic(i0);
  if (due) since_ = 0;
  queue_.clear();
  return fresh;
}

bool SlopeDetector::EvaluateStatistic(double i0) {
  last_ = MeanSlopesOf(s_.converter, queue_);
  if (flagged()) return false;
  const SlopeRange up = IncreasingRange(s_.circuit, i0, s_.margin),
                   down = DecreasingRange(s_.circuit, i0, s_.margin);
  if (last_.increasing > up.high || last_.decreasing < down.low)
    cls_ = FaultClass::kPartialShort;
  else if (last_.increasing < up.low || last_.decreasing > down.high)
    cls_ = FaultClass::kOpen;
  return flagged();
}

}  // namespace ambrig
