#pragma once
/// Case files on disk with frequency responses or tables, on the small spindle of the examples.
#include <complex>
#include <string>
#include <vector>

#include "discovery/case/case.h"
#include "rig/rig_file.h"
#include "simulation/switching/switching_engine.h"
#include "tests/core/temporary_folder.h"

namespace ambrig::testing {

inline const char* const kSpindle = AMBRIG_SOURCE_DIR "/examples/small_spindle/rig.toml";

/// `toml` behind the line that names the rig, as FOLDER/case.toml.
inline Case CaseOf(const TemporaryFolder& folder, const std::string& toml,
                   const std::string& rig = kSpindle) {
  WriteBytes(folder.File("case.toml"), "rig = \"" + rig + "\"\n" + toml);
  return ReadCase(folder.File("case.toml"));
}

/// Response of one recorded quantity to a sine on a port, from the switching engine: one sine, one
/// run, least squares. Nothing of the model that predicts responses is used.
struct SineRun {
  RigParameters rig;
  Excitation sine;         // port, target, frequency, amplitude
  Scenario scenario = {};  // held or levitated, with what is constant
  double settle = 0.25;    // [s]
  int cycles = 20;
  RigParameters drawing = {};  // what the controller knows; without bearings: `rig`

  /// Sums of channels times factors at the sine's frequency, over the sine.
  std::complex<double> Response(const std::vector<std::pair<std::string, double>>& channels) {
    Record(channels);
    return Fit();
  }

  void Record(const std::vector<std::pair<std::string, double>>& channels) {
    const double rate = rig.controller.rate;
    Scenario s = scenario;
    s.name = "sine";
    s.noise = s.fault_tolerant = false;
    s.record_rate = rate;
    s.duration = settle + cycles / sine.frequency;
    sine.kind = "sine";
    sine.stop = s.duration + 1;
    s.excitations.push_back(sine);
    EngineOptions options;
    options.watch = options.coil_spread = false;
    const NominalRig known(drawing.bearings.empty() ? rig : drawing);
    options.nominal = &known;
    const ambrig::Record record = SwitchingEngine(rig, s, options).Run().record;
    t.clear();
    y.assign(record.rows(), 0.0);
    for (std::size_t k = 0; k < record.rows(); ++k) t.push_back(record.TimeAt(k));
    for (const auto& [name, factor] : channels) {
      const Channel* c = record.Find(name);
      if (!c) throw std::runtime_error("no channel " + name);
      for (std::size_t k = 0; k < y.size(); ++k) y[k] += factor * c->samples[k];
    }
  }

  /// mean + slope + a cos + b sin behind the settling.
  std::complex<double> Fit() const {
    const auto first = static_cast<std::size_t>(settle * rig.controller.rate);
    const auto rows = static_cast<Eigen::Index>(t.size() - first);
    Eigen::MatrixXd basis(rows, 4);
    Eigen::VectorXd value(rows);
    const double omega = 2 * 3.14159265358979323846 * sine.frequency;
    for (Eigen::Index k = 0; k < rows; ++k) {
      const std::size_t at = first + static_cast<std::size_t>(k);
      basis.row(k) << 1, t[at] - settle, std::cos(omega * t[at]), std::sin(omega * t[at]);
      value(k) = y[at];
    }
    const Eigen::VectorXd c = basis.colPivHouseholderQr().solve(value);
    // a cos + b sin = Re((a - i b) e^{iωt}); sin = Re(-i e^{iωt})
    return std::complex<double>(c(2), -c(3)) / (sine.amplitude * std::complex<double>(0, -1));
  }

  std::vector<double> t = {}, y = {};  // of the last run
};

}  // namespace ambrig::testing
