#pragma once
/// Stators of a template, as tests want them: what a template leaves open is given.
#include <string>

#include "actuators/magnetics/stator_parameters.h"

namespace ambrig::testing {

struct TemplateSizes {
  double turns, area, gap, leakage;  // -, [m2], [m], [H]
};

inline StatorParameters TemplateStator(const std::string& pattern, const TemplateSizes& sizes,
                                       int poles = 0) {
  StatorParameters p;
  p.pattern = pattern;
  p.axial = FindStatorTemplate(pattern)->axial;
  p.turns = sizes.turns;
  p.pole_area = sizes.area;
  p.gap = sizes.gap;
  p.pole_count = poles;
  p.leakage_inductance = sizes.leakage;
  p.resistance = 1;
  return p;
}

}  // namespace ambrig::testing
