/// ambrig compare: the model beside the measurement.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "app/commands/commands.h"
#include "app/commands/outputs.h"
#include "app/commands/progress.h"
#include "app/json/discovery_json.h"
#include "app/pages/discovery_parts.h"
#include "app/pages/discovery_report.h"
#include "app/text/screen.h"
#include "core/record/hdf5.h"
#include "discovery/decision/comparison_series.h"
#include "discovery/decision/unit_errors.h"

namespace ambrig {

namespace {

struct CompareOptions {
  CommonOptions common;
  std::string file, series;
  bool no_blocks = false;
};

/// The data file's own name: its folder is the same for all.
std::string FileName(const std::string& path) {
  return std::filesystem::path(path).filename().string();
}

std::string ErrorOverNoise(double ratio, int digits) {
  return std::isfinite(ratio) ? fmt::format("{:.{}f}", ratio, digits) : "-";
}

void PrintRecord(const RecordComparison& r) {
  const ChannelError* worst = nullptr;
  for (const ChannelError& e : r.channels)
    if (!worst || e.ratio > worst->ratio) worst = &e;
  fmt::print("{:<22} {:<28} {:>7}  {}\n", Shortened(FileName(r.data), 22),
             Shortened(r.scenario, 28), ErrorOverNoise(r.ratio, 2),
             worst ? fmt::format("{} {:.2f}", worst->channel, worst->ratio) : "-");
  for (const auto& [block, ratio] : r.blocks)
    fmt::print("    block {:<40} {:>7.2f}\n", block, ratio);
}

void PrintComparison(const Comparison& comparison) {
  fmt::print("error over noise: rms of measured less model over the noise's; 1: only noise\n");
  fmt::print("{:<22} {:<28} {:>7}  {}\n", "record", "scenario", "error", "worst channel");
  for (const RecordComparison& r : comparison.records) PrintRecord(r);
  const bool unseen = std::any_of(comparison.records.begin(), comparison.records.end(),
                                  [](const RecordComparison& r) { return r.validate; });
  fmt::print(
      "error over noise, all records: {}{}\n", ErrorOverNoise(comparison.ratio, 3),
      unseen ? fmt::format(" (to be fitted {}, unseen {})", ErrorOverNoise(comparison.ratio_fit, 3),
                           ErrorOverNoise(comparison.ratio_validate, 3))
             : "");
  for (const std::string& w : comparison.words) fmt::print("{}\n", Wrapped("  " + w, 4));
  if (const std::string text = BlockText(comparison); !text.empty())
    fmt::print("{}\n", Wrapped("  " + text, 4));
}

int RunCompare(const CompareOptions& o) {
  const Case c = ReadCase(o.file);
  o.common.CheckOutputs({o.file, c.rig_file}, {o.series});
  for (const std::string& note : c.notes) fmt::print("{}\n", Wrapped("data: " + note, 6));
  CaseModel model(c);
  model.stop = &interrupted;
  Comparison comparison;
  {
    Progress progress("compare");
    const Hypothesis drawing = Hypothesis::Base(c.rig);
    comparison = Compare(model, drawing, !o.no_blocks,
                         [&](double f, const std::string& text) { progress.Update(f, text); });
    progress.Update(0.99, "what coils differ by");
    const std::string said = SaidOfCoils(model, drawing, comparison.residual);
    if (!said.empty()) comparison.words.push_back(said);
  }
  PrintComparison(comparison);
  o.common.WriteJson(CompareJson(comparison));
  if (!o.series.empty())
    WriteHdf5Groups(ComparisonSeries(model, comparison), {{"made_by", "ambrig compare"}}, o.series);
  if (!o.common.html.empty()) WriteCompareReport(model, comparison, o.common.html);
  return 0;
}

}  // namespace

void AddCompare(CLI::App& app, Work& work) {
  auto options = std::make_shared<CompareOptions>();
  CLI::App* command = app.add_subcommand(
      "compare", "compare model and measurement, channel by channel and block by block");
  command->add_option("case", options->file, "case file (TOML)")->required();
  command->add_flag("--no-blocks", options->no_blocks, "skip the block tests with measured inputs");
  command
      ->add_option("--series", options->series,
                   "also write every sample of measurement, model and error over noise (HDF5: a "
                   "group per record over time, A.x.measured, A.x.model, A.x.error)")
      ->type_name("FILE")
      ->check(OutputFile());
  options->common.AddTo(*command);
  command->footer(
      "Examples:\n  ambrig compare examples/rub/case.toml --html compare.html\n"
      "  ambrig compare examples/rub/case.toml --no-blocks --series series.h5\n"
      "A case of your own to start from: ambrig hide --help. Records over time,\n"
      "frequency responses (kind = \"frf\") and static tables (kind = \"static\"):\n"
      "docs/guide/bench_records.md.");
  command->callback([options, &work] { work = [options] { return RunCompare(*options); }; });
}

}  // namespace ambrig
