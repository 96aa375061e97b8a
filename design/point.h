#pragma once
/// One point of a study: a candidate with numbers for its variables, its rig, its figures.
#include <atomic>

#include "design/study.h"

namespace ambrig {

/// The rig file's text with the variables' values in place. @throws InputError
std::string RigTextOfPoint(const DesignCandidate& c, const std::vector<double>& values);
RigParameters RigOfPoint(const DesignCandidate& c, const std::vector<double>& values);

struct Evaluation {
  // as Study::figures; inf where the loop is unstable or the run failed
  std::vector<double> figures;
  std::string note;  // why, one line
};

/// Worst value of every figure over the nominal rig and its draws. What the rig cannot do is a
/// note, never an exception. @throws Interrupted
Evaluation Evaluate(const Study& study, std::size_t candidate, const std::vector<double>& values,
                    const std::atomic<bool>* stop);

/// The rig with one draw of its parameters as the plant's true values.
RigParameters Drawn(RigParameters rig, const std::vector<double>& draw);

/// Distance of a named plane from where it stood at the start of the record [m], one value a row.
std::vector<double> PlaneDistance(const Record& record, const std::string& plane);

/// Every limit of the study kept.
bool MeetsLimits(const Study& study, const std::vector<double>& figures);

}  // namespace ambrig
