#include "core/math/real_eigenvalues.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

namespace ambrig {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;

constexpr double kRounding = std::numeric_limits<double>::epsilon();
constexpr int kMostSweeps = 60;

/// Rows and columns low..high, not split, of an upper Hessenberg matrix.
struct Window {
  Index low, high;
};

struct Shifts {
  double x, y, w;  // (H - a)(H - b) with a + b = x + y, a b = x y - w
};

Shifts ShiftsOf(const MatrixXd& H, Index high, int sweep) {
  if (sweep % 10 == 0) {  // out of a cycle, as EISPACK's hqr
    const double s = std::abs(H(high, high - 1)) + std::abs(H(high - 1, high - 2));
    return {H(high, high) + 0.75 * s, H(high, high) + 0.75 * s, -0.4375 * s * s};
  }
  return {H(high, high), H(high - 1, high - 1), H(high, high - 1) * H(high - 1, high)};
}

/// Where the sweep can start because two subdiagonal entries together are small; p: the
/// first column there.
Index StartOfSweep(const MatrixXd& H, const Window& at, const Shifts& by, double p[3]) {
  for (Index m = at.high - 2;; --m) {
    const double z = H(m, m), r = by.x - z, s = by.y - z;
    p[0] = (r * s - by.w) / H(m + 1, m) + H(m, m + 1);
    p[1] = H(m + 1, m + 1) - z - r - s;
    p[2] = H(m + 2, m + 1);
    const double scale = std::abs(p[0]) + std::abs(p[1]) + std::abs(p[2]);
    for (int i = 0; i < 3; ++i) p[i] /= scale;
    if (m == at.low) return m;
    const double left = std::abs(H(m, m - 1)) * (std::abs(p[1]) + std::abs(p[2]));
    const double right =
        std::abs(p[0]) * (std::abs(H(m - 1, m - 1)) + std::abs(z) + std::abs(H(m + 1, m + 1)));
    if (left <= kRounding * right) return m;
  }
}

/// I - (x, y, z)' (1, q, r): maps the first column onto an axis.
struct Reflector {
  double x, y, z, q, r;
};

void ApplyToRows(MatrixXd& H, const Reflector& f, Index k, Index high, bool three) {
  for (Index j = k; j <= high; ++j) {
    double* h = &H(k, j);
    const double p = h[0] + f.q * h[1] + (three ? f.r * h[2] : 0);
    h[0] -= p * f.x;
    h[1] -= p * f.y;
    if (three) h[2] -= p * f.z;
  }
}

void ApplyToColumns(MatrixXd& H, const Reflector& f, Index k, const Window& at, bool three) {
  const Index rows = std::min(at.high, k + 3) - at.low + 1;
  auto a = H.col(k).segment(at.low, rows).array(), b = H.col(k + 1).segment(at.low, rows).array();
  if (!three) {
    for (Index i = 0; i < rows; ++i) {
      const double p = f.x * a(i) + f.y * b(i);
      a(i) -= p;
      b(i) -= p * f.q;
    }
    return;
  }
  auto c = H.col(k + 2).segment(at.low, rows).array();
  for (Index i = 0; i < rows; ++i) {
    const double p = f.x * a(i) + f.y * b(i) + f.z * c(i);
    a(i) -= p;
    b(i) -= p * f.q;
    c(i) -= p * f.r;
  }
}

void Sweep(MatrixXd& H, const Window& at, const Shifts& by) {
  double p[3];
  const Index start = StartOfSweep(H, at, by, p);
  for (Index i = start + 2; i <= at.high; ++i) {
    H(i, i - 2) = 0;
    if (i > start + 2) H(i, i - 3) = 0;
  }
  for (Index k = start; k < at.high; ++k) {
    const bool three = k < at.high - 1;
    double scale = 1;
    if (k > start) {
      p[0] = H(k, k - 1);
      p[1] = H(k + 1, k - 1);
      p[2] = three ? H(k + 2, k - 1) : 0;
      scale = std::abs(p[0]) + std::abs(p[1]) + std::abs(p[2]);
      if (scale == 0) continue;
      for (double& v : p) v /= scale;
    }
    const double s = std::copysign(std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]), p[0]);
    if (s == 0) continue;
    if (k > start)
      H(k, k - 1) = -s * scale;
    else if (at.low != start)
      H(k, k - 1) = -H(k, k - 1);
    const double first = p[0] + s;
    const Reflector f{first / s, p[1] / s, p[2] / s, p[1] / first, p[2] / first};
    ApplyToRows(H, f, k, at.high, three);
    ApplyToColumns(H, f, k, at, three);
  }
}

/// Eigenvalues of rows and columns k - 1 and k.
void SolvePair(const MatrixXd& H, Index k, Eigen::VectorXcd& out) {
  const double half = 0.5 * (H(k - 1, k - 1) - H(k, k)), w = H(k, k - 1) * H(k - 1, k);
  const double under = half * half + w, root = std::sqrt(std::abs(under));
  if (under < 0) {
    out(k - 1) = {H(k, k) + half, root};
    out(k) = {H(k, k) + half, -root};
    return;
  }
  const double far = half + std::copysign(root, half);  // no cancellation
  out(k - 1) = H(k, k) + far;
  out(k) = far != 0 ? H(k, k) - w / far : H(k, k);
}

/// First row of the part that ends at `high` and has not split.
Index TopOf(const MatrixXd& H, Index high, double norm) {
  Index low = high;
  for (; low > 0; --low) {
    const double s = std::abs(H(low - 1, low - 1)) + std::abs(H(low, low));
    if (std::abs(H(low, low - 1)) <= kRounding * (s > 0 ? s : norm)) break;
  }
  return low;
}

}  // namespace

bool RealEigenvalues(const MatrixXd& a, Eigen::VectorXcd& out) {
  const Index n = a.rows();
  out.resize(n);
  MatrixXd H = n > 2 ? MatrixXd(Eigen::HessenbergDecomposition<MatrixXd>(a).matrixH()) : a;
  if (!H.allFinite()) return false;
  const double norm = H.cwiseAbs().maxCoeff();
  int sweeps = 0;
  for (Index high = n - 1; high >= 0;) {
    const Index low = TopOf(H, high, norm);
    if (low + 1 >= high) {
      if (low == high)
        out(high) = H(high, high);
      else
        SolvePair(H, high, out);
      high = low - 1;
      sweeps = 0;
      continue;
    }
    if (++sweeps > kMostSweeps) return false;
    Sweep(H, {low, high}, ShiftsOf(H, high, sweeps));
  }
  return true;
}

}  // namespace ambrig
