#include "discovery/model/static_predictor.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <charconv>
#include <cmath>
#include <complex>

#include "core/math/constants.h"
#include "core/math/linear_equations.h"
#include "discovery/case/bench_tables.h"
#include "discovery/model/linear_responses.h"
#include "rig/rig_assembly.h"
#include "rig/rig_channels.h"
#include "rig/true_rig.h"

namespace ambrig {

namespace {

constexpr double kCurrentStep = 1e-3;  // [A] of the difference behind an inductance, of a meter

/// Linkage of a coil that stands under these currents [Wb].
double LinkageAt(BearingPlant& b, const Lane& current, double x, double y, int coil) {
  b.lanes.Settle(current, x, y);
  return b.lanes.lambda[coil];
}

/// Complex amplitude of a coil's linkage over that of its current, i = i0 + a sin(ω t), in steps of
/// 1/(per_cycle f): mean, slope, cos and sin of the last cycle by least squares. [H]
std::complex<double> LinkageOverCurrent(BearingPlant& b, const Lane& bias, int coil, double f,
                                        int per_cycle) {
  constexpr int kCycles = 6;  // the last one is looked at
  b.lanes.SetStep(1 / (f * per_cycle));
  Eigen::MatrixXd basis(per_cycle, 4);
  Eigen::VectorXd linkage(per_cycle);
  for (int k = 1; k <= kCycles * per_cycle; ++k) {
    const double angle = 2 * kPi * k / per_cycle;
    Lane now = bias;
    now[coil] += kCurrentStep * std::sin(angle);
    b.lanes.StepCurrents(now);
    const int row = k - 1 - (kCycles - 1) * per_cycle;
    if (row < 0) continue;
    basis.row(row) << 1, row, std::cos(angle), std::sin(angle);
    linkage(row) = b.lanes.lambda[coil];
  }
  const Eigen::VectorXd c = SolveLeastSquares(basis, linkage);
  return std::complex<double>(c(3), c(2)) / kCurrentStep;  // sin = Im e^{jωt}
}

/// Z = R + jω Λ/i of one coil at f, all other currents held. Losses of the iron lag by half a step,
/// so that two step lengths are extrapolated to none.
std::complex<double> Impedance(BearingPlant& b, const Lane& bias, double x, double y, int coil,
                               double f) {
  constexpr int kSteps = 64;
  std::complex<double> over_current;
  for (const int per_cycle : {kSteps, 2 * kSteps}) {
    b.lanes.Settle(bias, x, y);
    over_current =
        (per_cycle == kSteps ? -1.0 : 2.0) * LinkageOverCurrent(b, bias, coil, f, per_cycle) +
        over_current;
  }
  return b.lanes.resistance[coil] + std::complex<double>(0, 2 * kPi * f) * over_current;
}

/// Number behind a letter and before an '@', less one; and behind the '@' in Hz.
int CoilIn(const std::string& text) {
  int n = 0;
  std::from_chars(text.data(), text.data() + text.size(), n);
  return n - 1;
}

}  // namespace

StaticPredictor::StaticPredictor(const Case& c, const CaseRecord& record) : record_(record) {
  for (const Channel& out : record.table.outputs) {
    for (std::size_t k = 0; k < c.rig.bearings.size(); ++k) {
      const std::string name = c.rig.bearings[k].name + ".";
      if (!out.name.starts_with(name)) continue;
      const std::string rest = out.name.substr(name.size());
      if (rest.starts_with("lambda"))
        outputs_.push_back({k, Quantity::kLinkage, CoilIn(rest.substr(6))});
      else if (rest.starts_with("L"))
        outputs_.push_back(
            {k, Quantity::kInductance, CoilIn(rest.substr(1)), MeterFrequency(rest)});
      else if (rest.starts_with("R"))
        outputs_.push_back(
            {k, Quantity::kResistance, CoilIn(rest.substr(1)), MeterFrequency(rest)});
      else
        outputs_.push_back({k, Quantity::kForce, ParseChannel(out.name)->index});
    }
  }
  Require(outputs_.size() == record.table.outputs.size(), "outputs of the rig's bearings");
  for (const BearingParameters& b : c.rig.bearings) {
    Inputs in;
    const auto column = [&](const std::string& name) -> const Channel* {
      for (const Channel& ch : record.table.inputs)
        if (ch.name == name) return &ch;
      return nullptr;
    };
    for (const std::string& axis : b.Axes()) in.axes.push_back(column(axis));
    for (const ChannelId& id : ChannelsOf(b, ChannelKind::kCoilCurrent))
      in.coils.push_back(column(id.name()));
    if (const auto at = record.scenario.clamp.find(b.name); at != record.scenario.clamp.end())
      in.x = at->second[0], in.y = at->second[1];
    for (const Excitation& e : StandingExcitations(record.scenario))
      if (e.port == "current" && e.target.starts_with(b.name + ".coil"))
        in.current[CoilIn(e.target.substr(b.name.size() + 5))] += e.Value(1e-9);
    inputs_.push_back(in);
  }
  for (const Channel& ch : record.table.inputs)
    if (ch.name == kFrequencyColumn) frequency_ = &ch;
}

StaticPredictor::Setting StaticPredictor::SettingOf(std::size_t bearing, std::size_t row) const {
  const Inputs& in = inputs_[bearing];
  Setting s{in.x, in.y, in.current, frequency_ ? frequency_->samples[row] : 0};
  if (!in.axes.empty() && in.axes[0]) s.x = in.axes[0]->samples[row];
  if (in.axes.size() > 1 && in.axes[1]) s.y = in.axes[1]->samples[row];
  for (std::size_t j = 0; j < in.coils.size(); ++j)
    if (in.coils[j]) s.current[static_cast<int>(j)] = in.coils[j]->samples[row];
  return s;
}

double StaticPredictor::Value(const Output& o, BearingPlant& b, const Setting& s) {
  const double x = s.x - b.offset_x, y = s.y - b.offset_y;
  if (o.quantity == Quantity::kLinkage) return LinkageAt(b, s.current, x, y, o.index);
  if (o.quantity == Quantity::kForce) {
    double fx = 0, fy = 0;
    b.lanes.Settle(s.current, x, y);
    b.lanes.Force(x, y, &fx, &fy);
    return o.index == 1 ? fy : fx;  // of a thrust bearing z stands in the place of x
  }
  const double f = o.frequency > 0 ? o.frequency : s.frequency;
  const bool alternating = f > 0 && !b.lanes.laws.empty();
  if (o.quantity == Quantity::kResistance)
    return alternating ? Impedance(b, s.current, x, y, o.index, f).real()
                       : b.lanes.resistance[o.index];
  if (alternating) return Impedance(b, s.current, x, y, o.index, f).imag() / (2 * kPi * f);
  Lane more = s.current, less = s.current;
  more[o.index] += kCurrentStep;
  // a coil of two quadrants carries no negative current
  if (!b.lanes.unipolar || s.current[o.index] > kCurrentStep) less[o.index] -= kCurrentStep;
  return (LinkageAt(b, more, x, y, o.index) - LinkageAt(b, less, x, y, o.index)) /
         (more[o.index] - less[o.index]);
}

bool StaticPredictor::Predict(const RigParameters& rig,
                              std::vector<std::vector<double>>& columns) const {
  Plant plant = BuildPlant(TrueRig(rig));
  columns.clear();
  for (std::size_t o = 0; o < outputs_.size(); ++o) {
    const Output& out = outputs_[o];
    const std::vector<double>& sd = record_.table.sd[o];
    columns.emplace_back(sd.size(), 0.0);
    for (std::size_t k = 0; k < sd.size(); ++k)
      if (record_.quality[o].ok[k])
        columns.back()[k] =
            Value(out, plant.bearings[out.bearing], SettingOf(out.bearing, k)) / sd[k];
  }
  return true;
}

}  // namespace ambrig
