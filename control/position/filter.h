#pragma once
/// Filters in series with a controller's force, one state per axis. Continuous forms of gain 1 at
/// rest:
///
///   notch     (s² + depth b s + w²) / (s² + b s + w²)     b = 2 pi width, w = 2 pi frequency
///   lead-lag  (1 + s/w_z) / (1 + s/w_p)                   zero below pole: lead
///   low-pass  w² / (s² + 2 zeta w s + w²)
///
/// sampled by the bilinear map, prewarped at the notch's and low-pass's frequency and at the
/// lead-lag's centre sqrt(w_z w_p): depth and phase there are those of the continuous form. Source:
/// Franklin, Powell, Workman 1998, 6.1.
#include <string>
#include <vector>

#include "control/linear/state_space.h"
#include "core/base/toml.h"

namespace ambrig {

enum class FilterKind { kNotch, kLeadLag, kLowPass };

struct FilterParameters {
  FilterKind kind = FilterKind::kNotch;
  std::vector<std::string> axes;  // empty: every axis that the controller has
  double frequency = kRequired, width = kRequired, depth = 0;  // [Hz], [Hz], [-]
  double zero = kRequired, pole = kRequired;                   // [Hz]
  double damping = 0.7071;
};

inline constexpr Field<FilterParameters> kNotchFields[] = {
    {"frequency", &FilterParameters::frequency, "Hz", 1e-3, 1e6,
     "centre, below half the controller's rate"},
    {"width", &FilterParameters::width, "Hz", 1e-6, 1e6,
     "between the points of -3 dB of a full notch"},
    {"depth", &FilterParameters::depth, "-", 0, 1, "gain at the centre; 0: nothing passes"},
};
inline constexpr Field<FilterParameters> kLeadLagFields[] = {
    {"zero", &FilterParameters::zero, "Hz", 1e-3, 1e6, "corner of the zero; below the pole: lead"},
    {"pole", &FilterParameters::pole, "Hz", 1e-3, 1e6, "corner of the pole"},
};
inline constexpr Field<FilterParameters> kLowPassFields[] = {
    {"frequency", &FilterParameters::frequency, "Hz", 1e-3, 1e6,
     "corner, below half the controller's rate"},
    {"damping", &FilterParameters::damping, "-", 0.01, 10, "zeta"},
};

/// One [[controller.filter]]; `axes` allowed. @throws InputError
FilterParameters ReadFilter(const TomlTable& table, const std::vector<std::string>& axes,
                            double rate);

/// Sampled second order section, direct form II transposed.
struct Biquad {
  double b0 = 1, b1 = 0, b2 = 0, a1 = 0, a2 = 0;
  double s1 = 0, s2 = 0;
  double Step(double u) {
    const double y = b0 * u + s1;
    s1 = b1 * u - a1 * y + s2;
    s2 = b2 * u - a2 * y;
    return y;
  }
  /// The state in which a constant u passes unchanged (gain 1 at rest).
  void Hold(double u) {
    s2 = (b2 - a2) * u;
    s1 = (1 - b0) * u;
  }
  StateSpace Linear() const;
};

Biquad SampleFilter(const FilterParameters& p, double Ts);

}  // namespace ambrig
