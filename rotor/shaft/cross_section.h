#pragma once
/// What the elements of a shaft integrate: stiffness and mass of a cross-section, and the
/// rule. Units SI.
#include <array>

#include "rotor/shaft/shaft_element.h"

namespace ambrig {

// Gauss-Legendre on [0, 1], 8 points: exact to degree 15, so uniform elements are exact.
inline constexpr std::array<double, 4> kGaussNodes = {0.1834346424956498, 0.5255324099163290,
                                                      0.7966664774136267, 0.9602898564975363};
inline constexpr std::array<double, 4> kGaussWeights = {0.3626837833783620, 0.3137066458778873,
                                                        0.2223810344533745, 0.1012285362903763};

template <class F>
void Quadrature(double length, const F& f) {
  for (std::size_t i = 0; i < kGaussNodes.size(); ++i) {
    const double weight = kGaussWeights[i] * length / 2;
    f(0.5 * length * (1 - kGaussNodes[i]), weight);
    f(0.5 * length * (1 + kGaussNodes[i]), weight);
  }
}

/// Of all layers that carry or load the section; without shear kappa G A is not used.
struct CrossSection {
  double EI = 0, kGA = 0, rhoA = 0, rhoI = 0;
};

/// At the distance s [m] from the element's left end.
CrossSection SectionAt(const ShaftElement& element, const BeamTheory& theory, double s);

}  // namespace ambrig
