#include "discovery/calibration/calibration.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "discovery/calibration/conformal.h"

namespace ambrig {

namespace {

constexpr double kLeastProbability = 0.002;  // stated probabilities below it are as good as this
constexpr double kLevel = 0.95;
constexpr double kPriorSd = 2;  // of every weight about "as computed"
constexpr std::size_t kOthers = 3;

using Eigen::Index;
using TermVector = Eigen::Matrix<double, static_cast<int>(kCalibrationTerms), 1>;

enum class MemberGroup { kName, kUnknown, kQuiet, kWrongData };

MemberGroup GroupOf(const StatedMember& m) {
  if (m.effect == "unknown") return MemberGroup::kUnknown;
  if (m.effect == "quiet") return MemberGroup::kQuiet;
  return m.effect == "data" ? MemberGroup::kWrongData : MemberGroup::kName;
}

TermVector TermsOf(const StatedMember& m,
                   const std::array<double, kCalibrationFeatures>& features) {
  TermVector x = TermVector::Zero();
  x[0] = std::log(std::max(m.probability, kLeastProbability));
  switch (GroupOf(m)) {
    case MemberGroup::kName:
      break;
    case MemberGroup::kUnknown:
      x[1] = 1;
      for (std::size_t k = 0; k < kCalibrationFeatures; ++k)
        x[static_cast<Index>(4 + k)] = features[k];
      break;
    case MemberGroup::kQuiet:
      x[2] = 1;
      x[static_cast<Index>(kCalibrationTerms - 1)] = features[kCalibrationFeatures - 2];
      break;
    case MemberGroup::kWrongData:
      x[3] = 1;
      break;
  }
  return x;
}

Eigen::VectorXd Softmax(const Eigen::VectorXd& z) {
  Eigen::VectorXd p = (z.array() - z.maxCoeff()).exp();
  return p / p.sum();
}

/// A case as the fit sees it.
struct CaseTerms {
  Eigen::MatrixXd x;  // members x terms
  Index right = 0;    // the member that has to become probable
};

CaseTerms TermsOfCase(const CalibrationCase& c) {
  CaseTerms out;
  const auto n = static_cast<Index>(c.answer.members.size());
  out.x.resize(n, static_cast<Index>(kCalibrationTerms));
  double best = -1;
  for (Index k = 0; k < n; ++k) {
    const StatedMember& m = c.answer.members[static_cast<std::size_t>(k)];
    out.x.row(k) = TermsOf(m, c.answer.features).transpose();
    // of several right ones (two effects) the most probable
    const bool right = c.right[static_cast<std::size_t>(k)] != 0;
    if (right && m.probability > best) best = m.probability, out.right = k;
  }
  if (best < 0) out.right = n - static_cast<Index>(kOthers);
  return out;
}

/// -ln of the posterior.
double Cost(const std::vector<CaseTerms>& cases, const TermVector& w, const TermVector& prior) {
  double cost = (w - prior).squaredNorm() / (2 * kPriorSd * kPriorSd);
  for (const CaseTerms& c : cases) cost -= std::log(std::max(1e-300, Softmax(c.x * w)[c.right]));
  return cost;
}

}  // namespace

StatedAnswer StatedAnswerOf(const Explanation& e) {
  StatedAnswer out;
  double names = 0, unknown = 0, data = 0;
  for (const RankedEffect& r : e.ranking) {
    out.members.push_back({r.effect.name, r.effect.target, r.probability});
    names += r.probability;
  }
  for (const SetMember& m : e.set) {
    if (m.effect == "unknown") unknown = m.probability;
    if (m.effect == "data") data = m.probability;
  }
  // The set leaves "unknown" out where it is improbable; what the names do not have is its own.
  const double rest = std::max(0.0, 1 - names - data);
  const bool quiet =
      e.verdict == ExplanationVerdict::kNone || e.verdict == ExplanationVerdict::kParameters;
  if (!quiet) unknown = rest;
  out.members.push_back({"unknown", "", unknown});
  out.members.push_back({"quiet", "", quiet ? rest - unknown : 0});
  out.members.push_back({"data", "", data});
  double shift = 0;
  for (std::size_t k = 0; k < e.final_fit.hypothesis.free.size(); ++k)
    if (e.final_fit.hypothesis.free[k].effect < 0)
      shift = std::max(shift, std::abs(e.final_fit.hypothesis.Coordinate(k)));
  const auto log_floors = [](double floors) { return std::log(std::max(1.0, floors)); };
  out.features = {1 - e.closure.explained, log_floors(e.closure.floors_after), shift / 3,
                  log_floors(e.closure.floors_before),
                  e.remainder.kind == RemainderKind::kOther ? 1.0 : 0.0};
  for (double& f : out.features) f = std::isfinite(f) ? std::clamp(f, 0.0, 3.0) : 3.0;
  return out;
}

std::vector<double> CalibratedProbabilities(const CalibrationWeights& weights,
                                            const StatedAnswer& answer) {
  const TermVector w = Eigen::Map<const TermVector>(weights.data());
  Eigen::VectorXd z(static_cast<Index>(answer.members.size()));
  for (Index k = 0; k < z.size(); ++k)
    z[k] = TermsOf(answer.members[static_cast<std::size_t>(k)], answer.features).dot(w);
  const Eigen::VectorXd p = Softmax(z);
  return {p.data(), p.data() + p.size()};
}

CalibrationWeights FitCalibration(const std::vector<CalibrationCase>& cases) {
  std::vector<CaseTerms> terms;
  for (const CalibrationCase& c : cases) terms.push_back(TermsOfCase(c));
  TermVector prior = TermVector::Zero();
  prior[0] = 1;
  TermVector w = prior;
  for (int iteration = 0; iteration < 100; ++iteration) {
    TermVector slope = (w - prior) / (kPriorSd * kPriorSd);
    Eigen::Matrix<double, TermVector::RowsAtCompileTime, TermVector::RowsAtCompileTime> bend =
        decltype(bend)::Identity() / (kPriorSd * kPriorSd);
    for (const CaseTerms& c : terms) {
      const Eigen::VectorXd p = Softmax(c.x * w);
      const TermVector mean = c.x.transpose() * p;
      slope += mean - c.x.row(c.right).transpose();
      bend += c.x.transpose() * p.asDiagonal() * c.x - mean * mean.transpose();
    }
    const TermVector step = bend.ldlt().solve(slope);
    double part = 1;
    const double now = Cost(terms, w, prior);
    while (part > 1e-6 && Cost(terms, w - part * step, prior) > now) part /= 2;
    w -= part * step;
    if (part * step.norm() < 1e-10) break;
  }
  CalibrationWeights out;
  std::copy(w.data(), w.data() + w.size(), out.begin());
  return out;
}

CalibrationTable MakeCalibration(const std::vector<CalibrationCase>& cases) {
  CalibrationTable table;
  table.weights = FitCalibration(cases);
  table.cases = static_cast<int>(cases.size());
  std::vector<double> scores;
  for (const CalibrationCase& c : cases) {
    const std::vector<double> p = CalibratedProbabilities(table.weights, c.answer);
    double best = 0;
    for (std::size_t k = 0; k < p.size(); ++k)
      if (c.right[k]) best = std::max(best, p[k]);
    scores.push_back(1 - best);
  }
  table.least = LeastProbabilityOfSet(scores, kLevel);
  return table;
}

std::vector<SetMember> CalibratedSet(const CalibrationTable& table, const StatedAnswer& answer,
                                     const std::string& quiet_name) {
  const std::vector<double> p = CalibratedProbabilities(table.weights, answer);
  std::vector<SetMember> all, set;
  for (std::size_t k = 0; k < p.size(); ++k) {
    const StatedMember& m = answer.members[k];
    all.push_back({m.effect == "quiet" ? quiet_name : m.effect, m.target, p[k]});
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const auto& a, const auto& b) { return a.probability > b.probability; });
  for (const SetMember& m : all)
    if (set.empty() || m.probability >= table.least) set.push_back(m);
  return set;
}

void Calibrate(const CalibrationTable& table, Explanation& e) {
  const StatedAnswer answer = StatedAnswerOf(e);
  const std::vector<double> p = CalibratedProbabilities(table.weights, answer);
  for (std::size_t k = 0; k < e.ranking.size(); ++k) e.ranking[k].probability = p[k];
  e.set =
      CalibratedSet(table, answer, e.verdict == ExplanationVerdict::kNone ? "none" : "parameters");
}

}  // namespace ambrig
