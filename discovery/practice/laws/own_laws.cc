/// Effects of the catalogue that have no other form here, with their own law, drawn as `hide` draws
/// them.
#include "discovery/practice/drawn_truth.h"
#include "discovery/practice/laws/practice_law.h"
#include "effects/catalogue.h"

namespace ambrig {

std::vector<PracticeLaw> OwnLaws() {
  std::vector<PracticeLaw> out;
  for (const char* id : {"fringing", "magnetic-offset", "turn-mismatch", "copper-heating",
                         "bus-impedance", "dead-time", "shaft-bow", "freewheel-drop"}) {
    const std::string name = id;
    out.push_back({name + "-own", "the catalogue's own law", name, name, [name](LawSetting s) {
                     const EffectDescription& d = EffectNamed(name);
                     const auto seed = static_cast<std::uint64_t>(s.draw.Between(0, 1e9));
                     EffectInstance e = ScaledEffect(d, DrawEffect(d, s.target, seed, 0), s.size);
                     e.where = "practice law";
                     return std::vector{e};
                   }});
  }
  return out;
}

}  // namespace ambrig
