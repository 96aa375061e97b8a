#pragma once
/// The trial sizes of an effect: where its signature is taken.
#include <vector>

#include "discovery/search/residual_peaks.h"
#include "effects/catalogue.h"

namespace ambrig {

/// Probes that belong together. In a linear group every probe moves one parameter from its null and
/// their signatures add; otherwise the group is one probe of finite size, to be scaled about 1.
struct ProbeGroup {
  std::vector<EffectInstance> probes;
  std::vector<std::size_t> rows;  // linear: the table row that each probe moved
  bool linear = true;
  // not linear: rows that go with a power of the amount, and the amounts for which the signature is
  // believed
  std::vector<std::pair<std::size_t, double>> scaling;
  double least = 0.5, most = 2;
  bool narrow = false;  // a resonance: off its frequency the signature tells little
};

/// Whether the effect is one of a frequency and a damping.
bool IsResonance(const EffectDescription& d);

/// Whether a parameter that does not switch its effect may also be left out: its null lies below
/// its usual range and is possible (laminations so thick that their thickness does not show).
bool IsOptionalShape(const EffectParameter& p);

/// Whether a parameter that does not switch its effect only shapes the law further: its null lies
/// inside of its usual range.
bool ShapesFurther(const EffectParameter& p);

/// Frequencies are tried where the error stands out (`peaks`) and over their usual range.
std::vector<ProbeGroup> ProbesOf(const EffectDescription& d, const std::string& target,
                                 const CaseModel& model, const ResidualPeaks& peaks);

}  // namespace ambrig
