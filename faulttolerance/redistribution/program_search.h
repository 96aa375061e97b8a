#pragma once
/// The search of a distribution program (distribution_program.h) from one start: sequential least
/// squares by NLopt (SLSQP), all derivatives exact; and the equations alone by Levenberg-Marquardt.
/// Source: Kraft 1994, ACM TOMS 20(3).
#include "faulttolerance/redistribution/distribution_program.h"

namespace ambrig {

struct ProgramSearch {
  SmallVector x;
  double objective = 0;
  double infeasibility = 0;  // largest equation error or bound violation
};

/// Best point near `x`, to `tolerance` of the objective and of x, relative. Also where the search
/// gives up: `infeasibility` tells what it is worth.
ProgramSearch SearchProgram(const DistributionProgram& program, const SmallVector& x,
                            double tolerance = 1e-8);

/// Levenberg-Marquardt on the equations alone, from x (T, if any, untouched).
/// Returns the largest error left; stops when an entry leaves +-`limit`.
double SolveEquations(const DistributionProgram& program, SmallVector& x, double limit,
                      int max_iterations = 200);

}  // namespace ambrig
