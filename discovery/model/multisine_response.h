#pragma once
/// A frequency response as a laboratory measures it, on the simulated rig: a small multisine at one
/// port, the switching engine, spectra of the record over a whole number of periods of every line.
/// It sees every effect. Against the same test without the effects that the linear model leaves
/// out, transients, sampling and ripple cancel, so that a response is
///
///   H = H_linear (without them) * test(with them) / test(without them)
#include <complex>
#include <memory>
#include <optional>
#include <vector>

#include "discovery/model/linear_responses.h"
#include "simulation/sampled/command_plan.h"

namespace ambrig {

class MultisineMeasurement {
 public:
  /// Of one port of one record. `base`: the linear model that tells how large the test may be.
  MultisineMeasurement(const RigParameters& drawing, const CaseRecord& record,
                       const ResponsePoint& port, const LinearResponses& base);

  /// Measured quotients at the test's lines, for every response of the record that this port drives
  /// (others stay empty). nullopt: the rotor is lost.
  using Spectra = std::vector<std::vector<std::complex<double>>>;
  std::optional<Spectra> Run(const RigParameters& rig) const;

  const std::vector<double>& lines() const { return lines_; }  // [Hz], ascending
  const ResponsePoint& port() const { return port_; }

 private:
  void ChooseLines();
  double AmplitudeFor(const LinearResponses& base) const;
  /// Lines of one point in the record of a run; `sign`: of the excitation.
  std::vector<std::complex<double>> SpectrumOf(const Record& run, const ResponsePoint& p,
                                               double sign) const;
  std::vector<std::complex<double>> Lines(const std::vector<double>& samples) const;

  const RigParameters& drawing_;
  const CaseRecord& record_;
  ResponsePoint port_;
  std::vector<double> lines_;
  std::size_t window_ = 0, settle_ = 0;  // rows of the record
  Scenario scenario_, opposite_;         // the second with the excitation turned round
  std::vector<double> excited_;          // the port's samples, settling and window [its unit]
  std::unique_ptr<CommandPlan> plan_, opposite_plan_;
  // per bearing and side: force command of set-points (1 x coils)
  std::vector<std::vector<Eigen::RowVectorXd>> commands_;
};

}  // namespace ambrig
