#include "app/pages/paper_report.h"

#include <fmt/format.h>

#include "app/figures/paper_figures.h"
#include "app/pages/html.h"

namespace ambrig {

namespace {

struct PaperRow {
  std::string what, paper, here;
};

std::string RangeText(const SlopeRange& r) { return fmt::format("{:.0f} - {:.0f}", r.low, r.high); }

std::string DelayText(const DiagnosisDelays& d) {
  if (d.found == 0) return "not found";
  return fmt::format("{:.2f} - {:.2f}", d.least * 1e3, d.most * 1e3);
}

/// What the paper prints and what came out here.
std::vector<PaperRow> PaperRows(const PaperStudy& s) {
  return {
      {"slope of the healthy coil, theory (Eq. 9) [A/s]", "16761 - 16857", RangeText(s.theory)},
      {fmt::format("  the same, simulated, from i0 = {:.2f} A [A/s]", s.i0), "",
       RangeText(s.simulated)},
      {"error of the slope by 20 mV [A/s]", "about 12", fmt::format("{:.0f}", s.errors.analogue)},
      {"error by 1 V of the bus [A/s]", "about 570", fmt::format("{:.0f}", s.errors.bus)},
      {"error by 0.011 mH of the gap (Eq. 21) [A/s]", "about 120",
       fmt::format("{:.0f}", s.errors.gap)},
      {"bus pumping, peak [V]", "about 1", fmt::format("{:.2f}", s.bus_peak)},
      {"total error, 2000 periods [A/s]", "about +-700", fmt::format("+-{:.0f}", s.half_spread)},
      {"cycle of the algorithm [ms]", "about 1.75", fmt::format("{:.2f}", kPaperCycle * 1e3)},
      {"diagnosis, broken circuit [ms]", "about 2", DelayText(s.open.delays)},
      {"diagnosis, partial short circuit [ms]", "about 2", DelayText(s.shorted.delays)},
  };
}

std::string Found(const DiagnosisDelays& d) { return fmt::format("{} of {}", d.named, d.runs); }

nlohmann::ordered_json DelaysJson(const DiagnosisDelays& d) {
  return {{"runs", d.runs}, {"found", d.found}, {"named", d.named},        {"least", d.least},
          {"mean", d.mean}, {"most", d.most},   {"too_early", d.too_early}};
}

nlohmann::ordered_json RangeJson(const SlopeRange& r) { return {r.low, r.high}; }

std::vector<Cell> LoadCells(const PaperRun& run, const char* name, double turns) {
  const SlopeCircuit c = SingleCoil(run.rig);
  const double L = c.inductance * turns * turns, R = c.resistance * turns;
  return {name,
          fmt::format("{:.0f}", 100 * turns),
          fmt::format("{:.3f}", L * 1e3),
          fmt::format("{:.3f}", R),
          fmt::format("{:.2f}", L / R * 1e3),
          fmt::format("{:.0f}", (c.bus - 2 * c.switch_drop - 0.5 * R) / L)};
}

void AddFault(HtmlReport& report, const PaperRun& run, const char* title, int first) {
  report.Heading(title);
  report.AddFigure(PaperWaveform(run, first));
  report.AddFigure(PaperSamplingPoints(run, first + 1));
  report.AddFigure(PaperSlopeRange(run, first + 2));
  report.AddFigure(PaperFlag(run, first + 3));
}

void AddConverters(HtmlReport& report, const PaperStudy& study) {
  report.Heading("Converters of 8 to 16 bits");
  report.Text(
      "The same runs read by other converters over the same range of ±2.5 A. What a code is worth "
      "as a slope between neighbouring samples, how far the equivalent slope of healthy periods "
      "scatters, and what the detector makes of the two faults with the fault at every place of "
      "its cycle. *Rightly flagged* means: after the fault, and as the fault that it is.");
  std::vector<std::vector<Cell>> rows;
  for (const ConverterRow& r : study.converters)
    rows.push_back({std::to_string(r.bits), fmt::format("{:.0f}", r.step),
                    fmt::format("{:.0f}", r.rms), fmt::format("{:.0f}", r.largest),
                    fmt::format("{} of {}", r.outside, r.periods), Found(r.open),
                    Found(r.shorted)});
  report.Table({"bits", "slope of one code [A/s]", "scatter of k, rms [A/s]",
                "largest distance from Eq. 9 [A/s]", "healthy periods outside ±700 A/s",
                "broken circuit rightly flagged", "partial short rightly flagged"},
               rows);
}

}  // namespace

std::string PaperText(const PaperStudy& study) {
  std::string text = fmt::format("{:<50} {:>14} {:>14}\n", "", "paper", "here");
  for (const PaperRow& r : PaperRows(study))
    text += fmt::format("{:<50} {:>14} {:>14}\n", r.what, r.paper, r.here);
  constexpr const char* kRow = "{:<6} {:>9} {:>9} {:>9} {:>14} {:>13} {:>13}\n";
  text += "\n" +
          fmt::format(kRow, "", "one code", "scatter", "largest", "healthy", "open", "short") +
          fmt::format(kRow, "ADC", "as slope", "rms", "error", "outside", "rightly", "rightly") +
          fmt::format(kRow, "[bit]", "[A/s]", "[A/s]", "[A/s]", "+-700 A/s", "flagged", "flagged");
  for (const ConverterRow& r : study.converters)
    text += fmt::format("{:<6} {:>9.0f} {:>9.0f} {:>9.0f} {:>14} {:>13} {:>13}\n", r.bits, r.step,
                        r.rms, r.largest, fmt::format("{} of {}", r.outside, r.periods),
                        Found(r.open), Found(r.shorted));
  return text;
}

nlohmann::ordered_json PaperJson(const PaperStudy& s) {
  nlohmann::ordered_json converters = nlohmann::ordered_json::array();
  for (const ConverterRow& r : s.converters)
    converters.push_back({{"bits", r.bits},
                          {"code_slope", r.step},
                          {"rms", r.rms},
                          {"largest", r.largest},
                          {"outside", r.outside},
                          {"periods", r.periods},
                          {"open", DelaysJson(r.open)},
                          {"short", DelaysJson(r.shorted)}});
  return {{"theory", RangeJson(s.theory)},
          {"simulated", RangeJson(s.simulated)},
          {"i0", s.i0},
          {"error_20_mV", s.errors.analogue},
          {"error_1_V", s.errors.bus},
          {"error_gap", s.errors.gap},
          {"gap_shift", s.errors.shift},
          {"bus_peak", s.bus_peak},
          {"half_spread", s.half_spread},
          {"cycle", kPaperCycle},
          {"open", DelaysJson(s.open.delays)},
          {"short", DelaysJson(s.shorted.delays)},
          {"converters", converters}};
}

void WritePaperReport(const PaperStudy& study, const std::string& path) {
  HtmlReport report("The seed paper redrawn",
                    "single coils, pulse excitation and the slope detector, simulated");
  report.Text(
      "*An online fault-diagnosis of electromagnetic actuator based on variation characteristics "
      "of load current*: its simulation and its experiment done again with the plant, the "
      "converter and the detector of this program. The paper's text was at hand, its pictures were "
      "not: the figures show what their captions name, as time, current and slope.");
  report.Heading("Its numbers");
  std::vector<std::vector<Cell>> rows;
  for (const PaperRow& r : PaperRows(study)) rows.push_back({r.what, r.paper, r.here});
  report.Table({"", "paper", "here"}, rows);
  report.Heading("Simulation");
  report.AddFigure(PaperFigure4(study));
  report.AddFigure(PaperFigure5(study));
  report.Heading("Error analysis");
  report.AddFigure(PaperFigure11(study));
  AddFault(report, study.open, "Broken circuit", 12);
  report.Heading("The load");
  const double turns = 1 - study.shorted.scenario.faults.front().Get("fraction", 0);
  report.Table({"load", "turns [%]", "inductance [mH]", "resistance [ohm]", "time constant [ms]",
                "slope at 0.5 A (Eq. 10) [A/s]"},
               {LoadCells(study.shorted, "normal stage", 1),
                LoadCells(study.shorted, "partial short circuit", turns)},
               "In place of figure 16: what the switch changes in the coil");
  AddFault(report, study.shorted, "Partial short circuit", 17);
  AddConverters(report, study);
  report.Write(path);
}

}  // namespace ambrig
