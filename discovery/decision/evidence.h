#pragma once
/// What is known after the search, in three answers instead of one threshold: the names that may be
/// right (with "unknown" among them), the share of the error that they explain, and what remains.
#include <string>
#include <vector>

#include "discovery/decision/verdict.h"
#include "discovery/search/effect_round.h"

namespace ambrig {

/// Ratio of a channel of a record below which its error may be noise, and is no sign of an effect.
inline constexpr double kChannelNoise = 1.3;

/// A member of the set that holds the right answer with 95 %. `effect` may be "none", "data" or
/// "unknown"; these have no target.
struct SetMember {
  std::string effect, target;
  double probability = 0;
};

/// How far an explanation closes the error, over all records: 1 of `explained` leaves the noise.
struct Closure {
  double explained = 0;                        // share of the squared error above the floor
  double floors_before = 0, floors_after = 0;  // rms over the noise floor, all records
  // of the records of the test, else of those that were not fitted; nan: none
  double test_before = 0, test_after = 0;
};

struct RemainderPlace {
  std::string record, channel;
  double ratio = 0;
};

struct Remainder {
  RemainderKind kind = RemainderKind::kNone;
  std::vector<RemainderPlace> where;
  std::string text;
};

/// `before`: rig parameters alone, `after`: everything that was found; residuals over the floor.
Closure ClosureOf(const CaseModel& model, const std::vector<double>& before,
                  const std::vector<double>& after);

/// The channels and records that stay above the floor, worst first. What is left is of the law's
/// usual variation when the explanation closes nine tenths of the error and no channel keeps more
/// than a third of its own; else it is of another origin.
Remainder RemainderOf(const CaseModel& model, const std::vector<double>& before,
                      const std::vector<double>& after, const Closure& closure, bool any_effect);

/// How probable it is that one of the fitted candidates, and not something unknown, made the error:
/// rises with the share that the best one explains, on the fitted and on the unseen records.
/// `share`: the smaller of both, `floors_after`: the larger error that remains.
double NameProbability(double share, double floors_after);

/// Scales the probabilities of a ranking (they sum to 1 among its members) to `named` and returns
/// the smallest set that holds 95 %, "unknown" included, best first.
std::vector<SetMember> CredibleSet(std::vector<RankedEffect>& ranking, double named);

/// Whether at least one size of the effect (a parameter that switches it off at its null) is known
/// to differ from nothing by three of its own sd. A size whose sd is not known counts as seen.
bool HasSize(const EffectInstance& effect);
/// The same of effect number `effect` of a fit, with the shape of its law held: a size that is
/// known but for a time constant it goes with (a slow rise tells their quotient) is there all the
/// same.
bool HasSize(const FitResult& fit, std::size_t effect);
/// Whether it differs by two of the sd under doubt of the last fit (last_fit.h).
bool HasSizeUnderDoubt(const FitResult& fit, std::size_t effect);

/// Whether the size came out with a sign that its physics never has (a magnetic pull that holds the
/// shaft back).
bool HasImpossibleSign(const EffectInstance& effect);

/// Whether the effect is a detail of the law of one of `adopted`: it acts on the same coil or the
/// same axis of a sensor, and each of its sizes is less than half of the smallest usual one.
bool IsDetailOf(const std::vector<EffectInstance>& adopted, const EffectInstance& effect);

}  // namespace ambrig
