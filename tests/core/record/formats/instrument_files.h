#pragma once
/// The files of tests/core/data/instruments; make_instruments.py there says what is in those it
/// wrote.
#include <cmath>
#include <string>
#include <vector>

namespace ambrig::testing {

inline std::string InstrumentFolder() { return AMBRIG_SOURCE_DIR "/tests/core/data/instruments"; }
inline std::string InstrumentFile(const std::string& name) {
  return InstrumentFolder() + '/' + name;
}

/// Signals of make_instruments.py.
inline std::vector<double> SignalX(std::size_t rows = 10) {
  std::vector<double> x(rows);
  for (std::size_t k = 0; k < rows; ++k) x[k] = std::sin(0.3 * static_cast<double>(k));
  return x;
}
inline std::vector<double> SignalY(std::size_t rows = 10) {
  std::vector<double> y(rows);
  for (std::size_t k = 0; k < rows; ++k) y[k] = static_cast<double>(k) - 2.5;
  return y;
}

}  // namespace ambrig::testing
