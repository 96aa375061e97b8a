#include "design/run_study.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "campaign/parameter_draw.h"
#include "campaign/run_rows.h"
#include "design/nlopt_search.h"
#include "design/pareto.h"
#include "design/study_journal.h"

namespace ambrig {

namespace {

constexpr double kFailed = 1e6, kPerLimit = 10, kSum = 0.05;

/// Evaluates what the journal does not know.
class Evaluator {
 public:
  Evaluator(const Study& study, StudyJournal& journal, const StudyOptions& options)
      : study_(study), journal_(journal), options_(options) {}

  Evaluation At(std::size_t candidate, const std::vector<double>& values) {
    if (options_.stop && options_.stop->load()) throw Interrupted();
    if (const auto known = journal_.Find(candidate, values)) return *known;
    const Evaluation e = Evaluate(study_, candidate, values, options_.stop);
    journal_.Add(candidate, values, e);
    if (options_.progress) options_.progress(journal_.size(), expected_);
    return e;
  }
  void Expect(std::size_t points) { expected_ = points; }

 private:
  const Study& study_;
  StudyJournal& journal_;
  const StudyOptions& options_;
  std::size_t expected_ = 0;
};

std::vector<double> StartOf(const DesignCandidate& c) {
  std::vector<double> values;
  for (const DesignVariable& v : c.variables) values.push_back(v.start);
  return values;
}

/// The points of a candidate in a sweep, its own numbers first.
std::vector<std::vector<double>> SweepOf(const Study& study, const DesignCandidate& c) {
  std::vector<std::vector<double>> out{StartOf(c)};
  if (c.variables.empty()) return out;
  if (!c.variables.front().values.empty()) {
    std::size_t count = 1;
    for (const DesignVariable& v : c.variables) count *= v.values.size();
    for (std::size_t k = 0; k < count; ++k) {
      std::vector<double> values;
      std::size_t rest = k;
      for (const DesignVariable& v : c.variables) {
        values.push_back(v.values[rest % v.values.size()]);
        rest /= v.values.size();
      }
      out.push_back(values);
    }
    return out;
  }
  const int n = static_cast<int>(c.variables.size());
  const UnitPoints unit = n <= kSobolDimensions ? Sobol(study.points, n, study.seed)
                                                : LatinHypercube(study.points, n, study.seed);
  for (const auto& u : unit) {
    std::vector<double> values;
    for (std::size_t k = 0; k < u.size(); ++k) values.push_back(c.variables[k].FromUnit(u[k]));
    out.push_back(values);
  }
  return out;
}

void InParallel(std::size_t count, int jobs, const std::function<void(std::size_t)>& task) {
  std::vector<std::size_t> all(count);
  std::iota(all.begin(), all.end(), std::size_t{0});
  OnAllCores(all, jobs, nullptr, task);
}

/// Ways to weigh the objectives: all alike, each one foremost, then Sobol's.
std::vector<std::vector<double>> Directions(const Study& study) {
  const std::size_t m = study.Objectives().size();
  std::vector<std::vector<double>> out{std::vector<double>(m, 1.0)};
  for (std::size_t j = 0; j < m && m > 1; ++j) {
    out.emplace_back(m, 0.1);
    out.back()[j] = 1;
  }
  if (m <= static_cast<std::size_t>(kSobolDimensions) && m > 1)
    for (const auto& u : Sobol(study.directions, static_cast<int>(m), study.seed)) {
      out.emplace_back();
      for (const double v : u) out.back().push_back(std::max(0.05, v));
    }
  out.resize(std::min(out.size(), static_cast<std::size_t>(study.directions)));
  return out;
}

/// One number of the objectives, by the direction's weights; limits exceeded cost.
double Scalar(const Study& study, const std::vector<double>& figures,
              const std::vector<double>& weights, const std::vector<double>& scales) {
  double most = 0, sum = 0, excess = 0;
  std::size_t j = 0;
  for (std::size_t k = 0; k < figures.size(); ++k) {
    const FigureSpec& f = study.figures[k];
    if (!std::isfinite(figures[k])) return kFailed;
    if (f.at_most)
      excess +=
          std::max(0.0, figures[k] - *f.at_most) / (*f.at_most != 0 ? std::abs(*f.at_most) : 1);
    if (!f.objective) continue;
    const double part = weights[j] * figures[k] / scales[j];
    most = std::max(most, part);
    sum += part;
    ++j;
  }
  return std::min(kFailed, most + kSum * sum + kPerLimit * excess);
}

std::vector<double> ScalesOf(const Study& study, const Evaluation& start) {
  std::vector<double> scales;
  for (const std::size_t k : study.Objectives())
    scales.push_back(
        std::isfinite(start.figures[k]) && start.figures[k] != 0 ? std::abs(start.figures[k]) : 1);
  return scales;
}

using Asked = std::vector<std::vector<double>>;

/// Every point that one search asks for, in its order.
Asked SearchDirection(const Study& study, Evaluator& evaluator, std::size_t candidate,
                      const std::vector<double>& weights, const std::vector<double>& scales) {
  const DesignCandidate& c = study.candidates[candidate];
  Asked asked{StartOf(c)};
  std::vector<double> start;
  for (const DesignVariable& v : c.variables) start.push_back(v.ToUnit(v.start));
  if (start.empty()) {
    evaluator.At(candidate, asked[0]);
    return asked;
  }
  SearchUnitCube(
      [&](const std::vector<double>& u) {
        std::vector<double> values;
        for (std::size_t k = 0; k < u.size(); ++k) values.push_back(c.variables[k].FromUnit(u[k]));
        asked.push_back(values);
        return Scalar(study, evaluator.At(candidate, values).figures, weights, scales);
      },
      start, study.evaluations);
  return asked;
}

/// Points in order, each once, with their results from the journal.
StudyResult Gather(const Study& study,
                   const std::vector<std::vector<std::vector<double>>>& per_candidate,
                   const StudyJournal& journal) {
  StudyResult out;
  for (std::size_t c = 0; c < per_candidate.size(); ++c) {
    std::set<std::vector<double>> seen;
    for (const auto& values : per_candidate[c]) {
      if (!seen.insert(values).second) continue;
      const auto e = journal.Find(c, values);
      if (!e)
        throw InputError(study.file +
                         ": the study is not finished, allowed: run ambrig design first");
      out.points.push_back({c, values, *e, MeetsLimits(study, e->figures), false});
    }
  }
  out.scales = ScalesOf(study, out.points.front().result);
  std::vector<std::vector<double>> objectives;
  for (const StudyPoint& p : out.points) {
    objectives.emplace_back();
    for (const std::size_t k : study.Objectives())
      objectives.back().push_back(p.feasible ? p.result.figures[k] : kInfinity);
  }
  for (const std::size_t k : ParetoFront(objectives)) out.points[k].front = true;
  return out;
}

}  // namespace

StudyResult RunStudy(const Study& study, const StudyOptions& options) {
  StudyJournal journal(options.folder, study);
  Evaluator evaluator(study, journal, options);
  const std::size_t candidates = study.candidates.size();
  std::vector<std::vector<std::vector<double>>> points(candidates);
  if (study.method == SearchMethod::kSweep) {
    std::vector<std::pair<std::size_t, std::vector<double>>> all;
    for (std::size_t c = 0; c < candidates; ++c) {
      points[c] = SweepOf(study, study.candidates[c]);
      for (const auto& values : points[c]) all.emplace_back(c, values);
    }
    evaluator.Expect(all.size());
    InParallel(all.size(), options.jobs,
               [&](std::size_t k) { evaluator.At(all[k].first, all[k].second); });
    return Gather(study, points, journal);
  }
  const auto directions = Directions(study);
  evaluator.Expect(candidates * directions.size() * static_cast<std::size_t>(study.evaluations));
  InParallel(candidates, options.jobs,
             [&](std::size_t c) { evaluator.At(c, StartOf(study.candidates[c])); });
  const auto scales = ScalesOf(study, evaluator.At(0, StartOf(study.candidates[0])));
  std::vector<Asked> asked(candidates * directions.size());
  InParallel(asked.size(), options.jobs, [&](std::size_t k) {
    asked[k] = SearchDirection(study, evaluator, k / directions.size(),
                               directions[k % directions.size()], scales);
  });
  for (std::size_t k = 0; k < asked.size(); ++k) {
    auto& to = points[k / directions.size()];
    to.insert(to.end(), asked[k].begin(), asked[k].end());
  }
  return Gather(study, points, journal);
}

}  // namespace ambrig
