#pragma once
/// The door to the integrators of SUNDIALS with root finding, CVODE and ARKODE:
///
///   y' = f(t, y), stopped exactly at a given time or where a root function changes sign
///
/// Every return code is checked; a failure is a std::runtime_error with SUNDIALS' own words. What a
/// right-hand side throws comes out of Advance unchanged. A right-hand side that is not finite
/// makes the integrator try a smaller step. Source: Hindmarsh et al. 2005, ACM TOMS 31(3); Reynolds
/// et al. 2023, ACM TOMS 49(2).
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace ambrig {

/// (t, y, out): right-hand side f(t, y), or the values of the root functions.
using OdeFunction = std::function<void(double, const double*, double*)>;

struct OdeProblem {
  OdeFunction rhs;
  std::size_t size = 0;
  int roots = 0;  // number of root functions
  OdeFunction root = {};
  std::vector<int> directions = {};  // of each root: -1 falling, +1 rising, 0 both; empty: all both
  double relative = 1e-10;           // tolerance of a step
  std::vector<double> absolute;      // (size), in the units of y
  long max_steps = 200000;           // between two stops
};

class OdeSolver {
 public:
  struct Outcome {
    double t = 0;
    bool root = false;  // stopped at a root, not at the time asked for
  };

  virtual ~OdeSolver() = default;
  /// Starts afresh at (t, y) with this first step; forget what was before.
  virtual void Restart(double t, const std::vector<double>& y, double first_step) = 0;
  /// Integrates to `stop` exactly, or to the first root.
  virtual Outcome Advance(double stop, std::vector<double>& y) = 0;
  /// Of the last root: -1 fell, +1 rose, 0 not this one.
  virtual const std::vector<int>& roots() const = 0;
  virtual long steps() const = 0;  // since the last Restart
};

/// Explicit Runge-Kutta of ARKODE, order 2 to 8: a new start costs nothing, so it suits problems
/// with an event every microsecond.
class Arkode : public OdeSolver {
 public:
  Arkode(OdeProblem problem, int order);
  ~Arkode() override;
  void Restart(double t, const std::vector<double>& y, double first_step) override;
  Outcome Advance(double stop, std::vector<double>& y) override;
  const std::vector<int>& roots() const override;
  long steps() const override;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Variable-order BDF of CVODE with a dense Newton matrix (differenced): for stiff problems.
class Cvode : public OdeSolver {
 public:
  explicit Cvode(OdeProblem problem);
  ~Cvode() override;
  void Restart(double t, const std::vector<double>& y, double first_step) override;
  Outcome Advance(double stop, std::vector<double>& y) override;
  const std::vector<int>& roots() const override;
  long steps() const override;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ambrig
