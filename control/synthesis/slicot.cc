#include "control/synthesis/slicot.h"

#include <algorithm>
#include <mutex>

extern "C" void sb10dd_(const int* n, const int* m, const int* np, const int* ncon,
                        const int* nmeas, const double* gamma, const double* a, const int* lda,
                        const double* b, const int* ldb, const double* c, const int* ldc,
                        const double* d, const int* ldd, double* ak, const int* ldak, double* bk,
                        const int* ldbk, double* ck, const int* ldck, double* dk, const int* lddk,
                        double* x, const int* ldx, double* z, const int* ldz, double* rcond,
                        const double* tol, int* iwork, double* dwork, const int* ldwork, int* bwork,
                        int* info);

namespace ambrig {

HInfinityOutcome DiscreteHInfinity(const StateSpace& plant, int controls, int measurements,
                                   double gamma) {
  // Fortran of that age may keep locals in static memory.
  static std::mutex one_at_a_time;
  const std::scoped_lock lock(one_at_a_time);
  const int n = static_cast<int>(plant.states()), m = static_cast<int>(plant.inputs()),
            p = static_cast<int>(plant.outputs());
  Eigen::MatrixXd a = plant.A, b = plant.B, c = plant.C, d = plant.D, x(n, n), z(n, n);
  HInfinityOutcome out;
  StateSpace& k = out.controller;
  k.A.resize(n, n);
  k.B.resize(n, measurements);
  k.C.resize(controls, n);
  k.D.resize(controls, measurements);
  // The documented upper bound, twice for better blocking.
  const int q = std::max({m, p}) + n;
  const int work = 2 * (13 * n * n + 2 * m * m + 40 * q * q + 100 * q + 100);
  std::vector<double> dwork(static_cast<std::size_t>(work));
  std::vector<int> iwork(static_cast<std::size_t>(std::max({2 * q, m + p, n * n, 1}))),
      bwork(static_cast<std::size_t>(2 * n + 1));
  double rcond[8];
  const double tolerance = 0;
  sb10dd_(&n, &m, &p, &controls, &measurements, &gamma, a.data(), &n, b.data(), &n, c.data(), &p,
          d.data(), &p, k.A.data(), &n, k.B.data(), &n, k.C.data(), &controls, k.D.data(),
          &controls, x.data(), &n, z.data(), &n, rcond, &tolerance, iwork.data(), dwork.data(),
          &work, bwork.data(), &out.info);
  out.usable =
      out.info == 0 && k.A.allFinite() && k.B.allFinite() && k.C.allFinite() && k.D.allFinite();
  return out;
}

}  // namespace ambrig
