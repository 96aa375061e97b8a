#pragma once

namespace ambrig {

/// How the sentence at the head of a report is meant.
enum class Verdict { kOk, kWarn, kFail, kInfo };

}  // namespace ambrig
