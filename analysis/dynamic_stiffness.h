#pragma once
/// What the bearings are to the rotor, and what the levitated rotor is to a force.
///
/// Bearing: the shaft is moved, x = Re(X e^{iωt}) along one axis at its magnets and its sensor
/// alike, and the force that comes back is K(ω) = -F/X = k + iω c [N/m]; F is the part of the
/// magnets' force at ω (taken at the ticks of the controller). At ω -> 0 it is k_p - k_s and the
/// integrator. Levitated rotor: 1/(shaft displacement at the magnets per continuous force there).
/// Source: ISO 14839-1; Schweitzer & Maslen 2009, ch. 4.
#include "analysis/transfer_function.h"

namespace ambrig {

struct AxisStiffness {
  std::string axis;
  std::vector<std::complex<double>> bearing;  // K [N/m]
  std::vector<std::complex<double>> rotor;    // force per displacement, levitated [N/m]
};

struct DynamicStiffness {
  std::vector<double> frequency;  // [Hz]
  std::vector<AxisStiffness> axes;
};

DynamicStiffness FindStiffness(const OperatingPoint& point, const TransferFunction& transfer,
                               const std::vector<double>& frequency);

}  // namespace ambrig
