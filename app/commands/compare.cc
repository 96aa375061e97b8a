/// ambrig compare: the model beside the measurement.
#include <fmt/format.h>

#include "app/commands/commands.h"
#include "app/commands/progress.h"
#include "app/json/discovery_json.h"
#include "app/pages/discovery_report.h"

namespace ambrig {

namespace {

struct CompareOptions {
  CommonOptions common;
  std::string file;
  bool no_blocks = false;
};

int RunCompare(const CompareOptions& o) {
  const Case c = ReadCase(o.file);
  o.common.CheckOutputs({o.file, c.rig_file});
  for (const std::string& note : c.notes) fmt::print("data: {}\n", note);
  CaseModel model(c);
  model.stop = &interrupted;
  Comparison comparison;
  {
    Progress progress("compare");
    comparison = Compare(model, Hypothesis::Base(c.rig), !o.no_blocks,
                         [&](double f, const std::string& text) { progress.Update(f, text); });
  }
  fmt::print("{:<28} {:<34} {:>8}  worst channel\n", "record", "scenario", "ratio");
  for (const RecordComparison& r : comparison.records) {
    const ChannelError* worst = nullptr;
    for (const ChannelError& e : r.channels)
      if (!worst || e.ratio > worst->ratio) worst = &e;
    fmt::print("{:<28} {:<34} {:>8.2f}  {}\n",
               r.data.size() > 28 ? r.data.substr(r.data.size() - 28) : r.data, r.scenario, r.ratio,
               worst ? fmt::format("{} {:.2f}", worst->channel, worst->ratio) : "-");
    for (const auto& [block, ratio] : r.blocks)
      fmt::print("    block {:<12} {:.2f}\n", block, ratio);
  }
  fmt::print(
      "ratio of the error to the noise floor: {:.3f} (fit {:.3f}, unseen {:.3f}); 1 means nothing "
      "is left to explain\n",
      comparison.ratio, comparison.ratio_fit, comparison.ratio_validate);
  for (const std::string& w : comparison.words) fmt::print("  {}\n", w);
  o.common.WriteJson(CompareJson(comparison));
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
  options->common.AddTo(*command);
  command->footer(
      "Examples:\n  ambrig compare practice/case.toml --html compare.html\n"
      "  ambrig compare practice/case.toml --no-blocks");
  command->callback([options, &work] { work = [options] { return RunCompare(*options); }; });
}

}  // namespace ambrig
