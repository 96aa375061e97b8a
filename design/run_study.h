#pragma once
/// A whole study: every point evaluated once, on all cores, kept in a journal. The door of oneTBB
/// in this folder.
///
///   sweep     the rig file's own numbers, then the grid of `values`, or Sobol points in the ranges
///   optimise  per candidate and direction of the objectives a Subplex search
///   (design/nlopt_search.h) of
///             max_j w_j F_j/F_j0 + 0.05 sum_j w_j F_j/F_j0 + 10 (what limits are exceeded by)
///               F_j0: of the start
///
/// A search asks for one point after the other, the searches run side by side. Points come in the
/// order of candidates, directions, evaluations, whatever finished first: same study, same bytes,
/// any number of jobs.
#include <atomic>
#include <functional>
#include <string>

#include "design/point.h"

namespace ambrig {

struct StudyPoint {
  std::size_t candidate = 0;
  std::vector<double> values;
  Evaluation result;
  bool feasible = false;  // every limit kept
  bool front = false;     // nobody feasible is better in all objectives
};

struct StudyResult {
  std::vector<StudyPoint> points;
  std::vector<double> scales;  // of the objectives: what the first candidate's start has
};

struct StudyOptions {
  std::string folder;  // of the journal
  int jobs = 0;        // 0: all cores
  const std::atomic<bool>* stop = nullptr;
  /// From any thread: points done, expected.
  std::function<void(std::size_t, std::size_t)> progress;
};

/// @throws InputError when the folder holds another study, Interrupted when stopped (what is done
/// stays).
StudyResult RunStudy(const Study& study, const StudyOptions& options);

}  // namespace ambrig
