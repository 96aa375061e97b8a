#pragma once
/// How much several loops bear at the same time. Every axis' loop is multiplied by a factor of its
/// own
///
///   f = (1 + δ/2) / (1 - δ/2),   |δ| < α
///
/// any complex numbers of the disk with the real diameter (2 - α)/(2 + α) ... (2 + α)/(2 - α):
/// gain, phase or both. With u = S d (command after the injection points, all of them at once) the
/// loops are on their limit where det(I - (S - I/2) diag(δ)) = 0, so that the closed loop stays
/// stable for all α < 1 / max over ω of μ(S(iω) - I/2). Of one axis μ is |S - 1/2|.
/// Source: Seiler, Packard, Gahinet: An introduction to disk margins, IEEE Control Systems 40(5),
/// 2020.
#include <complex>
#include <string>
#include <vector>

#include <Eigen/Dense>

namespace ambrig {

/// Lowest and highest gain of the disk; 0 and infinite from α = 2 on.
double DiskGainDown(double alpha);
double DiskGainUp(double alpha);
/// Phase that it bears at unchanged gain [rad].
double DiskPhase(double alpha);

/// Margin of the axes of one group, all changed at once.
struct JointMargin {
  std::vector<std::size_t> axes;  // that move one another, by index
  // borne for certain: by the upper bound of μ; infinite: any
  double alpha = 0;
  double reached = 0;                        // a change of this size is known to reach the limit
  double frequency = 0;                      // where [Hz]
  std::vector<std::complex<double>> factor;  // that change, one factor f an axis; empty: none known
};

/// `S[k]`: all axes' sensitivities (rows: commands, columns: injections) at `frequency[k]` [Hz] of
/// a stable loop. Groups in the order of their first axis.
std::vector<JointMargin> FindJointMargins(const std::vector<double>& frequency,
                                          const std::vector<Eigen::MatrixXcd>& S);

}  // namespace ambrig
