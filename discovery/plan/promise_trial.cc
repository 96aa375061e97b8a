#include "discovery/plan/promise_trial.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/errors.h"
#include "discovery/experiment/measured_case.h"
#include "discovery/explain/explain.h"
#include "discovery/plan/plan.h"
#include "effects/effect.h"

namespace ambrig {

namespace {

constexpr double kTold = 0.95;  // of a name: the first record tells it already, rightly or not
constexpr double kPromises[] = {0.99, 0.95, 0.8, 0.5};

struct Pair {
  NamedEffect right, other;
  double share = 0;  // of the right one
};

bool IsRight(const PracticeCase& made, const NamedEffect& name) {
  return std::ranges::count(made.answer.slots[0], name) > 0;
}

double ProbabilityOf(const Explanation& e, const NamedEffect& name) {
  for (const RankedEffect& r : e.ranking)
    if (NamedEffect(r.effect.name, r.effect.target) == name) return r.probability;
  return 0;
}

double ShareOfRight(const Explanation& e, const NamedEffect& right, const NamedEffect& other) {
  const double a = ProbabilityOf(e, right), b = ProbabilityOf(e, other);
  return a + b > 0 ? a / (a + b) : 0.5;
}

/// The right name and the most probable of the others. @throws InputError where one of them is
/// missing
Pair PairOf(const PracticeCase& made, const Explanation& e) {
  Pair pair;
  for (const RankedEffect& r : e.ranking) {
    NamedEffect& place = IsRight(made, {r.effect.name, r.effect.target}) ? pair.right : pair.other;
    if (place.first.empty()) place = {r.effect.name, r.effect.target};
  }
  if (pair.right.first.empty()) throw InputError("the right name is not among the candidates");
  if (pair.other.first.empty()) throw InputError("there is no other name");
  pair.share = ShareOfRight(e, pair.right, pair.other);
  return pair;
}

/// The planned record as the true rig makes it.
CaseRecord MeasuredRecord(const PracticeCase& made, const Case& few, const Plan& plan,
                          std::uint64_t seed) {
  Case next = EmptyCase(few.rig, {{plan.title, plan.toml}});
  KeepChannels(next.records[0], {plan.channels.begin(), plan.channels.end()});
  next.noise = few.noise;
  const CaseModel model(next);
  Hypothesis truth;
  truth.rig = made.truth;
  MeasureRecord(model, truth, 0, seed, UsualLoadCellNoise(few.rig), next);
  return next.records[0];
}

}  // namespace

PromiseTrial TryPromise(const PracticeCase& made, const Case& read, const PromiseOptions& options) {
  if (made.kind != "one") throw InputError(made.name + ": hides not one effect");
  PromiseTrial trial;
  trial.name = made.name;
  trial.rig = made.rig;
  trial.law = made.laws.at(0);
  Case few = read;
  few.records = {read.records.at(options.first)};
  few.records[0].validate = false;
  const auto part = [&](double from, double to) {
    return [&options, from, to](double f, const std::string& text) {
      if (options.progress) options.progress(from + f * (to - from), text);
    };
  };
  ExplainOptions explain;
  explain.calibrate = false;
  explain.stop = options.stop;
  explain.progress = part(0, 0.3);
  Pair pair;
  try {
    pair = PairOf(made, Explain(few, explain));
  } catch (const InputError& e) {
    trial.left_out = e.what();
    return trial;
  }
  trial.right = NameAtTarget(pair.right.first, pair.right.second);
  trial.other = NameAtTarget(pair.other.first, pair.other.second);
  trial.before = pair.share;
  if (std::max(pair.share, 1 - pair.share) > kTold) {
    trial.left_out = pair.share > kTold ? "the first record tells it"
                                        : "the first record speaks for the other name";
    return trial;
  }
  PlanOptions planning;
  planning.draws = options.draws;
  planning.stop = options.stop;
  planning.progress = part(0.3, 0.6);
  const Plan plan = PlanForCase(few, {pair.right, pair.other}, planning);
  trial.record = plan.title;
  trial.promise = plan.separates.at(0).probability;
  few.records.push_back(MeasuredRecord(made, few, plan, options.seed));
  explain.progress = part(0.6, 1);
  trial.planned = {plan.toml, few.records.back().data};
  trial.after = ShareOfRight(Explain(few, explain), pair.right, pair.other);
  return trial;
}

std::vector<PromiseBin> PromisesKept(const std::vector<PromiseTrial>& trials) {
  std::vector<PromiseBin> bins;
  double to = 1;
  for (const double from : kPromises) {
    std::size_t found = 0, all = 0;
    for (const PromiseTrial& t : trials) {
      if (!t.left_out.empty() || t.promise < from || (t.promise >= to && to < 1)) continue;
      ++all;
      found += t.found() ? 1 : 0;
    }
    bins.push_back({from, to, ShareOf(found, all)});
    to = from;
  }
  return bins;
}

}  // namespace ambrig
