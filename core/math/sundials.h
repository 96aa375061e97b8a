#pragma once
/// What the doors to SUNDIALS (cvode.cc, kinsol.cc) share: owners of its objects, and the report of
/// what went wrong inside. Included by nobody else.
#include <fmt/format.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <string>
#include <utility>
#include <vector>

#include "core/base/errors.h"
#include "core/math/no_solution.h"

namespace ambrig::sundials {

/// Frees a SUNDIALS object whose destructor takes it by value.
template <typename T, void (*kFree)(T)>
struct Owned {
  T value = nullptr;
  Owned() = default;
  explicit Owned(T v) : value(v) { Require(v != nullptr, "SUNDIALS has memory"); }
  Owned(const Owned&) = delete;
  Owned& operator=(const Owned&) = delete;
  ~Owned() {
    if (value) kFree(value);
  }
  operator T() const { return value; }
};
inline void FreeMatrix(SUNMatrix m) { SUNMatDestroy(m); }
inline void FreeLinear(SUNLinearSolver s) { SUNLinSolFree(s); }
inline void FreeVector(N_Vector v) { N_VDestroy(v); }
using Vector = Owned<N_Vector, FreeVector>;
using Matrix = Owned<SUNMatrix, FreeMatrix>;
using Linear = Owned<SUNLinearSolver, FreeLinear>;

struct Context {
  SUNContext value = nullptr;
  Context() { Require(SUNContext_Create(nullptr, &value) == 0, "a SUNDIALS context"); }
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;
  ~Context() { SUNContext_Free(&value); }
  operator SUNContext() const { return value; }
};

inline N_Vector NewVector(const std::vector<double>& v, SUNContext context) {
  N_Vector out = N_VNew_Serial(static_cast<sunindextype>(v.size()), context);
  if (out) std::copy(v.begin(), v.end(), N_VGetArrayPointer(out));
  return out;
}

/// SUNDIALS' last words and what a callback threw (it must not pass through C code).
struct Report {
  std::string message;
  std::exception_ptr thrown;

  static void Handler(int code, const char* module, const char* function, char* text, void* data) {
    if (code < 0)
      static_cast<Report*>(data)->message = fmt::format("{} {}: {}", module, function, text);
  }
  /// 0 fine, 1 try again with a smaller step, -1 give up.
  template <typename Call>
  int Guard(double* out, std::size_t n, const Call& call) {
    try {
      call();
    } catch (...) {
      thrown = std::current_exception();
      return -1;
    }
    for (std::size_t k = 0; k < n; ++k)
      if (!std::isfinite(out[k])) return 1;
    return 0;
  }
  void Check(int code, const char* what) {
    if (thrown) std::rethrow_exception(std::exchange(thrown, nullptr));
    if (code >= 0) return;
    throw NoSolution(message.empty() ? fmt::format("{} failed with code {}", what, code) : message);
  }
};

}  // namespace ambrig::sundials
