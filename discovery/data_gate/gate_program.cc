// A rig file that states other gains than those of the controller that ran.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>

#include "core/math/linear_equations.h"
#include "discovery/data_gate/gate_checks.h"
#include "discovery/data_gate/program_error.h"
#include "discovery/model/record_traits.h"
#include "rig/parameters/bearing_kind.h"
#include "rig/rig_figures.h"

namespace ambrig {

namespace {

constexpr std::size_t kGains = 3;
constexpr std::array<double PidParameters::*, kGains> kGainFields = {
    &PidParameters::kp, &PidParameters::kd, &PidParameters::ki};
constexpr std::array<const char*, kGains> kGainNames = {"kp", "kd", "ki"};

/// Sums over the axes under the same gains: what these answer, and what the program leaves.
struct GainSums {
  Eigen::Matrix3d square = Eigen::Matrix3d::Zero();
  Eigen::Vector3d with_error = Eigen::Vector3d::Zero();
  double error = 0;
  int axes = 0;
  bool any_right = false;
};

/// The rig with one gain of all its controllers doubled.
RigParameters WithDouble(const RigParameters& rig, double PidParameters::*gain) {
  RigParameters out = rig;
  out.controller.pid.*gain *= 2;
  for (BearingParameters& b : out.bearings)
    if (b.controller) (*b.controller).*gain *= 2;
  return out;
}

/// Sums by the bearing that has gains of its own; "": the others.
using SumsOfGains = std::map<std::string, GainSums>;

/// The sums that an axis belongs to; null: none.
GainSums* SumsOf(const RigParameters& rig, const std::string& axis, SumsOfGains& sums) {
  for (const BearingParameters& b : rig.bearings)
    if (std::ranges::count(b.Axes(), axis)) return &sums[b.controller ? b.name : ""];
  return nullptr;
}

/// Adds the axes of a record that show the program; the error is linear in the gains. What is
/// right by one axis is replayed with no other gains.
void AddRecord(const CaseRecord& r, const RigParameters& rig,
               const std::array<RigParameters, kGains>& doubled, SumsOfGains& sums) {
  const BridgedRecord data = ControllerRecord(r.data);
  const std::vector<ControllerAxis> now = ControllerAxes(rig, r.scenario, data);
  for (const ControllerAxis& a : now)
    if (GainSums* s = SumsOf(rig, a.axis, sums); s && ShowsProgram(a) && !IsWrong(a))
      s->any_right = true;
  const auto open = [&](const ControllerAxis& a) {
    const GainSums* s = SumsOf(rig, a.axis, sums);
    return s && ShowsProgram(a) && !s->any_right;
  };
  if (std::ranges::none_of(now, open)) return;
  std::array<std::vector<ControllerAxis>, kGains> twice;
  for (std::size_t g = 0; g < kGains; ++g) twice[g] = ControllerAxes(doubled[g], r.scenario, data);
  for (std::size_t a = 0; a < now.size(); ++a) {
    if (!open(now[a])) continue;
    GainSums& s = *SumsOf(rig, now[a].axis, sums);
    ++s.axes;
    for (std::size_t k = 0; k < now[a].error.size(); ++k) {
      if (!now[a].counts[k]) continue;
      Eigen::Vector3d answer;
      for (std::size_t g = 0; g < kGains; ++g)
        answer(static_cast<Eigen::Index>(g)) = now[a].error[k] - twice[g][a].error[k];
      s.square += answer * answer.transpose();
      s.with_error += answer * now[a].error[k];
      s.error += now[a].error[k] * now[a].error[k];
    }
  }
}

/// "kp = 2.354e+05, kd = 374" of the gains that differ; "" where no gains explain the set-points.
std::string GainsThatRan(const PidParameters& stated, const GainSums& sums) {
  constexpr double kLeft = 0.1, kDiffers = 0.01, kMost = 10;  // rms share, of a gain, factor
  if (sums.any_right || sums.axes < 2 || sums.error <= 0) return "";
  const Eigen::Vector3d more = SolveSymmetric(sums.square, sums.with_error);
  const double left = sums.error - more.dot(sums.with_error);
  if (left > kLeft * kLeft * sums.error) return "";
  std::vector<std::string> lines;
  for (std::size_t g = 0; g < kGains; ++g) {
    const double factor = 1 + more(static_cast<Eigen::Index>(g));
    if (!(factor >= 0 && factor < kMost)) return "";
    if (std::abs(factor - 1) > kDiffers)
      lines.push_back(fmt::format("{} = {:.4g}", kGainNames[g], factor * stated.*kGainFields[g]));
  }
  return fmt::format("{}", fmt::join(lines, ", "));
}

}  // namespace

void CheckProgram(const CaseModel& model, std::vector<DataFault>& out) {
  const RigParameters& rig = model.data().rig;
  std::array<RigParameters, kGains> doubled;
  for (std::size_t g = 0; g < kGains; ++g) doubled[g] = WithDouble(rig, kGainFields[g]);
  SumsOfGains sums;
  for (const BearingParameters& b : rig.bearings)
    if (b.kind->eight_poles) sums[b.controller ? b.name : ""];
  for (const CaseRecord& r : model.data().records) {
    if (std::ranges::all_of(sums, [](const auto& s) { return s.second.any_right; })) return;
    if (OverTime(r) && r.imposed == Imposed::kNothing && r.scenario.faults.empty() &&
        HasControllerBlock(rig, r.scenario, r.data))
      AddRecord(r, rig, doubled, sums);
  }
  for (const auto& [bearing, s] : sums) {
    const BearingParameters* b = rig.Find(bearing);
    const std::string gains = GainsThatRan(b ? PidOf(rig, *b) : rig.controller.pid, s);
    if (gains.empty()) continue;
    DataFault f;
    f.record = model.data().rig_file;
    f.channel = b ? b->name : "the rig";
    f.fault = "controller";
    f.detail = "its set-points were computed from its readings with other gains";
    f.mend = fmt::format("{} in [{}controller]", gains, b ? "bearings." + b->name + "." : "");
    f.probability = 1;
    out.push_back(std::move(f));
  }
}

}  // namespace ambrig
