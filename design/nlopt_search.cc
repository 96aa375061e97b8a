#include "design/nlopt_search.h"

#include <nlopt.h>
#include <algorithm>
#include <exception>
#include <stdexcept>

namespace ambrig {

namespace {

constexpr double kFirstStep = 0.2;  // share of a variable's range

struct Call {
  const std::function<double(const std::vector<double>&)>* f;
  nlopt_opt search;
  std::exception_ptr error;  // must not cross C
};

double EvaluateCandidate(unsigned n, const double* x, double*, void* data) {
  Call& call = *static_cast<Call*>(data);
  try {
    return (*call.f)(std::vector<double>(x, x + n));
  } catch (...) {
    call.error = std::current_exception();
    nlopt_force_stop(call.search);
    return 0;
  }
}

}  // namespace

std::vector<double> SearchUnitCube(const std::function<double(const std::vector<double>&)>& f,
                                   const std::vector<double>& start, int evaluations) {
  const auto n = static_cast<unsigned>(start.size());
  const nlopt_opt search = nlopt_create(NLOPT_LN_SBPLX, n);
  if (!search) throw std::runtime_error("NLopt: no memory");
  Call call{&f, search, nullptr};
  std::vector<double> x = start;
  for (double& v : x) v = std::clamp(v, 0.0, 1.0);
  double least = 0;
  nlopt_set_min_objective(search, EvaluateCandidate, &call);
  nlopt_set_lower_bounds1(search, 0);
  nlopt_set_upper_bounds1(search, 1);
  nlopt_set_initial_step1(search, kFirstStep);
  nlopt_set_xtol_abs1(search, 1e-4);
  nlopt_set_maxeval(search, evaluations);
  const nlopt_result result = nlopt_optimize(search, x.data(), &least);
  nlopt_destroy(search);
  if (call.error) std::rethrow_exception(call.error);
  // Round-off: x is still the best found.
  if (result < 0 && result != NLOPT_ROUNDOFF_LIMITED)
    throw std::runtime_error("NLopt: the search failed");
  return x;
}

}  // namespace ambrig
