/// ambrig channels: what the file of an instrument holds, as every command that reads records sees
/// it.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "app/commands/commands.h"
#include "app/json/json_number.h"
#include "core/base/errors.h"
#include "core/base/read_file.h"
#include "core/record/read_record.h"
#include "core/record/text_table.h"
#include "core/record/time_base.h"

namespace ambrig {

namespace {

struct ChannelsCommand {
  CommonOptions common;
  std::vector<std::string> files;
};

struct Extent {
  double least = std::nan(""), most = std::nan("");
  std::size_t missing = 0;
};

Extent ExtentOf(const std::vector<double>& samples) {
  Extent e;
  for (const double v : samples) {
    if (!std::isfinite(v)) ++e.missing;
    if (!std::isfinite(v)) continue;
    e.least = std::isnan(e.least) ? v : std::min(e.least, v);
    e.most = std::isnan(e.most) ? v : std::max(e.most, v);
  }
  return e;
}

std::string FigureText(double v) { return std::isfinite(v) ? fmt::format("{:.6g}", v) : "-"; }

nlohmann::ordered_json RecordJson(const Record& r) {
  nlohmann::ordered_json channels = nlohmann::ordered_json::array();
  if (!r.channels.empty())
    fmt::print("{}\n", r.rate > 0 ? fmt::format("  {} rows at {:.10g} Hz from {:.6g} s on",
                                                r.rows(), r.rate, r.start)
                                  : fmt::format("  {} rows", r.rows()));
  for (const Channel& c : r.channels) {
    const Extent e = ExtentOf(c.samples);
    fmt::print("    {:<24} {:<8} {:>12} to {:>12}{}\n", c.name,
               c.unit.empty() ? "" : '[' + c.unit + ']', FigureText(e.least), FigureText(e.most),
               e.missing == 0 ? "" : fmt::format(", {} missing", e.missing));
    channels.push_back({{"name", c.name},
                        {"unit", c.unit},
                        {"min", FiniteOrNull(e.least)},
                        {"max", FiniteOrNull(e.most)},
                        {"missing", e.missing}});
  }
  return {{"rate", r.rate}, {"start", r.start}, {"rows", r.rows()}, {"channels", channels}};
}

nlohmann::ordered_json ResponsesJson(const FrequencyResponses& f) {
  nlohmann::ordered_json responses = nlohmann::ordered_json::array();
  const bool axis = !f.frequency.empty();
  if (!f.responses.empty())
    fmt::print(
        "  frequency responses, {} points{}\n", f.points(),
        axis ? fmt::format(" from {:.6g} to {:.6g} Hz", f.frequency.front(), f.frequency.back())
             : "");
  for (const MeasuredResponse& r : f.responses) {
    std::vector<double> size;
    for (const auto& v : r.values) size.push_back(std::abs(v));
    const Extent e = ExtentOf(size);
    fmt::print("    {:<24} {:<8} {:>12} to {:>12} (magnitude)\n", r.name,
               r.unit.empty() ? "" : '[' + r.unit + ']', FigureText(e.least), FigureText(e.most));
    responses.push_back({{"name", r.name},
                         {"unit", r.unit},
                         {"least_magnitude", FiniteOrNull(e.least)},
                         {"most_magnitude", FiniteOrNull(e.most)}});
  }
  for (const MeasuredCoherence& c : f.coherence) {
    const Extent e = ExtentOf(c.values);
    fmt::print("    {:<24} {:<8} {:>12} to {:>12} (coherence)\n", c.name, "", FigureText(e.least),
               FigureText(e.most));
  }
  nlohmann::ordered_json out = {{"points", f.points()}};
  if (axis) out["from"] = f.frequency.front();
  if (axis) out["to"] = f.frequency.back();
  out["responses"] = responses;
  return out;
}

/// The columns of a text file that has no times; nothing when it is no such file. One whose times
/// cannot be used is none.
std::optional<Record> StaticColumns(const std::string& file) {
  try {
    Record out;
    out.channels = ReadTextTable(file, ReadFile(file)).columns;
    if (out.channels.size() < 2 || out.rows() < 2) return {};
    if (std::ranges::any_of(out.channels, [](const Channel& c) { return IsTimeName(c.name); }))
      return {};
    return out;
  } catch (const std::runtime_error&) {
    return {};
  }
}

int RunChannels(const ChannelsCommand& o) {
  o.common.CheckOutputs(o.files);
  nlohmann::ordered_json files = nlohmann::ordered_json::array();
  for (const std::string& file : o.files) {
    std::string format;
    Measurement m;
    try {
      m = ReadMeasurement(file, &format);
    } catch (const InputError&) {
      const auto table = StaticColumns(file);
      if (!table) throw;
      fmt::print("{}: a table without times\n", file);
      files.push_back({{"file", file},
                       {"format", "table"},
                       {"record", RecordJson(*table)},
                       {"frequency_responses", ResponsesJson({})},
                       {"notes", nlohmann::ordered_json::array()}});
      fmt::print("  for a [[record]] with kind = \"static\" (docs/guide/bench_records.md)\n");
      continue;
    }
    fmt::print("{}: {}\n", file, format);
    nlohmann::ordered_json one = {{"file", file}, {"format", format}};
    one["record"] = RecordJson(m.record);
    one["frequency_responses"] = ResponsesJson(m.frequency);
    for (const std::string& note : m.record.notes)
      fmt::print("  {}\n", note.starts_with(file + ": ") ? note.substr(file.size() + 2) : note);
    one["notes"] = m.record.notes;
    files.push_back(std::move(one));
  }
  o.common.WriteJson({{"files", files}});
  return 0;
}

}  // namespace

void AddChannels(CLI::App& app, Work& work) {
  auto o = std::make_shared<ChannelsCommand>();
  CLI::App* command = app.add_subcommand("channels", "list what a measured file holds");
  command->add_option("FILE", o->files, "files of instruments (docs/guide/records.md)")->required();
  o->common.AddTo(*command);
  command->footer(
      "Examples:\n"
      "  ambrig channels examples/mls2em/data/*.csv\n"
      "  ambrig channels examples/mls2em/data/*.csv --json channels.json\n"
      "Format, rate, channels with unit and range, what is left out and why; nothing is "
      "converted.");
  command->callback([o, &work] { work = [o] { return RunChannels(*o); }; });
}

}  // namespace ambrig
