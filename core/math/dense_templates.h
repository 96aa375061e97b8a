#pragma once
/// Eigen's decompositions of dense matrices of free size, and the kernels of their products
/// and triangular solves: declared here and compiled once, in dense_templates.cc, instead of in
/// every source that uses one (docs/decisions/005-build-time.md). The functions are Eigen's own, so
/// that no result depends on this header. It stands in the precompiled headers; a build without
/// those compiles the templates where they are used.
///
/// A decomposition is compiled once only if its argument is a matrix: that of an expression
/// is another template, so that callers write LLT<MatrixXd>(MatrixXd(A + B)).
#include <Eigen/Dense>
#include <complex>

namespace ambrig::dense {

// Numbers of a matrix in the order `order`, as the kernels of Eigen 3.4 read and write them.
template <typename Scalar, int order>
using Read = Eigen::internal::const_blas_data_mapper<Scalar, Eigen::Index, order>;
template <typename Scalar>
using Written = Eigen::internal::blas_data_mapper<Scalar, Eigen::Index, Eigen::ColMajor>;
template <typename Scalar>
using Traits = Eigen::internal::gebp_traits<Scalar, Scalar>;
template <typename Scalar>
using Packing = typename Traits<Scalar>::LhsPacket4Packing;

}  // namespace ambrig::dense

#define AMBRIG_DENSE extern template
#include "core/math/dense_templates.inc"
#undef AMBRIG_DENSE
