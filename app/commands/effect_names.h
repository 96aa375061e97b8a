#pragma once
/// Effects on the command line: EFFECT or EFFECT@TARGET.
#include <string>
#include <utility>
#include <vector>

namespace ambrig {

/// (name, target); the target is empty when the text has no @. Whether an effect has that name, and
/// that target, is for the command to say. @throws InputError for "@A" and "saturation@"
std::pair<std::string, std::string> EffectAtTarget(const std::string& text);

/// Of each text; `option` stands in the message. @throws InputError when one is written twice
std::vector<std::pair<std::string, std::string>> EffectsAtTargets(
    const std::vector<std::string>& texts, const std::string& option);

}  // namespace ambrig
