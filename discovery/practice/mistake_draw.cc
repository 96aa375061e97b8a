#include "discovery/practice/mistake_draw.h"

#include <cmath>
#include <iterator>

namespace ambrig {

namespace {

const char* const kMistakes[] = {"unit",   "sign", "lag",   "swap",     "clip",
                                 "freeze", "lost", "range", "scenario", "instrument"};

/// Prefixes, inches, peak values for rms and back, or a gain that somebody forgot.
double WrongFactor(PracticeDraw& draw) {
  const double usual[] = {1e3, 1e-3, 1e6, 25.4, 1 / 25.4, 2, 0.5};
  const std::size_t which = draw.Of(std::size(usual) + 1);
  if (which < std::size(usual)) return usual[which];
  const double gain = draw.Log(2.5, 20);
  return draw.Sign() > 0 ? gain : 1 / gain;
}

double AmountOf(const std::string& fault, PracticeDraw& draw) {
  if (fault == "unit") return WrongFactor(draw);
  if (fault == "lag") return draw.Log(3e-3, 40e-3);         // [s]
  if (fault == "instrument") return draw.Log(3e-3, 20e-3);  // [s]
  if (fault == "clip") return draw.Between(0.3, 0.8);
  if (fault == "freeze") return draw.Between(0.08, 0.5);
  if (fault == "lost") return draw.Between(0.03, 0.15);
  if (fault == "range") return draw.Log(1e2, 1e5);
  return 0;
}

}  // namespace

Spoiling DrawMistake(std::size_t ordinal, PracticeDraw draw) {
  Spoiling out;
  out.fault = kMistakes[ordinal % std::size(kMistakes)];
  out.amount = AmountOf(out.fault, draw);
  return out;
}

}  // namespace ambrig
