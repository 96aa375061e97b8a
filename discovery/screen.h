#pragma once
/// Screening: what would each effect of the catalogue, at each target, explain of the residual?
/// A few simulations give a candidate's signature in all channels; the rig parameters' signatures
/// are fitted beside it under their prior (linear), and what is left on the fit and on the unseen
/// records ranks it.
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "discovery/fit.h"
#include "effects/catalogue.h"

namespace ambrig {

struct Candidate {
  EffectInstance effect;       // where a full fit should start
  double score = 0;            // smaller is better, in units of 2 log likelihood
  double ratio_fit = 0, ratio_validate = 0;  // predicted by the linear step
};

struct ProbeGroup;

/// Signatures of probes once simulated, on every few rows of the data: a later round ranks the same
/// effects against a new residual without simulating them again.
class SignatureBank {
 public:
  SignatureBank();
  ~SignatureBank();
  struct Entry;
  std::vector<Entry>& entries() { return *entries_; }

 private:
  std::unique_ptr<std::vector<Entry>> entries_;
};

struct ScreenOptions {
  double effective = 1;
  std::function<void(double, const std::string&)> progress;
};

/// n ln R² of both kinds of records plus the price of `parameters` numbers.
double Score(const CaseModel& model, double ratio_fit, double ratio_validate, double effective, int parameters);

/// Every (effect, target) that these records could show, best first. `base` is the fit so far.
/// Fills the bank; what stands in it already is not simulated again, save for effects that look for a
/// frequency in the residual.
std::vector<Candidate> Screen(const CaseModel& model, const FitResult& base, const ScreenOptions& options,
                              SignatureBank& bank);

/// Frequencies at which the residual of a plane's readings stands out: coherent over the records
/// (same phase in each) and incoherent. [Hz]
std::vector<double> CoherentPeaks(const CaseModel& model, const std::vector<double>& residual,
                                  const std::string& plane, std::size_t count);
std::vector<double> SpectrumPeaks(const CaseModel& model, const std::vector<double>& residual, std::size_t count);

}  // namespace ambrig
