#pragma once
/// Where an error lives: over frequency and speed, in orders of the rotation, in the response to
/// injected forces, against position, current and speed.
#include <optional>

#include "app/figures/figure.h"
#include "app/figures/residual_data.h"

namespace ambrig {

/// Error over noise in frequency bands (columns), a row per record; a run-up is cut into stretches
/// of speed. rms over the channels. nullopt without a noise sample.
std::optional<Figure> FrequencySpeedMap(const CaseModel& model,
                                        const std::vector<double>& predicted,
                                        const std::vector<double>& noise,
                                        const std::string& caption);

/// Orders 1 to 4 of measurement, model and error over a spinning record, by least squares on
/// cos n theta, sin n theta in windows of at least four turns. nullopt at rest or under force.
std::optional<Figure> OrderFigure(const CaseModel& model, const std::vector<double>& predicted,
                                  const Target& channel);

/// Displacement per commanded force, measured and model, for every axis of the record that carries
/// a force multisine (at its lines) or another force excitation (Welch). nullopt without any.
std::optional<Figure> ResponseFigure(const CaseModel& model, const std::vector<double>& predicted,
                                     std::size_t record);

/// Mean error of a channel (all records together) in bins of the position, the current and the
/// speed that explain most of it. nullopt when nothing varies.
std::optional<Figure> DependenceFigure(const CaseModel& model, const std::vector<double>& predicted,
                                       const std::string& channel);

}  // namespace ambrig
