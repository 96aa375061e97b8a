#pragma once
/// The words in which explain answers, as files and readers see them.
#include <string>

namespace ambrig {

/// What the search for a missing effect ended with; `kUnfinished` while it goes on.
enum class ExplanationVerdict { kUnfinished, kEffect, kParameters, kNone, kUnknown, kData };

/// "effect", "parameters", "none", "unknown", "data"; "unfinished".
std::string ToText(ExplanationVerdict verdict);

/// What an explanation leaves above the noise: nothing, what a law's usual variation leaves, or
/// something of another origin.
enum class RemainderKind { kNone, kLawVariation, kOther };

/// "none", "law-variation", "other".
std::string ToText(RemainderKind kind);

}  // namespace ambrig
