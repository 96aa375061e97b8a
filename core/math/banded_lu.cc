#include "core/math/banded_lu.h"

#include <algorithm>
#include <cmath>

namespace ambrig {

namespace {

using Eigen::Index;

/// y -= x f over `count` entries.
inline void Subtract(const double* __restrict xr, const double* __restrict xi, double fr, double fi,
                     double* __restrict yr, double* __restrict yi, Index count) {
  for (Index k = 0; k < count; ++k) {
    yr[k] -= xr[k] * fr - xi[k] * fi;
    yi[k] -= xr[k] * fi + xi[k] * fr;
  }
}

}  // namespace

BandedLu::BandedLu(Index n, Index below, Index above)
    : n_(n), below_(below), above_(above), column_(2 * below + above + 1), pivot_(n) {
  re_.assign(n * column_, 0);
  im_.assign(n * column_, 0);
}

void BandedLu::Clear() {
  std::fill(re_.begin(), re_.end(), 0);
  std::fill(im_.begin(), im_.end(), 0);
}

Index BandedLu::PivotRow(Index j, Index last) const {
  Index best = j;
  double largest = -1;
  for (Index i = j; i <= last; ++i)
    if (const double size = std::abs(re_[Place(i, j)]) + std::abs(im_[Place(i, j)]); size > largest)
      largest = size, best = i;
  return largest > 0 ? best : -1;
}

void BandedLu::SwapRows(Index j, Index p, Index right) {
  for (Index c = j; c <= right; ++c) {
    std::swap(re_[Place(j, c)], re_[Place(p, c)]);
    std::swap(im_[Place(j, c)], im_[Place(p, c)]);
  }
}

void BandedLu::Eliminate(Index j, Index last, Index right) {
  const Index own = Place(j, j), count = last - j;
  const std::complex<double> inverse = 1.0 / std::complex<double>(re_[own], im_[own]);
  for (Index k = 1; k <= count; ++k) {
    const double re = re_[own + k], im = im_[own + k];
    re_[own + k] = re * inverse.real() - im * inverse.imag();
    im_[own + k] = re * inverse.imag() + im * inverse.real();
  }
  for (Index c = j + 1; c <= right; ++c) {
    const Index at = Place(j, c);
    if (re_[at] == 0 && im_[at] == 0) continue;
    Subtract(&re_[own + 1], &im_[own + 1], re_[at], im_[at], &re_[at + 1], &im_[at + 1], count);
  }
}

bool BandedLu::Factorise() {
  Index right = 0;  // last column that a row of the factors so far reaches
  for (Index j = 0; j < n_; ++j) {
    const Index last = std::min(n_ - 1, j + below_), p = PivotRow(j, last);
    if (p < 0) return false;
    pivot_[j] = p;
    right = std::max(right, std::min(n_ - 1, p + above_));
    if (p != j) SwapRows(j, p, right);
    if (last > j) Eliminate(j, last, right);
  }
  return true;
}

void BandedLu::Solve(Eigen::Ref<Eigen::VectorXcd> x) const {
  std::vector<double> xr(n_), xi(n_);
  for (Index i = 0; i < n_; ++i) xr[i] = x(i).real(), xi[i] = x(i).imag();
  for (Index j = 0; j < n_; ++j) {
    if (pivot_[j] != j) std::swap(xr[j], xr[pivot_[j]]), std::swap(xi[j], xi[pivot_[j]]);
    const Index count = std::min(n_ - 1, j + below_) - j, own = Place(j, j);
    if (count > 0 && (xr[j] != 0 || xi[j] != 0))
      Subtract(&re_[own + 1], &im_[own + 1], xr[j], xi[j], &xr[j + 1], &xi[j + 1], count);
  }
  for (Index j = n_ - 1; j >= 0; --j) {
    const Index own = Place(j, j), count = std::min(j, below_ + above_);
    const std::complex<double> value =
        std::complex<double>(xr[j], xi[j]) / std::complex<double>(re_[own], im_[own]);
    x(j) = value;
    if (count > 0)
      Subtract(&re_[own - count], &im_[own - count], value.real(), value.imag(), &xr[j - count],
               &xi[j - count], count);
  }
}

}  // namespace ambrig
