#pragma once
/// Uniform steel shafts, for tests against closed forms.
#include <cmath>

#include "core/math/constants.h"
#include "rotor/shaft/beam.h"

namespace ambrig {

inline const Material kSteel{2.1e11, 7850, 0.3};

inline ShaftSection Uniform(double length, double od) {
  ShaftSection s;
  s.length = length;
  s.od = s.od_right = od;
  s.material = kSteel;
  return s;
}

inline BeamDefinition UniformShaft(double length, double od, int elements) {
  BeamDefinition d;
  d.sections = {Uniform(length, od)};
  d.elements_per_section = elements;
  return d;
}

inline BeamTheory EulerBernoulli() {
  BeamTheory t;
  t.shear = t.rotary_inertia = false;
  return t;
}

inline double Area(double d) { return kPi / 4 * d * d; }
inline double Inertia(double d) { return kPi / 64 * std::pow(d, 4); }

}  // namespace ambrig
