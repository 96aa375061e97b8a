#include "app/commands/effect_names.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/errors.h"

namespace ambrig {

std::pair<std::string, std::string> EffectAtTarget(const std::string& text) {
  const std::size_t at = text.find('@');
  if (at == std::string::npos && !text.empty()) return {text, ""};
  if (at == std::string::npos || at == 0 || at + 1 == text.size())
    throw InputError(
        fmt::format("effect = \"{}\", allowed: EFFECT or EFFECT@TARGET, e.g. saturation@A", text));
  return {text.substr(0, at), text.substr(at + 1)};
}

std::vector<std::pair<std::string, std::string>> EffectsAtTargets(
    const std::vector<std::string>& texts, const std::string& option) {
  std::vector<std::pair<std::string, std::string>> out;
  for (const std::string& text : texts) {
    const auto effect = EffectAtTarget(text);
    if (std::find(out.begin(), out.end(), effect) != out.end())
      throw InputError(fmt::format("{}: {} is named twice, allowed: each once", option, text));
    out.push_back(effect);
  }
  return out;
}

}  // namespace ambrig
