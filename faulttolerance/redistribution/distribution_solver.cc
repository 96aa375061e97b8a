#include "faulttolerance/redistribution/distribution_solver.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "faulttolerance/redistribution/program_search.h"

namespace ambrig {
namespace {

constexpr double kLargestEntry = 50;  // of an acceptable W, healthy 1
constexpr double kSolved = 1e-9;      // equation error
constexpr double kFeasible = 1e-6;    // of a search's result, before it is polished
constexpr double kCapacityKept = 0.99998;
constexpr double kHop = 0.07;        // of the largest entry, once to three times
constexpr double kErrorWeight = 20;  // of the error of a linearised W at the disc's edge, ...
constexpr double kErrorWeightForReach = 2;  // ... and while its largest disc is searched

/// Counter-based uniform and normal numbers (SplitMix64): start n is the same for any order.
class Draws {
 public:
  Draws(std::uint64_t seed, int start)
      : state_(seed * 0x9E3779B97F4A7C15u + static_cast<unsigned>(start) * 0xD1B54A32D192ED03u) {}
  double Uniform() {
    std::uint64_t z = state_ += 0x9E3779B97F4A7C15u;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return (static_cast<double>((z ^ (z >> 31)) >> 11) + 0.5) * 0x1p-53;
  }
  double Normal() {
    const double r = std::sqrt(-2 * std::log(Uniform()));
    return r * std::cos(2 * std::numbers::pi * Uniform());
  }

 private:
  std::uint64_t state_;
};

DistributionMatrix RandomMatrix(std::uint64_t seed, int start, bool positive) {
  Draws draws(seed, start);
  DistributionMatrix W;
  for (int j = 0; j < 8; ++j) {
    W(j, 0) = positive ? std::abs(1 + 0.7 * draws.Normal()) : 1.3 * draws.Normal();
    W(j, 1) = 0.7 * draws.Normal();
    W(j, 2) = 0.7 * draws.Normal();
  }
  return W;
}

int LiveCount(const RedistributionProblem& problem) {
  return static_cast<int>((problem.turns_left.array() > 0).count());
}

/// Whether some start reaches the first `equations` equations with moderate entries.
bool Reachable(const RedistributionProblem& problem, const ForceForms& forms, int equations) {
  const int live = LiveCount(problem);
  if (live < 2) return false;
  const DistributionProgram program(problem, forms, equations, {});
  for (int start = 0; start < (live > 4 ? 100 : 200); ++start) {
    SmallVector x = program.FromMatrix(RandomMatrix(7, start, false));
    if (SolveEquations(program, x, kLargestEntry, 100) < kSolved) return true;
  }
  return false;
}

struct Candidate {
  DistributionMatrix W;
  double objective;
};

/// Search from one W; nothing when it ends outside the bounds. The equations are met to rounding.
std::optional<Candidate> Search(const DistributionProgram& program,
                                const DistributionMatrix& start) {
  const ProgramSearch r = SearchProgram(program, program.FromMatrix(start), 1e-7);
  if (!(r.infeasibility < kFeasible)) return {};
  SmallVector x = r.x;
  if (program.equations() > 0 && SolveEquations(program, x, 2 * kLargestEntry, 20) > kSolved)
    return {};
  return Candidate{program.ToMatrix(x), r.objective};
}

/// b -> a b, w -> w / a, so that the disc within the amplifiers' range is largest.
DistributionMatrix WidestDisc(const RedistributionProblem& problem, DistributionMatrix W) {
  const auto scaled = [&](double a) {
    DistributionMatrix V = W / a;
    V.col(0) = a * W.col(0);
    return V;
  };
  double lo = 1e-3, hi = 1e3;  // WorkingDisc first grows, then falls with a
  for (int k = 0; k < 100; ++k) {
    const double p = std::pow(lo, 2.0 / 3) * std::pow(hi, 1.0 / 3), q = lo * hi / p;
    const double fp = WorkingDisc(problem, scaled(p)), fq = WorkingDisc(problem, scaled(q));
    (fp < fq ? lo : hi) = fp < fq ? p : q;
  }
  return scaled(std::sqrt(lo * hi));
}

class Solver {
 public:
  Solver(const RedistributionProblem& problem, const DistributionOptions& options)
      : p_(problem), o_(options), forms_(MakeForceForms(problem)) {}

  Distribution Solve() {
    const SolvabilityClass cls = Classify(p_);
    if (LiveCount(p_) == 0) return Describe(p_, cls, DistributionMatrix::Zero());
    if (cls == SolvabilityClass::kExact) return Describe(p_, cls, ExactOrFurther());
    if (cls == SolvabilityClass::kLinearised)
      if (const auto W = Linearised()) return Describe(p_, cls, *W);
    return Describe(p_, cls, Best(0).value_or(DistributionMatrix::Zero()));
  }

  double FluxCapacityFound() {
    DistributionProgram program(p_, forms_, 12, {.T = 1, .bias = 1e-5, .control = 1e-5});
    program.BoundFluxes();
    double best = 0;
    const std::vector<Candidate> found = Multistart(program, 12, false, 4 * o_.starts);
    for (const Candidate& c : found) best = std::max(best, FluxCapacity(forms_, c.W));
    return best;
  }

 private:
  DistributionMatrix ExactOrFurther() const {
    const auto exact = Best(12);
    const double rho = exact ? WorkingDisc(p_, *exact) : 0;
    if (o_.policy == DistributionPolicy::kControl && rho < o_.rho_needed) {
      const auto linearised = Best(6);
      if (linearised && WorkingDisc(p_, *linearised) >= o_.rho_needed) return *linearised;
    }
    if (exact) return *exact;
    return AnySign().Best(12).value_or(DistributionMatrix::Zero());
  }

  /// Nothing for kControl when currents of one sign cannot do it: the least error serves better
  /// there than currents that the amplifiers would clip.
  std::optional<DistributionMatrix> Linearised() const {
    const auto W = Best(6);
    return W || o_.policy == DistributionPolicy::kControl ? W : AnySign().Best(6);
  }

  /// The same bearing with currents of any sign; the figure `unipolar` tells.
  Solver AnySign() const {
    RedistributionProblem p = p_;
    p.quadrants = 4;
    return Solver(p, o_);
  }

  /// From random starts, then from disturbed copies of the best so far; best first.
  std::vector<Candidate> Multistart(const DistributionProgram& program, int equations,
                                    bool positive, int starts) const {
    std::vector<Candidate> found;
    const auto search = [&](const DistributionMatrix& from) {
      SmallVector x = program.FromMatrix(from);
      if (equations > 0) SolveEquations(program, x, kLargestEntry, 100);
      const auto c = Search(program, program.ToMatrix(x));
      if (!c) return;
      const auto worse = [](const Candidate& a, const Candidate& b) {
        return a.objective < b.objective;
      };
      found.insert(std::upper_bound(found.begin(), found.end(), *c, worse), *c);
    };
    for (int start = 0; start < starts; ++start) search(RandomMatrix(o_.seed, start, positive));
    for (int hop = 0; hop < starts && !found.empty(); ++hop) {
      const DistributionMatrix noise = RandomMatrix(o_.seed, starts + hop, false);
      search(found[0].W + kHop * (1 + hop % 3) * found[0].W.cwiseAbs().maxCoeff() * noise);
    }
    return found;
  }

  /// Largest capacity first; for the capacity T is minimised with the disc |v| <= c0.
  std::vector<Candidate> ByCapacity(int equations) const {
    DistributionProgram::Weights weights{.T = 1, .bias = 1e-5, .control = 1e-5};
    if (equations < 12) weights.error = equations == 6 ? kErrorWeightForReach : kErrorWeight;
    DistributionProgram program(p_, forms_, equations, weights);
    program.BoundCurrents(1);
    const bool positive = p_.quadrants == 2;  // signs free: far more optima
    return Multistart(program, equations, positive, positive ? o_.starts : 5 * o_.starts);
  }

  /// The least stiff W with the disc |v| <= rho c0, from the candidates and from new starts.
  std::optional<Candidate> LeastStiff(int equations, double rho,
                                      const std::vector<Candidate>& candidates) const {
    DistributionProgram::Weights weights{
        .stiffness = 1, .bias = o_.bias_weight, .control = o_.control_weight};
    if (equations < 12) weights.error = kErrorWeight * (equations == 6 ? rho * rho : 1);
    DistributionProgram program(p_, forms_, equations, weights);
    program.BoundCurrents(rho, p_.i_max / p_.c0);
    std::optional<Candidate> best;
    const auto keep = [&](const std::optional<Candidate>& c) {
      if (c && WorkingDisc(p_, c->W) >= rho * (1 - 1e-6) &&
          (!best || c->objective < best->objective))
        best = c;
    };
    for (const Candidate& c : candidates) keep(Search(program, WidestDisc(p_, c.W)));
    if (o_.policy == DistributionPolicy::kControl)
      for (const Candidate& c : Multistart(program, equations, p_.quadrants == 2, o_.starts / 2))
        keep(c);
    return best;
  }

  std::optional<DistributionMatrix> Best(int equations) const {
    const std::vector<Candidate> found = ByCapacity(equations);
    if (found.empty()) return {};
    const DistributionMatrix widest = WidestDisc(p_, found[0].W);
    const double rho_best = WorkingDisc(p_, widest);
    double rho = kCapacityKept * rho_best;
    if (o_.policy == DistributionPolicy::kControl)
      rho = std::max(equations == 12 ? o_.capacity_share * rho_best : 0,
                     std::min(o_.rho_floor, 0.9 * rho_best));  // linearised: the less, the truer
    std::vector<Candidate> starts;
    for (const Candidate& c : found)
      if (starts.size() < 24 && WorkingDisc(p_, WidestDisc(p_, c.W)) >= 0.99 * rho)
        starts.push_back(c);
    const auto best = LeastStiff(equations, rho, starts);
    return best ? best->W : widest;
  }

  RedistributionProblem p_;
  DistributionOptions o_;
  ForceForms forms_;
};

}  // namespace

const char* ToText(SolvabilityClass c) {
  return c == SolvabilityClass::kExact        ? "exact"
         : c == SolvabilityClass::kLinearised ? "linearised"
                                              : "none";
}

SolvabilityClass Classify(const RedistributionProblem& problem) {
  RedistributionProblem p = problem;  // scaling a live coil's turns only scales its row of W
  for (int j = 0; j < 8; ++j) p.turns_left[j] = problem.turns_left[j] > 0;
  p.quadrants = 4;
  const ForceForms forms = MakeForceForms(p);
  if (Reachable(p, forms, 12)) return SolvabilityClass::kExact;
  return Reachable(p, forms, 6) ? SolvabilityClass::kLinearised : SolvabilityClass::kNone;
}

Distribution SolveDistribution(const RedistributionProblem& problem,
                               const DistributionOptions& options) {
  if ((problem.turns_left.array() == 1).all())
    return Describe(problem, SolvabilityClass::kExact, HealthyDistribution(problem));
  if (options.policy == DistributionPolicy::kControl && (problem.turns_left.array() > 0).all()) {
    const DistributionMatrix same_flux =
        problem.turns_left.cwiseInverse().asDiagonal() * HealthyDistribution(problem);
    if (WorkingDisc(problem, same_flux) >= options.rho_same_flux)
      return Describe(problem, SolvabilityClass::kExact, same_flux);
  }
  return Solver(problem, options).Solve();
}

Distribution Describe(const RedistributionProblem& problem, SolvabilityClass cls,
                      const DistributionMatrix& W) {
  const ForceForms forms = MakeForceForms(problem);
  Distribution d;
  d.cls = cls;
  d.W = W;
  d.residual = EquationErrors(forms, W).cwiseAbs().maxCoeff();
  d.rho = WorkingDisc(problem, W);
  if ((W.col(0).array() < 0).any()) {
    RedistributionProblem any_sign = problem;
    any_sign.quadrants = 4;
    d.rho = WorkingDisc(any_sign, W);
  }
  d.unipolar = d.rho > 0 &&
               (W.col(0).array() >= d.rho * W.rightCols(2).rowwise().norm().array() - 1e-12).all();
  d.capacity_flux = FluxCapacity(forms, W);
  d.capacity_current = CurrentCapacity(problem, W);
  d.stiffness = NegativeStiffness(problem, forms, W);
  d.copper_loss = W.col(0).cwiseAbs2().dot(problem.turns_left) / 8;
  return d;
}

double BestFluxCapacity(const RedistributionProblem& problem, const DistributionOptions& options) {
  return Solver(problem, options).FluxCapacityFound();
}

}  // namespace ambrig
