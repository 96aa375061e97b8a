#include "app/pages/commission_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/figures/series.h"
#include "app/pages/html.h"
#include "core/base/coil_name.h"
#include "fdd/detectors/detection_feed.h"
#include "fdd/model/loss_excess.h"

namespace ambrig {

namespace {

using Json = nlohmann::ordered_json;

constexpr double kOwnPart = 0.9;  // of c that a bypassed share makes
constexpr int kOfDecision = 3;    // periods that a decision takes
constexpr double kSpread = 2;     // the noise of a window stays this share of its band away

/// `of_loss`: c over a small loss of turns, 2 of a coil that shares no core.
double ExcessOfShort(double s, double of_loss) {
  return kOwnPart * of_loss / 2 * (1 / ((1 - s) * (1 - s)) - 1);
}
double ShortOfExcess(double c, double of_loss) {
  return 1 - 1 / std::sqrt(1 + c / (kOwnPart * of_loss / 2));
}

/// Periods after which c stands beyond the band: the window fills while the fault lasts.
double PeriodsTo(const CommissionedBearing& b, int coil, double of_loss, double c) {
  double best = -1;
  for (int w = 0; w < kExcessWindows; ++w) {
    const double need = HealthyBand(b, w, coil, of_loss) + b.largest[w][coil] / kSpread;
    if (c < need) continue;
    const double periods = std::ceil(kExcessWindow[w] * need / c) + kOfDecision - 1;
    if (best < 0 || periods < best) best = periods;
  }
  return best;
}

std::string Ms(double seconds) { return seconds < 0 ? "-" : fmt::format("{:.2f}", seconds * 1e3); }

int CoilsOf(const RigParameters& rig, const CommissionedBearing& b) {
  return rig.Find(b.name)->coils();
}

Detectable DetectableOf(const RigParameters& rig, const CommissionedBearing& b, int coil) {
  return DetectableIn(b, coil, 1 / rig.amplifier.switching_frequency,
                      ExcessOfLoss(LinkageModelOf(*rig.Find(b.name)), coil).own);
}

/// Amplitudes of the larger axis.
std::string RunOutText(const CommissionedBearing& b) {
  const auto amplitude = [&](std::size_t order) {
    const RunOut& r = b.circuit.run_out;
    const std::size_t at = 2 * (order - 1);
    return std::max(std::hypot(r.x[at], r.x[at + 1]), std::hypot(r.y[at], r.y[at + 1]));
  };
  return fmt::format(
      "the position sensors read run-out, {:.1f} um once a turn and\n{:.1f} um twice, which the "
      "detector takes off",
      1e6 * amplitude(1), 1e6 * amplitude(2));
}

Json ScatterJson(const std::vector<ExcessScatter>& scatter) {
  Json out = Json::array();
  for (const ExcessScatter& s : scatter) {
    Json bins = Json::array();
    for (const auto& bin : s.bins)
      bins.push_back({{"from", bin.from},
                      {"to", bin.to},
                      {"rms", bin.rms},
                      {"largest", bin.largest},
                      {"values", bin.periods}});
    out.push_back({{"quantity", s.quantity}, {"unit", s.unit}, {"bins", bins}});
  }
  return out;
}

}  // namespace

Detectable DetectableIn(const CommissionedBearing& b, int coil, double period, double of_loss) {
  Detectable d;
  double least = kInfinity;
  for (int w = 0; w < kExcessWindows; ++w)
    least = std::min(least, HealthyBand(b, w, coil, of_loss) + b.largest[w][coil] / kSpread);
  d.smallest_short = ShortOfExcess(least, of_loss);
  d.smallest_delay =
      period * PeriodsTo(b, coil, of_loss, ExcessOfShort(d.smallest_short, of_loss) * (1 + 1e-9));
  const double tenth = PeriodsTo(b, coil, of_loss, ExcessOfShort(0.1, of_loss));
  d.tenth_delay = tenth < 0 ? -1 : tenth * period;
  d.open_delay = kOfDecision * period;
  return d;
}

double RippleInductance(const RigParameters& rig, const CommissionedBearing& b, int coil) {
  const LinkageModel m = LinkageModelOf(*rig.Find(b.name));
  const SamplingSettings sampling{
      rig.samples_per_period(), 1 / (rig.amplifier.switching_frequency * rig.samples_per_period()),
      &rig.amplifier};
  FluxFilter filter(m, sampling, b.circuit);
  const std::vector<Lane> adc(64);
  const Lane duty;
  MeasuredPeriod in;
  in.adc = adc.data();
  in.duty = &duty;
  in.bus = rig.amplifier.bus_voltage;
  FluxPeriod period;
  filter.Period(in, &period);
  return b.coils.gain[coil] * filter.inductances()[coil] * period.own[coil] + b.coils.leakage[coil];
}

Json CommissionJson(const RigParameters& rig, const CommissioningResult& r) {
  Json bearings = Json::array();
  for (std::size_t k = 0; k < r.model.bearings.size(); ++k) {
    const CommissionedBearing& b = r.model.bearings[k];
    Json coils = Json::array();
    for (int j = 0; j < CoilsOf(rig, b); ++j) {
      const Detectable d = DetectableOf(rig, b, j);
      const double L = RippleInductance(rig, b, j);
      coils.push_back({{"coil", j + 1},
                       {"gain", b.coils.gain[j]},
                       {"leakage", b.coils.leakage[j]},
                       {"resistance", b.coils.resistance[j]},
                       {"offset", b.coils.offset[j]},
                       {"ripple_inductance", L},
                       {"slope", rig.amplifier.bus_voltage / L},
                       {"time_constant", L / b.coils.resistance[j]},
                       {"largest_excess", b.largest[2][j]},
                       {"smallest_short", d.smallest_short},
                       {"smallest_short_delay", d.smallest_delay},
                       {"tenth_delay", d.tenth_delay < 0 ? Json(nullptr) : Json(d.tenth_delay)},
                       {"open_delay", d.open_delay}});
    }
    bearings.push_back({{"name", b.name},
                        {"usable", b.usable()},
                        {"grade", b.grade},
                        {"rows", b.rows},
                        {"sensor_zero", {b.circuit.dx, b.circuit.dy}},
                        {"run_out", {{"x", b.circuit.run_out.x}, {"y", b.circuit.run_out.y}}},
                        {"relaxation", b.circuit.relaxation},
                        {"coils", coils},
                        {"scatter", ScatterJson(r.scatter[k])}});
  }
  return {{"rig", rig.name}, {"bearings", bearings}};
}

std::string CommissionText(const RigParameters& rig, const CommissioningResult& r) {
  constexpr const char* kRow = "{:<9} {:>6} {:>8} {:>8} {:>8} {:>8} {:>8} {:>8} {:>8}\n";
  std::string text =
      fmt::format(kRow, "", "", "ripple L", "R", "L/R", "scatter", "least", "its", "10 %") +
      fmt::format(kRow, "", "", "", "", "", "", "short", "delay", "delay") +
      fmt::format(kRow, "coil", "grade", "[mH]", "[ohm]", "[ms]", "[-]", "[%]", "[ms]", "[ms]");
  for (const CommissionedBearing& b : r.model.bearings)
    for (int j = 0; j < CoilsOf(rig, b); ++j) {
      const Detectable d = DetectableOf(rig, b, j);
      const double L = RippleInductance(rig, b, j);
      text +=
          fmt::format("{:<9} {:>6.2f} {:>8.3f} {:>8.3f} {:>8.2f} {:>8.4f} {:>8.1f} {:>8} {:>8}\n",
                      CoilName(b.name, j), b.grade, L * 1e3, b.coils.resistance[j],
                      L / b.coils.resistance[j] * 1e3, b.largest[2][j], 100 * d.smallest_short,
                      Ms(d.smallest_delay), Ms(d.tenth_delay));
    }
  text += fmt::format(
      "grade: what the model leaves unexplained, above {} it is not used; ripple L: of\n"
      "the current's ripple, with R and L/R; scatter: largest relative excess of the\n"
      "slope over ten healthy periods; least short: share of the turns that is\n"
      "noticed, with its delay and that of a short of 10 %, by the learnt bands.\n",
      kWorstGrade);
  for (const CommissionedBearing& b : r.model.bearings)
    if (!b.circuit.run_out.none()) text += fmt::format("bearing {}: {}\n", b.name, RunOutText(b));
  for (const CommissionedBearing& b : r.model.bearings)
    if (!b.usable())
      text += fmt::format(
          "bearing {}: grade {:.2f} is above {}: the model does not express this "
          "plant;\nthe detector will not rely on it\n",
          b.name, b.grade, kWorstGrade);
  return text;
}

void WriteCommissionReport(const RigParameters& rig, const CommissioningResult& r,
                           const std::string& file) {
  HtmlReport report("Commissioning of the fault detection", "rig " + rig.name);
  report.Text(fmt::format(
      "The detector watched the healthy machine and learnt how the flux linkage of every coil "
      "follows its voltage. What remains in healthy running sets the bands; a fault must leave "
      "them.\n\n"
      "**Grade**: mean of what the learnt model leaves unexplained in a row, over its expected "
      "size; above {} the model is not used. **Row**: the slope of one coil in one phase of the "
      "switching period, averaged over eight periods. "
      "**Excess**: by how much the slope of a coil's flux linkage is larger than "
      "its voltage accounts for, as a share: 0 healthy, -1 no current. **Ripple inductance**: "
      "what the current's slope within a switching period shows, below that at rest where iron "
      "has eddy currents. **Smallest short**: share of the turns that leaves the bands, and after "
      "which time; beside it the delays of a short of 10 % and of a broken coil.",
      kWorstGrade));
  for (std::size_t k = 0; k < r.model.bearings.size(); ++k) {
    const CommissionedBearing& b = r.model.bearings[k];
    report.Heading("Bearing " + b.name);
    report.Verdict(b.usable() ? Verdict::kOk : Verdict::kFail,
                   fmt::format("Grade {:.2f} over {} rows; {}", b.grade, b.rows,
                               b.usable() ? "the model expresses this bearing"
                                          : "refused: the model does not express this bearing"));
    if (!b.circuit.run_out.none()) report.Text("Of this bearing " + RunOutText(b) + ".");
    std::vector<std::vector<Cell>> rows;
    for (int j = 0; j < CoilsOf(rig, b); ++j) {
      const Detectable d = DetectableOf(rig, b, j);
      const double L = RippleInductance(rig, b, j);
      rows.push_back({Cell(std::to_string(j + 1)), Cell(fmt::format("{:.3f}", L * 1e3)),
                      Cell(fmt::format("{:.0f}", rig.amplifier.bus_voltage / L)),
                      Cell(fmt::format("{:.3f}", b.coils.resistance[j])),
                      Cell(fmt::format("{:.2f}", b.coils.offset[j])),
                      Cell(fmt::format("{:.4f}", b.largest[2][j])),
                      Cell(fmt::format("{:.1f}", 100 * d.smallest_short)),
                      Cell(Ms(d.smallest_delay)), Cell(Ms(d.tenth_delay)), Cell(Ms(d.open_delay))});
    }
    report.Table(
        {"coil", "ripple inductance [mH]", "slope at the nominal bus [A/s]", "R [ohm]",
         "voltage offset [V]", "largest healthy excess [-]", "smallest short [% of the turns]",
         "its delay [ms]", "10 % short [ms]", "open [ms]"},
        rows);
    for (const ExcessScatter& s : r.scatter[k]) {
      std::vector<std::vector<Cell>> bins;
      const DisplayUnit unit = ChooseUnit(s.bins.empty() ? 0 : s.bins.back().to, s.unit);
      for (const auto& bin : s.bins)
        bins.push_back(
            {Cell(fmt::format("{:.3g} to {:.3g}", bin.from * unit.factor, bin.to * unit.factor)),
             Cell(fmt::format("{:.4f}", bin.rms)), Cell(fmt::format("{:.4f}", bin.largest)),
             Cell(std::to_string(bin.periods))});
      report.Table({fmt::format("{} [{}]", s.quantity, unit.name), "excess, rms [-]",
                    "excess, largest [-]", "values"},
                   bins,
                   "Scatter of the healthy excess, means over ten periods, against " + s.quantity);
    }
  }
  report.Write(file);
}

}  // namespace ambrig
