#pragma once
/// How finely a model resolves a switching period.

namespace ambrig {

/// How finely the current samples of a switching period are resolved. Differences between two
/// coarse predictions are sensitivities that err by a few percent, at less cost.
enum class ModelFidelity { kAsSampled, kCoarse };

}  // namespace ambrig
