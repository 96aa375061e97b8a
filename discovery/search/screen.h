#pragma once
/// Screening: what would each effect of the catalogue, at each target, explain of the residual?
#include <functional>
#include <string>
#include <vector>

#include "discovery/search/linear_judge.h"
#include "discovery/search/residual_peaks.h"

namespace ambrig {

struct ScreenOptions {
  double effective_sample_size = 1;
  std::string effect, target;  // only this one, at this target only; empty: all
  bool coarse = false;         // no single coils, nothing that looks for a frequency
  bool frequencies = true;     // effects that look for a frequency too
  // those of a frequency and a damping, the dearest to seek, where the rest leaves motion open
  bool resonances = true;
  std::function<void(double, const std::string&)> progress;
};

/// Every (effect, target) that these records could show, best first. `base` is the fit so far.
/// Fills the bank; what stands in it already is not simulated again, save for effects that look for
/// a frequency where the error stands out (`peaks`).
std::vector<Candidate> Screen(const CaseModel& model, const FitResult& base,
                              const ResidualPeaks& peaks, const ScreenOptions& options,
                              SignatureBank& bank);

/// The pairs of effects out of the bank that would explain most together, best first.
std::vector<CandidatePair> ScreenPairs(const CaseModel& model, const FitResult& base,
                                       double effective_sample_size, SignatureBank& bank,
                                       std::size_t count);

}  // namespace ambrig
