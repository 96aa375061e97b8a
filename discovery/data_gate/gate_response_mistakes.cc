// What instruments and their users do to frequency responses.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "core/math/constants.h"
#include "discovery/data_gate/gate_points.h"

namespace ambrig {

namespace {

using Complex = std::complex<double>;
using Values = std::vector<Complex>;

constexpr double kLeftOfResponse = 0.15;  // of the relative error
constexpr double kLeftOfFactor = 0.08;  // of a factor that is no prefix: an effect may come near it
constexpr double kNoiseMayLeave = 1.5;  // times what noise alone makes, where that is more

/// Whether so little is left that the mistake is believed; of a large error noise may leave up to
/// twice the share.
bool Believed(const GateResponse& r, double before, double left, double share) {
  return left < std::max(share * before, std::min(kNoiseMayLeave * r.noise, 2 * share * before));
}

/// exp of the mean of log |measured| - power log |expected|.
double MeanSize(const GateResponse& r, double power) {
  double sum = 0, n = 0;
  for (std::size_t k = 0; k < r.measured.size(); ++k) {
    const double m = std::abs(r.measured[k]), p = std::abs(r.expected[k]);
    if (m > 0 && p > 0) sum += r.weight[k] * (std::log(m) - power * std::log(p)), n += r.weight[k];
  }
  return n > 0 ? std::exp(sum / n) : 1;
}

Values Each(const Values& from, const std::function<Complex(Complex)>& change) {
  Values out;
  for (const Complex& v : from) out.push_back(change(v));
  return out;
}

void KeepBetter(ResponseMistake& best, ResponseMistake other) {
  if (other.left < best.left) best = std::move(other);
}

void TrySigns(const GateResponse& r, double before, ResponseMistake& best) {
  const double opposite = RelativeError(r, Each(r.expected, [](Complex v) { return -v; }));
  if (Believed(r, before, opposite, kLeftOfResponse))
    KeepBetter(best, {"sign", "", -1, 0, opposite});
  const double conjugate =
      RelativeError(r, Each(r.expected, [](Complex v) { return std::conj(v); }));
  if (Believed(r, before, conjugate, kLeftOfResponse))
    KeepBetter(best, {"sign", kConjugate, -1, 0, conjugate});
}

/// A factor of a list within a few percent of what the sizes say is taken as it is.
void TryFactors(const GateResponse& r, double before, ResponseMistake& best) {
  constexpr double kMostOfSensor = 1.6, kPrefix = 90, kNear = 0.05;
  static constexpr std::array kListed = {1e3,  1e-3,     1e6,     1e-6,
                                         1e9,  1e-9,     9.80665, 1 / 9.80665,
                                         25.4, 1 / 25.4, 2 * kPi, 1 / (2 * kPi)};
  double factor = MeanSize(r, 1);
  for (const double listed : kListed)
    if (std::abs(std::log(factor / listed)) < kNear) factor = listed;
  if (std::abs(std::log(factor)) < std::log(kMostOfSensor)) return;
  const bool prefix = std::max(factor, 1 / factor) > kPrefix;
  const double left = RelativeError(r, Each(r.expected, [&](Complex v) { return factor * v; }));
  if (Believed(r, before, left, prefix ? kLeftOfResponse : kLeftOfFactor))
    KeepBetter(best, {"unit", "", factor, 0, left});
}

/// Magnitudes in decibels of a power that were read as those of an amplitude, or the other way
/// round. The unit in which they were taken may be any: then the mean size says nothing.
void TryDecibels(const GateResponse& r, double before, ResponseMistake& best) {
  for (const double power : {0.5, 2.0}) {
    const double size = MeanSize(r, power);
    const double left =
        RelativeError(r, Each(r.expected, [&](Complex v) {
                        const double from = std::abs(v);
                        return from > 0 ? v / from * size * std::pow(from, power) : Complex(0);
                      }));
    if (!Believed(r, before, left, kLeftOfFactor)) continue;
    KeepBetter(best, {"unit", kDecibels, power, 0, left});
  }
}

/// Levels in decibels over any unit that were read as magnitudes, in the unit of their column.
void TryLevels(const GateResponse& r, double before, ResponseMistake& best) {
  static constexpr std::array kUnits = {1.0, 1e-3, 1e-6, 1e-9};
  for (const double over : kUnits)
    for (const double read : kUnits) {
      const auto level = [over, read](Complex v) {
        const double size = std::abs(v);
        return size > 0 ? read * 20 * std::log10(size / over) * (v / size) : Complex(0);
      };
      const double left = RelativeError(r, Each(r.expected, level));
      if (Believed(r, before, left, kLeftOfResponse))
        KeepBetter(best, {"unit", kLevels, 1, 0, left});
    }
}

/// One over the response: a stiffness under the name of a compliance, with any prefixes.
void TryInverse(const GateResponse& r, double before, ResponseMistake& best) {
  constexpr double kNear = 0.1;
  const double size = MeanSize(r, -1);
  const double prefix = std::pow(10, 3 * std::round(std::log10(size) / 3));
  if (std::abs(std::log(size / prefix)) > kNear) return;
  const double left = RelativeError(r, Each(r.expected, [prefix](Complex v) {
                                      return std::abs(v) > 0 ? prefix / v : Complex(0);
                                    }));
  if (Believed(r, before, left, kLeftOfResponse)) KeepBetter(best, {"unit", kInverse, 1, 0, left});
}

/// Phases of the expected response [rad] as instruments write them: within half a turn, from 0 on,
/// without jumps.
std::array<std::vector<double>, 3> WrittenPhases(const Values& expected) {
  std::array<std::vector<double>, 3> out;
  double turns = 0;
  for (std::size_t k = 0; k < expected.size(); ++k) {
    const double phase = std::arg(expected[k]);
    out[0].push_back(phase);
    out[1].push_back(phase < 0 ? phase + 2 * kPi : phase);
    if (k > 0) turns -= 2 * kPi * std::round((phase - out[0][k - 1]) / (2 * kPi));
    out[2].push_back(phase + turns);
  }
  return out;
}

void TryPhases(const GateResponse& r, double before, ResponseMistake& best) {
  for (const double factor : {kPi / 180, 180 / kPi})
    for (const std::vector<double>& phases : WrittenPhases(r.expected)) {
      Values made;
      for (std::size_t k = 0; k < phases.size(); ++k)
        made.push_back(std::polar(std::abs(r.expected[k]), factor * phases[k]));
      const double left = RelativeError(r, made);
      if (Believed(r, before, left, kLeftOfResponse))
        KeepBetter(best, {"unit", kPhase, factor, 0, left});
    }
}

Values Delayed(const GateResponse& r, double seconds) {
  Values out;
  for (std::size_t k = 0; k < r.expected.size(); ++k)
    out.push_back(r.expected[k] * std::polar(1.0, -2 * kPi * r.frequency[k] * seconds));
  return out;
}

/// The delay that leaves the least [s]: a grid of a fifteenth of the shortest period, then a finer
/// one. Of delays that points at equal distances do not tell apart, the smallest.
double BestDelay(const GateResponse& r) {
  constexpr double kMostDelay = 0.05;  // [s]
  constexpr long kMostSteps = 4000;
  const double highest = *std::ranges::max_element(r.frequency);
  const double step = 1 / (15 * highest);
  const long most = std::min(kMostSteps, std::lround(kMostDelay / step));
  double best = 0, least = RelativeError(r, r.expected);
  const auto look = [&](double seconds, double clearly) {
    const double left = RelativeError(r, Delayed(r, seconds));
    if (left < clearly * least) best = seconds, least = left;
  };
  for (long k = 1; k <= most; ++k)
    for (const double sign : {1.0, -1.0}) look(sign * static_cast<double>(k) * step, 0.9);
  const double coarse = best;
  for (int k = -10; k <= 10; ++k) look(coarse + 0.1 * k * step, 1);
  return best;
}

/// A delay of the instrument changes phases alone. One in the loop moves the magnitudes where the
/// loop is closed; of a quotient of two outputs it does not, and only what no rig delays is told.
void TryDelay(const GateResponse& r, bool quotient, double before, ResponseMistake& best) {
  constexpr double kLeast = 5e-4, kLeastOfQuotient = 4e-3;  // [s]
  constexpr double kMagnitudes = 0.05;
  Values sized;
  for (std::size_t k = 0; k < r.expected.size(); ++k)
    sized.push_back(std::polar(std::abs(r.expected[k]), std::arg(r.measured[k])));
  if (RelativeError(r, sized) > std::max(kMagnitudes, kNoiseMayLeave * r.noise)) return;
  const double seconds = BestDelay(r);
  if (std::abs(seconds) < (quotient ? kLeastOfQuotient : kLeast)) return;
  const double left = RelativeError(r, Delayed(r, seconds));
  if (Believed(r, before, left, kLeftOfResponse)) KeepBetter(best, {"lag", "", 1, seconds, left});
}

}  // namespace

double RelativeError(const GateResponse& r, const std::vector<std::complex<double>>& expected) {
  double sum = 0, n = 0;
  for (std::size_t k = 0; k < r.measured.size(); ++k) {
    const double sizes = std::norm(r.measured[k]) + std::norm(expected[k]);
    if (sizes > 0) sum += r.weight[k] * std::norm(r.measured[k] - expected[k]) / sizes;
    n += r.weight[k];
  }
  return n > 0 ? std::sqrt(sum / n) : 0;
}

ResponseMistake MistakeOf(const GateResponse& r, bool quotient) {
  const double before = RelativeError(r, r.expected);
  ResponseMistake best;
  best.left = before;
  TrySigns(r, before, best);
  TryFactors(r, before, best);
  TryDecibels(r, before, best);
  TryLevels(r, before, best);
  TryInverse(r, before, best);
  TryPhases(r, before, best);
  TryDelay(r, quotient, before, best);
  best.left = before > 0 ? best.left / before : 1;
  return best;
}

}  // namespace ambrig
