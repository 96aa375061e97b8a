#include "fdd/learning/commissioning_fit.h"

#include <algorithm>
#include <numbers>

#include "fdd/learning/circuit_fit.h"

namespace ambrig {

namespace {

constexpr double kKneePays = 0.98;  // of the cost
// Offsets trade against resistances and slow relaxations: only for a model that does not express
// the plant without.
constexpr double kOffsetPays = 0.7;
// Eight parameters more may express something else than run-out.
constexpr double kRunOutPays = 0.7;
// of the half-order laws that are tried first [Hz]
constexpr double kStarts[] = {1e7, 1e5, 3e4, 1e4, 2e3, 400};

constexpr ParameterSet kStraight = ParametersFrom(0, kFirstKnee),
                       kKnees = ParametersFrom(kFirstKnee, kFirstRunOut),
                       kRunOut = ParametersFrom(kFirstRunOut, kCircuitParameters);

/// Cost of a model that leaves little but scatter.
double WellFitted(const CircuitFit& fit) { return 1.5 * static_cast<double>(fit.size()); }

struct Found {
  CircuitParameters parameters;
  CoilEquations coils;
  double cost = kInfinity;
};

/// Iron that bends: the knees alone from a start, then `all` parameters together where that
/// costs less than `promising`; kept where the end costs less than `most` and than what
/// was found before.
void TryKnees(CircuitFit& fit, Found start, ParameterSet knees, ParameterSet all, double promising,
              double most, Found* found) {
  if (!(fit.Descend(&start.parameters, knees, &start.coils) < promising)) return;
  start.cost = fit.Descend(&start.parameters, all, &start.coils);
  if (start.cost < std::min(most, found->cost)) *found = start;
}

/// Both knees from the best circuit `straight`.
void TryBothKnees(CircuitFit& fit, const Found& straight, ParameterSet all, Found* found) {
  const double most = kKneePays * straight.cost;
  TryKnees(fit, straight, kKnees, all, most, most, found);
}

/// Either knee alone from the best circuit `straight` and from where it started: both look much
/// alike, and a step along both may leave one of them at its limit of 0.
void TryEachKnee(CircuitFit& fit, const Found& straight, const Found& start, ParameterSet all,
                 Found* found) {
  for (const int knee : {kFirstKnee, kFirstKnee + 1})
    for (const Found& from : {straight, start})
      TryKnees(fit, from, ParametersFrom(knee, knee + 1), all, kInfinity, kKneePays * straight.cost,
               found);
}

/// The circuit of position sensors that see surfaces which are not round.
struct OutOfRound {
  Found start, straight;  // the errors alone, and with the circuit
};
OutOfRound FitRunOut(CircuitFit& fit, const Found& straight) {
  OutOfRound out{straight, {}};
  fit.Descend(&out.start.parameters, kRunOut, &out.start.coils);
  out.straight = out.start;
  out.straight.cost =
      fit.Descend(&out.straight.parameters, kStraight | kRunOut, &out.straight.coils);
  return out;
}

/// Run-out beside iron that bends.
void TryRunOutWithKnees(CircuitFit& fit, const OutOfRound& round, Found* found) {
  constexpr ParameterSet kAll = kStraight | kKnees | kRunOut;
  Found best = round.straight;
  TryBothKnees(fit, round.straight, kAll, &best);
  if (best.cost > WellFitted(fit)) TryEachKnee(fit, round.straight, round.start, kAll, &best);
  if (best.cost < kRunOutPays * found->cost) *found = best;
}

/// Bridges that add a voltage of their own: again from the start's circuit and from the best
/// found, with offsets.
void TryOffsets(CircuitFit& fit, const Found& straight, Found* found) {
  fit.AllowOffsets();
  const double most = kOffsetPays * found->cost;
  for (Found from : {straight, *found}) {
    from.cost = fit.Descend(&from.parameters, kStraight, &from.coils);
    if (from.cost < std::min(most, found->cost)) *found = from;
  }
}

/// Whether the shaft turned more than once: else run-out looks like a zero of the sensors.
bool Turned(const CommissioningLog& log) {
  double least = kInfinity, most = -kInfinity;
  for (std::size_t n = 0; n < log.size(); ++n) {
    const double angle = log.At(n).angle0;
    least = std::min(least, angle);
    most = std::max(most, angle);
  }
  return most - least > 2 * std::numbers::pi;
}

/// What a plant may have that leaves much: run-out, iron of one knee, both, voltages
/// of the bridges.
void TryMore(CircuitFit& fit, const Found& start, const Found& straight, bool turned,
             Found* found) {
  OutOfRound round;
  if (turned) {
    round = FitRunOut(fit, straight);
    if (round.straight.cost < std::min(WellFitted(fit), kRunOutPays * found->cost)) {
      *found = round.straight;
      return;
    }
  }
  TryEachKnee(fit, straight, start, kStraight | kKnees, found);
  if (turned && found->cost > WellFitted(fit)) TryRunOutWithKnees(fit, round, found);
  if (found->cost > WellFitted(fit)) TryOffsets(fit, straight, found);
}

}  // namespace

CommissionedBearing FitCommissioning(const std::string& name, const LinkageModel& nominal,
                                     const SamplingSettings& sampling,
                                     const ExcessSettings& settings, const CommissioningLog& log) {
  CommissionedBearing out = NominalBearing(name, nominal);
  CircuitFit fit(nominal, sampling, settings, log);
  if (fit.size() < 100) return out;
  Found start{StartAt(kStarts[0]), {}};  // where no start has a cost
  for (const double cutoff : kStarts) {
    const CircuitParameters at = StartAt(cutoff);
    const EvaluatedCircuit tried = fit.Evaluate(at);
    if (tried.cost < start.cost) start = {at, tried.coils, tried.cost};
  }
  Found straight = start;
  straight.cost = fit.Descend(&straight.parameters, kStraight, &straight.coils);
  Found found = straight;
  TryBothKnees(fit, straight, kStraight | kKnees, &found);
  if (found.cost > WellFitted(fit)) TryMore(fit, start, straight, Turned(log), &found);
  out.circuit = CircuitOf(found.parameters, nominal.gap_offset[0]);
  out.coils = found.coils;
  out.learnt = true;
  out.rows = static_cast<long long>(fit.size());
  out.grade = found.cost / static_cast<double>(fit.size());
  return out;
}

}  // namespace ambrig
