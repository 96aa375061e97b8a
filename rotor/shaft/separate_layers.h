#pragma once
/// Elements whose layers do not share their deflection.
#include "rotor/shaft/shaft_element.h"

namespace ambrig {

/// Sum over the layers of an element, each bent alone: a sleeve (`stiff` false) moves as a shaft
/// of its own size would, without stiffness. `joined`: matrices of an element of one layer.
template <class Matrices, class Joined>
Matrices SeparateLayers(const ShaftElement& e, const Joined& joined) {
  Matrices out;
  for (const ShaftSection& l : e.layers) {
    ShaftElement one{e.z0, e.length, {l}};
    one.layers[0].stiff = true;
    const Matrices part = joined(one);
    out.M += part.M;
    out.J += part.J;
    if (!l.stiff) continue;
    out.K += part.K;
    out.C += part.C;
    out.tension += part.tension;
  }
  return out;
}

}  // namespace ambrig
