/// ambrig parameters: every number of a rig file and every fault, from the tables that the readers
/// walk.
#include <fmt/format.h>

#include "app/commands/commands.h"
#include "app/commands/word_keys.h"
#include "app/pages/html.h"
#include "app/text/screen.h"
#include "core/base/atomic_file.h"
#include "effects/catalogue.h"
#include "rig/parameters/rig_parameters.h"
#include "scenarios/faults/fault.h"

namespace ambrig {

namespace {

struct ParameterLine {
  std::string section, key, unit, fallback, allowed, doc;
};

const char* FaultTargetText(FaultTarget target) {
  switch (target) {
    case FaultTarget::kCoil:
      return "coil";
    case FaultTarget::kAxis:
      return "axis";
    case FaultTarget::kRig:
      return "rig";
  }
  return "";
}

/// "the coil detector, as open".
std::string ObserverText(const Fault& fault) {
  const char* who = "";
  switch (fault.observer) {
    case FaultObserver::kNobody:
      return "nobody";
    case FaultObserver::kCoilDetector:
      who = "the coil detector";
      break;
    case FaultObserver::kPositionMonitor:
      who = "the position monitor";
      break;
    case FaultObserver::kBusMonitor:
      who = "the bus monitor";
      break;
  }
  return fmt::format("{}, as {}", who, fault.seen_as);
}

std::vector<ParameterLine> RigLines() {
  std::vector<ParameterLine> lines;
  for (const ParameterRow& r : RigParameterRows())
    lines.push_back({r.section, r.key, r.unit,
                     std::isnan(r.fallback) ? "required" : NumberText(r.fallback),
                     fmt::format("{:g} to {:g}", r.lo, r.hi), r.doc});
  return lines;
}

std::vector<ParameterLine> FaultLines() {
  std::vector<ParameterLine> lines;
  for (const Fault* fault : Faults()) {
    const std::string section = fmt::format("[[fault]] kind = \"{}\"", fault->kind);
    lines.push_back({section, "", "", "", "",
                     fmt::format("Target: {}; {}. Seen by: {}", FaultTargetText(fault->target),
                                 fault->doc, ObserverText(*fault))});
    for (const FaultParameter& p : fault->parameters)
      lines.push_back({section, fmt::format("parameters.{}", p.key), std::string(p.unit), "",
                       p.flag
                           ? "true, false"
                           : fmt::format("{}{:g} to {}{:g}", p.ends_allowed ? "" : "above ", p.lo,
                                         p.ends_allowed || std::isinf(p.hi) ? "" : "below ", p.hi),
                       std::string(p.doc)});
  }
  return lines;
}

/// Names, choices, lists and files.
std::vector<ParameterLine> WordLines() {
  std::vector<ParameterLine> lines;
  for (const WordKey& w : WordKeys()) lines.push_back({w.section, w.key, "", "", w.allowed, w.doc});
  return lines;
}

std::vector<ParameterLine> EffectLines() {
  std::vector<ParameterLine> lines;
  for (const EffectDescription& d : Catalogue())
    for (const EffectParameter& p : d.parameters)
      lines.push_back({fmt::format("[[effect]] name = \"{}\"", d.id), "parameters." + p.name,
                       p.unit, NumberText(p.null_value), fmt::format("{:g} to {:g}", p.lo, p.hi),
                       p.doc});
  return lines;
}

/// A field above the table that leaves the rows with all words that are typed into it.
std::string WithSearchField(std::string html) {
  constexpr const char* kField =
      "<p><input id=\"find\" type=\"search\" size=\"40\" placeholder=\"words, e.g. gap sensor\" "
      "aria-label=\"search\"></p>\n"
      "<script>\naddEventListener(\"DOMContentLoaded\", () => {\n"
      "  const field = document.getElementById(\"find\");\n"
      "  field.addEventListener(\"input\", () => {\n"
      "    const words = field.value.toLowerCase().split(/\\s+/);\n"
      "    for (const row of document.querySelectorAll(\"tbody tr\"))\n"
      "      row.hidden = !words.every(w => row.textContent.toLowerCase().includes(w));\n"
      "  });\n});\n</script>\n";
  const std::size_t table = html.find("<div class=\"table");
  return table == std::string::npos ? html : html.insert(table, kField);
}

/// A heading, a sentence (a line without key) and one table per section.
void PrintParametersMarkdown(const std::vector<ParameterLine>& lines) {
  std::string section;
  bool in_table = false;
  for (const ParameterLine& l : lines) {
    if (l.section != section) fmt::print("\n### `{}`\n", l.section);
    if (l.section != section) in_table = false;
    section = l.section;
    if (l.key.empty()) {
      fmt::print("\n{}.\n", l.doc);
      continue;
    }
    if (!in_table)
      fmt::print("\n| key | unit | default | allowed | meaning |\n|---|---|---|---|---|\n");
    in_table = true;
    fmt::print("| `{}` | {} | {} | {} | {} |\n", l.key, l.unit, l.fallback, l.allowed, l.doc);
  }
}

void PrintPage() {
  fmt::print(
      "# Parameters\n\nMade by `ambrig parameters --markdown`; a test keeps it so. What else rig "
      "and scenario files hold: [guide/files.md](guide/files.md).\n\n## Numbers of a rig "
      "file\n\nSI units. A number may be written `{{ value = 4.2, sd = 0.01 }}`: sd is its "
      "one-sigma tolerance.\n");
  PrintParametersMarkdown(RigLines());
  fmt::print("\n## Names, choices, lists and files\n");
  PrintParametersMarkdown(WordLines());
  fmt::print("\n## Faults of a scenario\n");
  PrintParametersMarkdown(FaultLines());
}

/// Two lines a number, the section in each first one, so that `| grep gap` says it.
void PrintParametersText(const std::vector<ParameterLine>& lines) {
  for (const ParameterLine& l : lines) {
    if (l.key.empty()) {
      fmt::print("{}\n", Wrapped(fmt::format("{}: {}", l.section, l.doc), 4));
      continue;
    }
    fmt::print("{}\n", Wrapped(fmt::format("{} {} [{}] = {}, allowed {}", l.section, l.key, l.unit,
                                           l.fallback.empty() ? "-" : l.fallback, l.allowed),
                               4));
    fmt::print("{}\n", Wrapped("    " + l.doc, 4));
  }
}

nlohmann::ordered_json LineJson(const ParameterLine& l) {
  return {{"section", l.section},  {"key", l.key},         {"unit", l.unit},
          {"default", l.fallback}, {"allowed", l.allowed}, {"doc", l.doc}};
}

}  // namespace

void AddParameters(CLI::App& app, Work& work) {
  struct Options {
    CommonOptions common;
    bool markdown = false;
  };
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand(
      "parameters", "list all parameters of rig files and faults: unit, range, default");
  command->add_flag("--markdown", options->markdown, "print docs/parameters.md");
  options->common.AddTo(*command);
  command->footer(
      "Examples:\n  ambrig parameters | grep gap\n"
      "  ambrig parameters --html parameters.html");
  command->callback([options, &work] {
    work = [options] {
      options->common.CheckOutputs({});
      std::vector<ParameterLine> lines = RigLines();
      const std::vector<ParameterLine> faults = FaultLines();
      lines.insert(lines.end(), faults.begin(), faults.end());
      if (!options->markdown) {
        for (const std::vector<ParameterLine>& more : {WordLines(), EffectLines()})
          lines.insert(lines.end(), more.begin(), more.end());
      }
      nlohmann::ordered_json all = nlohmann::ordered_json::array();
      std::vector<std::vector<Cell>> rows;
      for (const ParameterLine& l : lines) {
        all.push_back(LineJson(l));
        rows.push_back({Cell(l.section), Cell(l.key), Cell(l.unit), Cell(l.fallback),
                        Cell(l.allowed), Cell(l.doc)});
      }
      if (!options->markdown) PrintParametersText(lines);
      if (options->markdown) PrintPage();
      options->common.WriteJson(all);
      if (!options->common.html.empty()) {
        HtmlReport report("Parameters", "ambrig parameters");
        report.Table({"section", "key", "unit", "default", "allowed", "meaning"}, rows);
        WriteFileAtomically(options->common.html, WithSearchField(report.Html()));
      }
      return 0;
    };
  });
}

}  // namespace ambrig
