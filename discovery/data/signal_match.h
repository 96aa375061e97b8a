#pragma once
/// One measured column against the model's prediction of it: gain, correlation, and the instant
/// from which on it is late or early.
#include <cstddef>
#include <vector>

namespace ambrig {

/// A column and its prediction on the same uniform time base, in units of the noise floor.
struct MatchedColumn {
  std::vector<double> measured, predicted;
  std::vector<char> ok;  // 1: the sample counts
  std::size_t size() const { return measured.size(); }
};

struct Match {
  double gain = 0;         // of the movement: least squares of measured about predicted [-]
  double correlation = 0;  // of the movements, -1 to 1
  double measured_rms = 0, predicted_rms = 0;    // with their means
  double measured_move = 0, predicted_move = 0;  // about their means
  double error = 0;                              // rms of measured minus predicted
};
Match MatchOf(const MatchedColumn& c);
/// The same with the prediction `late` samples later from sample `first` on. Samples whose
/// prediction lies outside the column do not count.
Match MatchLater(const MatchedColumn& c, long late, long first);

/// rms of measured - factor * predicted_of_other: what is left if `c` showed that.
double ErrorAgainst(const std::vector<double>& measured, const std::vector<double>& predicted,
                    const std::vector<char>& ok, double factor = 1);

/// From sample `from` on, measured[k] shows what the model predicts for k - late.
struct Shift {
  long late = 0;         // [samples]; 0: none explains more
  std::size_t from = 0;  // first sample that is shifted
  double before = 0;     // rms error without the shift, of the rows that are predicted with it
  double after = 0;      // and with it
  double at_once = 0;    // and with it in all of these rows, those before `from` too
};
/// The shift and its first sample that leave the least squared error of all columns together
/// (exact search: every lag up to `most`, every instant). Edges repeat the prediction's first or
/// last value.
Shift BestShift(const std::vector<MatchedColumn>& columns, long most);

}  // namespace ambrig
