#include "fdd/learning/commissioning_fit.h"

#include <algorithm>

#include "fdd/learning/circuit_fit.h"

namespace ambrig {

namespace {

constexpr double kKneePays = 0.98;  // of the cost
// Offsets trade against resistances and slow relaxations: only for a model that does not express the plant without.
constexpr double kOffsetPays = 0.7;
constexpr double kWellFitted = 1.5;  // cost of a row, of a model that leaves little but scatter
// of the half-order laws that are tried first [Hz]
constexpr double kStarts[] = {1e7, 1e5, 3e4, 1e4, 2e3, 400};

struct Found {
  CircuitParameters parameters;
  CoilEquations coils;
  double cost = kInfinity;
};

/// Iron that bends: the knees `first` to `last` alone from a start, then all parameters together where that costs less
/// than `promising`; kept where the end costs less than `most` and than what was found before.
void TryKnees(CircuitFit& fit, Found start, int first, int last, double promising, double most,
              Found* found) {
  if (!(fit.Descend(&start.parameters, first, last, &start.coils) < promising)) return;
  start.cost = fit.Descend(&start.parameters, 0, kWithKnees, &start.coils);
  if (start.cost < std::min(most, found->cost)) *found = start;
}

/// Bridges that add a voltage of their own: again from the start's circuit and from the best found, with offsets.
void TryOffsets(CircuitFit& fit, const Found& straight, Found* found) {
  fit.AllowOffsets();
  const double most = kOffsetPays * found->cost;
  for (Found from : {straight, *found}) {
    from.cost = fit.Descend(&from.parameters, 0, kCircuitParameters, &from.coils);
    if (from.cost < std::min(most, found->cost)) *found = from;
  }
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
  straight.cost = fit.Descend(&straight.parameters, 0, kCircuitParameters, &straight.coils);
  Found found = straight;
  const double most = kKneePays * straight.cost;
  TryKnees(fit, straight, kCircuitParameters, kWithKnees, most, most, &found);
  // Both knees look much alike: a step along both may leave one of them at its limit of 0.
  if (found.cost > kWellFitted * static_cast<double>(fit.size()))
    for (const int knee : {kCircuitParameters, kCircuitParameters + 1})
      for (const Found& from : {straight, start})
        TryKnees(fit, from, knee, knee + 1, kInfinity, most, &found);
  if (found.cost > kWellFitted * static_cast<double>(fit.size())) TryOffsets(fit, straight, &found);
  out.circuit = CircuitOf(found.parameters, nominal.gap_offset[0]);
  out.coils = found.coils;
  out.learnt = true;
  out.rows = static_cast<long long>(fit.size());
  out.grade = found.cost / static_cast<double>(fit.size());
  return out;
}

}  // namespace ambrig
