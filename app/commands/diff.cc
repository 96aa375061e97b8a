/// ambrig diff: two records, and the events beside them, compared within tolerances.
#include <fmt/format.h>

#include <filesystem>

#include "app/commands/commands.h"
#include "app/commands/outputs.h"
#include "app/commands/rig_difference.h"
#include "app/pages/difference_report.h"
#include "app/text/screen.h"

namespace ambrig {

namespace {

struct DiffCommand {
  CommonOptions common;
  std::string a, b, tolerances;
  double absolute = 0, relative = 0, time = 0, events = 0;
};

RecordTolerances TolerancesOf(const DiffCommand& o) {
  RecordTolerances t;
  if (!o.tolerances.empty()) t = ReadTolerances(o.tolerances);
  if (o.absolute > 0) t.all.absolute = o.absolute;
  if (o.relative > 0) t.all.relative = o.relative;
  if (o.time > 0) t.all.time = o.time;
  if (o.events > 0) t.events = o.events;
  return t;
}

int RunDiff(const DiffCommand& o) {
  o.common.CheckOutputs({o.a, o.b, o.tolerances});
  if (IsRigFile(o.a) && IsRigFile(o.b)) return DiffRigs(o.a, o.b, o.common);
  const RecordTolerances tolerances = TolerancesOf(o);
  const RunFiles a = ReadRun(o.a), b = ReadRun(o.b);
  const RunDifference d = CompareRuns(a, b, tolerances);
  for (const std::string& line : DifferenceLines(d)) fmt::print("{}\n", Wrapped(line, 4));
  if (!d.events_known) fmt::print("events not compared: NAME.json is not beside both records\n");
  fmt::print("{}\n", d.identical() ? Coloured("identical: no bit differs", "green")
                     : d.agrees()  ? Coloured("equal within the tolerances", "green")
                                   : Coloured("different", "red"));
  if (!d.agrees() && o.common.html.empty())
    fmt::print("all channels, and the curves of the first: --html FILE\n");
  o.common.WriteJson(DifferenceJson(d));
  if (!o.common.html.empty())
    WriteDifferenceReport({{std::filesystem::path(o.b).stem().string(), &a, &b, &d}},
                          o.common.html);
  return d.agrees() ? 0 : 1;
}

}  // namespace

void AddDiff(CLI::App& app, Work& work) {
  auto o = std::make_shared<DiffCommand>();
  CLI::App* command = app.add_subcommand(
      "diff", "compare two records within tolerances, or two rig files: only what differs");
  command->add_option("A", o->a, "record of before (.h5, .csv, .mat), or a rig file (.toml)")
      ->required();
  command->add_option("B", o->b, "record, or rig file, of now")->required();
  command->add_option("--absolute", o->absolute, "largest difference, every channel in its SI unit")
      ->check(NumberIn(0, 1e12, ""));
  command
      ->add_option("--relative", o->relative, "the same as a share of the channel's largest value")
      ->check(NumberIn(0, 10, ""));
  command->add_option("--time", o->time, "how far a value may move in time [s]")
      ->check(NumberIn(0, 1e3, "s"));
  command->add_option("--events", o->events, "how far an event may move in time [s]")
      ->check(NumberIn(0, 1e3, "s"));
  command
      ->add_option("--tolerances", o->tolerances,
                   "TOML file: [all], [channel.\"A.i*\"] with absolute, relative, time; events")
      ->type_name("FILE");
  o->common.AddTo(*command);
  command->footer(
      "Examples:\n"
      "  ambrig run examples/reference/coil_opens.toml --out before\n"
      "  ambrig run examples/reference/coil_opens.toml --out now\n"
      "  ambrig diff before/coil_opens.h5 now/coil_opens.h5\n"
      "  ambrig diff before/coil_opens.h5 now/coil_opens.h5 --html d.html --force\n"
      "Events are read from NAME.json beside each record. Exit code 1 when something differs.");
  command->callback([o, &work] { work = [o] { return RunDiff(*o); }; });
}

}  // namespace ambrig
