/// ambrig validate: published rotors and rigs beside what this program computes for them.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "analysis/validation.h"
#include "app/commands/commands.h"
#include "app/commands/outputs.h"
#include "app/text/screen.h"
#include "core/base/counted.h"
#include "core/base/errors.h"

namespace ambrig {

namespace {

struct ValidateCommand {
  CommonOptions common;
  std::vector<std::string> paths;
  bool markdown = false;
};

bool IsValidation(const std::filesystem::path& file) {
  return file.extension() == ".toml" && file.stem().string().ends_with(".validation");
}

std::string Figures(const std::vector<double>& values) {
  std::vector<std::string> text;
  for (double v : values) text.push_back(fmt::format("{:.6g}", v));
  return fmt::format("{}", fmt::join(text, " "));
}

/// To two digits: below the last digit that two compilers may round differently.
std::string PerCent(double difference) {
  return difference < 1e-6 ? "< 0.0001 %" : fmt::format("{:.2g} %", 100 * difference);
}

std::string Verdict(const ValidationRow& r) {
  if (r.low()) return "low trust, no pass claimed";
  return r.agrees() ? "agrees" : "DIFFERS";
}

void PrintValidationMarkdown(const std::vector<ValidationRow>& rows) {
  fmt::print(
      "# Published rotors and rigs beside ours\n\n"
      "Written by `ambrig validate examples/validation --markdown > docs/validation.md`; ctest "
      "(docs_validation) keeps it true.\n"
      "Difference: the largest relative one of a row; of eigenvalues the distance over the "
      "modulus. Trust: `published` in print or by\n"
      "the maker, `computed` by another program from published data, `low` recalled or "
      "unconfirmed: shown, never passed.\n\n");
  fmt::print(
      "| rig | quantity | published | ours | largest difference | allowed | source's trust | "
      "verdict |\n|---|---|---|---|---|---|---|---|\n");
  for (const ValidationRow& r : rows)
    fmt::print("| {} | {} [{}]{} | {} | {} | {} | {:.2g} % | {} | {} |\n", r.name, r.quantity,
               r.unit, r.note.empty() ? "" : " (" + r.note + ")", Figures(r.published),
               Figures(r.ours), PerCent(r.difference), 100 * r.tolerance, r.trust, Verdict(r));
  std::string last;
  fmt::print("\nSources:\n\n");
  for (const ValidationRow& r : rows) {
    if (r.name != last) fmt::print("- {}: {} (`{}`)\n", r.name, r.source, r.file);
    last = r.name;
  }
}

void PrintValidationText(const std::vector<ValidationRow>& rows) {
  for (const ValidationRow& r : rows) {
    const char* colour = r.low() ? "yellow" : r.agrees() ? "green" : "red";
    fmt::print("{}\n",
               Shortened(fmt::format("{}: {} [{}]", r.name, r.quantity, r.unit), kScreenColumns));
    fmt::print("    {:>12} off, allowed {:.2g} %: {}\n", PerCent(r.difference), 100 * r.tolerance,
               Coloured(Verdict(r), colour));
    if (r.agrees()) continue;
    fmt::print("{}\n", Wrapped("    published " + Figures(r.published), 14));
    fmt::print("{}\n", Wrapped("    ours      " + Figures(r.ours), 14));
  }
}

int RunValidate(const ValidateCommand& c) {
  c.common.CheckOutputs({});
  std::vector<ValidationRow> rows;
  for (const std::string& file :
       FindFiles(c.paths, IsValidation, "no NAME.validation.toml found")) {
    if (interrupted) throw Interrupted();
    for (ValidationRow& row : Validate(file)) rows.push_back(std::move(row));
  }
  c.markdown ? PrintValidationMarkdown(rows) : PrintValidationText(rows);
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (const ValidationRow& r : rows)
    json.push_back({{"name", r.name},
                    {"quantity", r.quantity},
                    {"unit", r.unit},
                    {"published", r.published},
                    {"ours", r.ours},
                    {"difference", r.difference},
                    {"tolerance", r.tolerance},
                    {"trust", r.trust},
                    {"agrees", r.agrees()}});
  c.common.WriteJson(json);
  const auto differs = std::count_if(rows.begin(), rows.end(),
                                     [](const auto& r) { return !r.low() && !r.agrees(); });
  if (!c.markdown)
    fmt::print("{}, beyond what is allowed: {}\n", Counted(rows.size(), "row"), differs);
  return differs > 0 ? 1 : 0;
}

}  // namespace

void AddValidate(CLI::App& app, Work& work) {
  auto c = std::make_shared<ValidateCommand>();
  CLI::App* command =
      app.add_subcommand("validate", "compare published rotors and rigs with computed values");
  command->add_option("path", c->paths, "validation files, or folders of NAME.validation.toml")
      ->required();
  command->add_flag("--markdown", c->markdown, "the table of docs/validation.md");
  command->add_option("--json", c->common.json, "write the rows as JSON to FILE")
      ->type_name("FILE")
      ->check(OutputFile());
  command->add_flag("--force", c->common.force, kForceHelp);
  command->footer(
      "Examples:\n  ambrig validate examples/validation\n"
      "  ambrig validate examples/validation/mbc500.validation.toml --json rows.json\n"
      "Exit code 1 when a row differs by more than its file allows.");
  command->callback([c, &work] { work = [c] { return RunValidate(*c); }; });
}

}  // namespace ambrig
