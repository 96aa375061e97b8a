#include "discovery/decision/verdict.h"

#include <stdexcept>

namespace ambrig {

std::string ToText(ExplanationVerdict verdict) {
  switch (verdict) {
    case ExplanationVerdict::kUnfinished:
      return "unfinished";
    case ExplanationVerdict::kEffect:
      return "effect";
    case ExplanationVerdict::kParameters:
      return "parameters";
    case ExplanationVerdict::kNone:
      return "none";
    case ExplanationVerdict::kUnknown:
      return "unknown";
    case ExplanationVerdict::kData:
      return "data";
  }
  throw std::logic_error("verdict");
}

std::string ToText(RemainderKind kind) {
  switch (kind) {
    case RemainderKind::kNone:
      return "none";
    case RemainderKind::kLawVariation:
      return "law-variation";
    case RemainderKind::kOther:
      return "other";
  }
  throw std::logic_error("kind of a remainder");
}

}  // namespace ambrig
