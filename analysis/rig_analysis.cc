#include "analysis/rig_analysis.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/iso14839.h"
#include "analysis/measured_sensitivity.h"
#include "core/math/constants.h"
#include "rig/clearance.h"

namespace ambrig {

namespace {

constexpr int kSweep = 161;  // speeds of the sweeps; every fourth has its modes too
constexpr int kModes = 4;    // of the rotor alone
// further speeds on either side of a narrow resonance, quarter half-widths apart
constexpr int kPeak = 16;

std::vector<double> Ascending(std::vector<double> x) {
  std::sort(x.begin(), x.end());
  x.erase(std::unique(x.begin(), x.end()), x.end());
  return x;
}

class Analysis {
 public:
  Analysis(const RigParameters& rig, const AnalysisOptions& options) {
    out_.options = options;
    out_.point = FindOperatingPoint(rig);
  }

  RigAnalysis Run(const RigParameters& rig) {
    Say(0, "operating point");
    out_.capacity = FindCapacity(out_.point);
    out_.supports = AnalyseSupports(out_.point, kModes);
    AtOperatingSpeeds();
    OverSpeed();
    AssessStandards();
    Measure(rig);
    return std::move(out_);
  }

 private:
  void Say(double fraction, const std::string& text) const {
    if (out_.options.stop && out_.options.stop->load()) throw Interrupted();
    if (out_.options.progress) out_.options.progress(fraction, text);
  }

  void AtOperatingSpeeds() {
    const std::vector<double> speeds = Ascending({0, out_.options.lowest, out_.options.highest});
    for (double speed : speeds) {
      Say(0.02 + 0.04 * static_cast<double>(out_.sensitivity.size()), "sensitivity");
      const ClosedLoop loop(out_.point, speed);
      const TransferFunction transfer(out_.point, loop);
      out_.sensitivity.push_back(FindSensitivity(out_.point, transfer, out_.options.highest));
      const std::vector<double>& f = out_.sensitivity.back().frequency;
      if (speed == 0) {
        Say(0.05, "dynamic stiffness");
        std::vector<double> some;
        for (std::size_t k = 0; k < f.size(); k += 3) some.push_back(f[k]);
        out_.stiffness = FindStiffness(out_.point, transfer, some);
      }
      if (speed == speeds.back()) Responses(transfer, f);
    }
  }

  void Responses(const TransferFunction& transfer, const std::vector<double>& frequency) {
    for (const auto& [input, output] : out_.options.responses) {
      const auto in = transfer.FindInput(input);
      const auto to = transfer.FindOutput(output);
      ResponseCurve curve{input, output, fmt::format("{}/{}", to.unit, in.unit), frequency, {}};
      for (double f : frequency) curve.values.push_back(transfer.Between(in, to, 2 * kPi * f));
      out_.responses.push_back(std::move(curve));
    }
  }

  void OverSpeed() {
    const double lowest = out_.options.lowest, highest = out_.options.highest,
                 step = out_.options.fastest / (kSweep - 1);
    std::vector<double> speeds = {lowest, highest};  // exactly, beside the grid
    for (int k = 0; k < kSweep; ++k) speeds.push_back(step * k);
    for (double speed : Ascending(speeds)) {
      Say(0.15 + 0.3 * speed / out_.options.fastest, "modes over speed");
      const bool row =
          std::fmod(std::round(speed / step), 4) == 0 || speed == lowest || speed == highest;
      if (row) out_.rows.push_back(FindModes(out_.point, ClosedLoop(out_.point, speed)));
    }
    out_.tracks = FollowModes(out_.rows);
    out_.criticals = FindCriticals(out_.tracks);
    for (const DampedCritical& c : out_.criticals) {
      const double half_width = c.mode.zeta * c.speed;
      for (int k = -kPeak; k <= kPeak && half_width < 4 * step; ++k)
        if (const double at = c.speed + 0.25 * k * half_width; at > 0 && at < out_.options.fastest)
          speeds.push_back(at);
    }
    std::vector<ClosedLoop> loops;
    for (double speed : Ascending(speeds)) {
      Say(0.45 + 0.25 * speed / out_.options.fastest, "unbalance over speed");
      if (speed > 0) loops.emplace_back(out_.point, speed);
    }
    Say(0.7, "unbalance response");
    out_.unbalance =
        SweepUnbalance(out_.point, loops, StandardUnbalance(out_.point, out_.options.highest));
  }

  void AssessStandards() {
    const AnalysisOptions& o = out_.options;
    for (const UnbalanceSweep& sweep : out_.unbalance)
      for (const OrderTrack& track : sweep.tracks) {
        DisplacementRow row{track.bearing, sweep.unbalance.name, 0, 0, 'A'};
        const BearingParameters* b = out_.point.rig().Find(track.bearing);
        row.clearance = ClearanceOf(*b);
        for (std::size_t k = 0; k < sweep.speed.size(); ++k)
          if (sweep.speed[k] >= o.lowest && sweep.speed[k] <= o.highest)
            row.largest = std::max(row.largest, track.amplitude[k]);
        row.zone = DisplacementZone(row.largest / row.clearance);
        out_.displacement.push_back(row);
        for (const ResponsePeak& peak : track.peaks)
          out_.separation.push_back(
              {track.bearing, sweep.unbalance.name, peak,
               AssessSeparation(peak.speed, peak.amplification, o.lowest, o.highest)});
      }
  }

  void Measure(const RigParameters& rig) {
    const int count = out_.options.measured;
    if (count == 0) return;
    const ClosedLoop loop(out_.point, 0);
    const TransferFunction transfer(out_.point, loop);
    const double low = 20, high = std::min(2000.0, 0.4 / loop.Ts());
    for (const AxisCapacity& c : out_.capacity)
      if (out_.options.sine > 0.5 * c.usable())
        throw InputError(
            fmt::format("sine = {:g} N, allowed: up to half the capacity of {}, {:.3g} N, where "
                        "the loop is still linear",
                        out_.options.sine, c.axis, 0.5 * c.usable()));
    for (std::size_t a = 0; a < out_.capacity.size(); ++a)
      for (int k = 0; k < count; ++k) {
        Say(0.75 + 0.25 * (static_cast<double>(a) + static_cast<double>(k) / count) /
                       static_cast<double>(out_.capacity.size()),
            "injecting sines into the switching rig");
        SineTest test;
        test.axis = a;
        test.frequency = low * std::pow(high / low, count > 1 ? k / (count - 1.0) : 0.5);
        test.amplitude =
            out_.options.sine > 0 ? out_.options.sine : 0.01 * out_.capacity[a].usable();
        MeasuredPoint point{a, test.frequency, MeasureSensitivity(rig, test, out_.options.stop), 0};
        const auto axis = static_cast<Eigen::Index>(a);
        point.computed =
            transfer(2 * kPi * test.frequency)(loop.Command(axis), loop.Excitation(axis));
        out_.measured.push_back(point);
      }
  }

  RigAnalysis out_;
};

}  // namespace

bool RigAnalysis::stable() const {
  return std::all_of(rows.begin(), rows.end(), [](const ClosedLoopModes& r) { return r.stable(); });
}

RigAnalysis Analyse(const RigParameters& rig, const AnalysisOptions& o) {
  if (!(o.lowest >= 0 && o.highest >= o.lowest && o.fastest > 0 && o.fastest >= o.highest))
    throw InputError(
        fmt::format("speeds {} to {} rad/s, fastest {} rad/s: allowed are 0 <= lowest <= highest "
                    "<= fastest, fastest > 0",
                    o.lowest, o.highest, o.fastest));
  return Analysis(rig, o).Run(rig);
}

}  // namespace ambrig
