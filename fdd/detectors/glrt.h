#pragma once
/// Gaussian generalised likelihood ratio test for a mean that changes at an unknown time by an
/// unknown amount, over the last M samples:
///
///   g(k) = max over m = 1..M of  1/(2 m) Σ_c (Σ of the last m samples of channel c)²
///
/// Channels are independent and of unit variance. Without a change and for one m, 2 g is chi-square
/// distributed with as many degrees of freedom as channels: P(g > h) = erfc(sqrt h) for one, e^-h
/// for two. A shift of size d (norm over the channels) is found after about 2 h/d² samples. Source:
/// Nagel, Galeazzi, Voigt, Santos, SysTol 2016 (Gaussian GLRT on residuals of electromagnets);
/// Basseville and Nikiforov 1993, section 2.4.3.
#include <vector>

#include "fdd/detectors/linkage_residual.h"

namespace ambrig {

class Glrt {
 public:
  static constexpr int kMostChannels = 2;
  Glrt(int window, int channels) : ring_(static_cast<std::size_t>(window)), channels_(channels) {}

  /// One sample of every channel; returns g.
  double Add(const double* r);
  double statistic() const { return g_; }

 private:
  struct Sample {
    double r[kMostChannels] = {};
  };
  std::vector<Sample> ring_;
  int channels_;
  std::size_t next_ = 0, held_ = 0;
  double g_ = 0;
};

/// On the residuals of both phases of every coil as two channels; a phase that cannot be judged
/// adds nothing. M = 25 periods (1 ms of the reference rig).
class GlrtDetector : public CoilDetector {
 public:
  static constexpr int kWindow = 25;
  explicit GlrtDetector(const CoilDetectorSetup& setup)
      : residual_(setup), chart_(kLanes, Glrt(kWindow, Glrt::kMostChannels)) {}
  Lane Period(const MeasuredPeriod& in) override;

 private:
  LinkageResidual residual_;
  std::vector<Glrt> chart_;
};

}  // namespace ambrig
