#pragma once
/// What a report shows of one point beside its figures: how the nominal rig answers, linear and in
/// the study's scenarios.
#include "design/run_study.h"

namespace ambrig {

struct ScenarioTrace {
  // [s], largest distance from the centre over the radial bearings' readings [m]
  std::vector<double> t, orbit;
  // of the study's plane_orbit: distance from where it stood at the start [m]
  std::vector<std::pair<std::string, std::vector<double>>> planes;
  RunResult result;
};

struct PointResponses {
  std::size_t point = 0;
  // [s], reading of the first axis after a unit load there [m/N]
  std::vector<double> step_t, step;
  // largest over the axes that [controller] has and the study's speeds
  std::vector<double> hertz, sensitivity;
  std::vector<ScenarioTrace> scenarios;  // as in the study
};

/// @throws InputError as a run does, Interrupted
PointResponses ResponsesOf(const Study& study, const StudyResult& result, std::size_t point,
                           const std::atomic<bool>* stop);

/// A candidate's point for the reports: on the front if it has one there, else feasible, else its
/// start.
std::size_t RepresentativeOf(const Study& study, const StudyResult& result, std::size_t candidate);

}  // namespace ambrig
