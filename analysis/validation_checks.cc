#include "analysis/validation_checks.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

namespace ambrig {

int NodeOf(const BeamRotor& beam, const TomlTable& t, const char* key, double z) {
  const double length = beam.z.back() - beam.z.front();
  for (const double node : beam.z)
    if (std::abs(node - z) <= 1e-6 * length) return NodeAt(beam, z);
  t.Fail(key,
         fmt::format("= {} m, allowed: a node of the shaft, {:.6g} m", z, fmt::join(beam.z, " ")));
}

void CheckSprings(const TomlTable& check, const LinearRotor& rotor) {
  const Eigen::MatrixXd K = 0.5 * (rotor.K + rotor.K.transpose());
  if ((rotor.K - K).cwiseAbs().maxCoeff() > 1e-9 * K.cwiseAbs().maxCoeff())
    check.Fail("quantity",
               "= \"critical speeds\" of supports whose kxy and kyx differ, allowed: "
               "symmetric springs, or quantity = \"damped frequencies\"");
  if (Eigen::LLT<Eigen::MatrixXd>(K).info() != Eigen::Success)
    check.Fail("quantity",
               "= \"critical speeds\" of a rotor that no spring holds, allowed: with "
               "[[rotor.support]] that hold it");
}

}  // namespace ambrig
