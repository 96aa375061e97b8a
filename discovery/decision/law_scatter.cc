#include "discovery/decision/law_scatter.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "core/math/linear_equations.h"
#include "core/record/channels.h"
#include "discovery/search/likelihood.h"

namespace ambrig {

namespace {

using Eigen::Index;

constexpr std::size_t kParts = 3;  // of a record over time
// Independent numbers in what a wrong law leaves, as far as they bear on one parameter: fewer than
// tell names apart, because the error of a law is most like the law's own signature.
constexpr double kNumbersOfParameter = 30;

/// One kind of channel in one part of a record: its scores JᵀR and its JᵀJ.
struct DataBlock {
  bool fitted = false;
  Eigen::VectorXd score;
  Eigen::MatrixXd square;
};

std::vector<DataBlock> BlocksOf(const CaseModel& model, const FitResult& fit) {
  std::map<std::tuple<std::size_t, int, std::size_t>, DataBlock> blocks;
  const Index n = fit.jacobian.cols();
  for (const Target& t : model.targets()) {
    const CaseRecord& record = model.data().records[t.record];
    const auto id = ParseChannel(record.data.channels[t.channel].name);
    const int kind = id ? static_cast<int>(id->kind) : -1;
    const std::size_t parts = OverTime(record) ? kParts : 1;
    for (std::size_t p = 0; p < parts; ++p) {
      const std::size_t begin = t.count * p / parts, end = t.count * (p + 1) / parts;
      if (end <= begin) continue;
      DataBlock& block = blocks[{t.record, kind, p}];
      if (block.score.size() == 0)
        block = {!record.validate, Eigen::VectorXd::Zero(n), Eigen::MatrixXd::Zero(n, n)};
      const auto first = static_cast<Index>(t.first + begin),
                 rows = static_cast<Index>(end - begin);
      const auto part = fit.jacobian.middleRows(first, rows);
      block.score.noalias() +=
          part.transpose() * Eigen::Map<const Eigen::VectorXd>(fit.residual.data() + first, rows);
      block.square.noalias() += part.transpose() * part;
    }
  }
  std::vector<DataBlock> out;
  for (auto& [key, block] : blocks) out.push_back(std::move(block));
  return out;
}

/// Weights of a squared residual per row: of the fit, and by noise alone.
struct RowWeights {
  double fit = 0, noise = 0;
};

/// Variance [coordinates] of the value with covariance column `a` and variance a(k), by the blocks'
/// scores.
double VarianceOfScores(const std::vector<DataBlock>& blocks, const Eigen::VectorXd& a,
                        const RowWeights& weight) {
  double sum = 0;
  for (const DataBlock& b : blocks)
    if (b.fitted) sum += std::pow(weight.fit * a.dot(b.score), 2);
  return sum;
}

/// The spread of what the blocks ask for. It is not divided by the number of records: under a law
/// of another form each condition has a value of its own, and the one that the law is given by (a
/// small orbit, say) is one more condition.
double VarianceOfLaw(const std::vector<DataBlock>& blocks, const Eigen::VectorXd& a,
                     double variance, const RowWeights& weight) {
  std::vector<BlockValue> values;
  for (const DataBlock& b : blocks) {
    const double seen = a.dot(b.square * a);
    if (seen <= 0) continue;
    values.push_back(
        {variance * a.dot(b.score) / seen, weight.noise * seen / (variance * variance)});
  }
  return VarianceBetween(values);
}

/// Variance [coordinates] that parameter `m` of an effect inherits from rig parameters that act
/// like it: where two columns differ by no more than sensitivities err, the drawing alone tells how
/// much is whose.
double VarianceOfAlike(const Hypothesis& h, const Eigen::MatrixXd& square, Index m) {
  constexpr double kErrs = 0.05;  // of a sensitivity (docs/theory/discovery.md 3)
  double variance = 0;
  for (Index k = 0; k < square.rows(); ++k) {
    if (k == m || h.free[static_cast<std::size_t>(k)].sd <= 0) continue;
    const double size = square(k, k) * square(m, m);
    if (size <= 0 || 1 - square(k, m) * square(k, m) / size > kErrs * kErrs) continue;
    variance += std::pow(square(k, m) / square(m, m), 2);
  }
  return variance;
}

}  // namespace

double VarianceBetween(const std::vector<BlockValue>& blocks) {
  double sum = 0, squares = 0, mean = 0, most = 0;
  for (const BlockValue& b : blocks) most = std::max(most, b.information);
  int seen = 0;
  const auto sees = [&](const BlockValue& b) {
    return b.information > 0 && b.information >= 1e-6 * most;
  };
  for (const BlockValue& b : blocks) {
    if (!sees(b)) continue;
    sum += b.information;
    squares += b.information * b.information;
    mean += b.information * b.value;
    ++seen;
  }
  if (seen < 2) return 0;
  mean /= sum;
  double q = 0;
  for (const BlockValue& b : blocks)
    if (sees(b)) q += b.information * std::pow(b.value - mean, 2);
  return std::max(0.0, (q - (seen - 1)) / (sum - squares / sum));
}

std::vector<double> SdUnderDoubt(const CaseModel& model, const FitResult& fit,
                                 double effective_sample_size) {
  std::vector<double> sd = fit.sd;
  const Hypothesis& h = fit.hypothesis;
  const auto n = static_cast<Index>(h.free.size());
  if (fit.jacobian.cols() != n || sd.size() != h.free.size()) return sd;
  const double rows = static_cast<double>(model.size());
  const RowWeights weight = {RowWeight(model, fit.ratio_fit, effective_sample_size),
                             effective_sample_size / rows};
  const std::vector<DataBlock> blocks = BlocksOf(model, fit);
  Eigen::MatrixXd square = Eigen::MatrixXd::Zero(n, n);
  for (const DataBlock& b : blocks)
    if (b.fitted) square += b.square;
  Eigen::MatrixXd information = weight.fit * square;
  AddPriorInformation(h, information);
  const Eigen::MatrixXd one = Eigen::MatrixXd::Identity(n, n),
                        covariance = SolveSymmetricColumns(information, one);
  information =
      RowWeight(model, fit.ratio_fit, effective_sample_size, kNumbersOfParameter) * square;
  AddPriorInformation(h, information);
  const Eigen::VectorXd of_few = SolveSymmetricColumns(information, one).diagonal();
  for (Index k = 0; k < n; ++k) {
    const FreeParameter& p = h.free[static_cast<std::size_t>(k)];
    double& value = sd[static_cast<std::size_t>(k)];
    const double variance = covariance(k, k), unit = p.logarithmic ? 0.3 * p.value : p.step;
    if (variance <= 0 || value <= 0) continue;
    const Eigen::VectorXd a = covariance.col(k);
    // of a parameter with a drawing the data have their share only
    const double share = p.sd > 0 ? std::max(0.0, 1 - variance) : 1;
    const double least = std::max(VarianceOfScores(blocks, a, weight),
                                  p.effect < 0 ? 0 : VarianceOfAlike(h, square, k));
    const double of_fit = value * value * (p.effect < 0 ? 1 : of_few(k) / variance);
    value = std::sqrt(std::max(of_fit, unit * unit * least) +
                      std::pow(unit * share, 2) * VarianceOfLaw(blocks, a, variance, weight));
    if (p.sd > 0) value = std::min(value, p.sd);  // whatever the law, the drawing holds
  }
  return sd;
}

}  // namespace ambrig
