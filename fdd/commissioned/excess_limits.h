#pragma once
/// Limits of the relative excess c (slope_excess.h) that several steps of the commissioned detector
/// share. The rules that they belong to: docs/guide/commissioned_detector.md.
#include <cstddef>

namespace ambrig {

struct ExcessLimits {
  static constexpr std::size_t kInARow = 3;  // periods
  static constexpr double kGross = 0.5;      // |c|
  static constexpr double kGrossAbove = 2;   // c, of a coil outside the commissioned range
  // c, of a coil inside while one or two others are outside
  static constexpr double kGrossBeside = 1;
  static constexpr double kCompanion = 0.5;     // of the largest |c|: a fault of its own
  static constexpr int kCoilsAtOnce = 3;        // that stand out: the model's fault
  static constexpr double kMostRegained = 0.9;  // |c| by which turns come back
  static constexpr double kNoiseOfBand = 6;     // a window's noise is below its band over this
};

}  // namespace ambrig
