/// ambrig commission: the fault detection gets to know a healthy rig.
#include <fmt/format.h>

#include <filesystem>

#include "app/commands/commands.h"
#include "app/commands/outputs.h"
#include "app/commands/progress.h"
#include "app/pages/commission_report.h"
#include "core/base/atomic_file.h"
#include "core/base/read_file.h"
#include "fdd/learning/commissioning_file.h"
#include "rig/parameters/bearing_kind.h"
#include "rig/rig_file.h"

namespace ambrig {

namespace {

struct CommissionCommand {
  CommonOptions common;
  std::string rig, out;
  CommissioningPlan plan;
};

constexpr const char* kFirstLine = "# Written by ambrig commission";  // of files without a mark

int RunCommission(CommissionCommand c) {
  const RigParameters rig = ReadRig(c.rig);
  if (c.out.empty()) c.out = CommissioningFileOf(c.rig);
  if (const std::string wrong = OutputFile()(c.out); !wrong.empty()) throw InputError(wrong);
  if (!std::filesystem::is_regular_file(c.out) || !ReadFile(c.out).starts_with(kFirstLine))
    RefuseOverwriting({c.out}, c.common.force);
  if (rig.bearings.front().kind->alone) c.plan.speed = 0;
  c.common.CheckOutputs({c.rig, c.out});
  RefuseOneFileTwice({c.out, c.common.json, c.common.html});
  CommissioningResult result;
  {
    Progress progress("commission");
    CommissioningOptions options;
    options.plan = c.plan;
    options.stop = &interrupted;
    options.progress = [&](double done) { progress.Update(done); };
    result = Commission(rig, options);
  }
  WriteMarkedText(c.out, "commission", CommissioningText(result.model));
  fmt::print("{}", CommissionText(rig, result));
  fmt::print("written: {}; {}\n", c.out,
             c.out == CommissioningFileOf(c.rig)
                 ? "runs of this rig find it by itself"
                 : fmt::format("in the rig file:\n[detection]\ncommissioning = \"{}\"",
                               std::filesystem::path(c.out).filename().string()));
  c.common.WriteJson(CommissionJson(rig, result));
  if (!c.common.html.empty()) WriteCommissionReport(rig, result, c.common.html);
  bool usable = true;
  for (const CommissionedBearing& b : result.model.bearings) usable = usable && b.usable();
  return usable ? 0 : 1;
}

}  // namespace

void AddCommission(CLI::App& app, Work& work) {
  auto c = std::make_shared<CommissionCommand>();
  CLI::App* command = app.add_subcommand(
      "commission",
      "identify the healthy rig for the fault detection; writes RIG.commissioning.toml");
  command->add_option("rig", c->rig, "rig file (TOML); the run is made with its effects")
      ->required();
  command->add_option("-o,--out", c->out, "file to write (default: RIG.commissioning.toml)");
  command->add_option("--duration", c->plan.duration, "duration of the run [s]")
      ->check(NumberIn(0.1, 10, "s"))
      ->capture_default_str();
  command
      ->add_option("--speed", c->plan.speed,
                   "speed at the end of the run [rad/s], or with its unit: 3000rpm, 50Hz")
      ->transform(SpeedUnit("rad/s"))
      ->check(NumberIn(0, 1e5, "rad/s"))
      ->capture_default_str();
  command->add_option("--current", c->plan.current, "amplitude of a coil's three tones, each [A]")
      ->check(NumberIn(0, 100, "A"))
      ->capture_default_str();
  command
      ->add_option("--potential", c->plan.potential,
                   "amplitude of the rotor potential's chirp over the bias current")
      ->check(NumberIn(0, 0.5, ""))
      ->capture_default_str();
  command->add_option("--circle", c->plan.circle, "radius of the small whirl over the clearance")
      ->check(NumberIn(0, 0.9, ""))
      ->capture_default_str();
  command->add_option("--chirp", c->plan.chirp, "force of the chirp over the controller's f_max")
      ->check(NumberIn(0, 1, ""))
      ->capture_default_str();
  command->add_option("--pulse", c->plan.pulse, "largest force over the controller's f_max")
      ->check(NumberIn(0, 1, ""))
      ->capture_default_str();
  c->common.AddTo(*command);
  command->footer(fmt::format(
      "Examples:\n"
      "  ambrig commission examples/reference/rig.toml -o learnt.toml\n"
      "  ambrig commission examples/reference/rig.toml -o learnt.toml --html seen.html\n"
      "Exit code 1 when a bearing cannot be expressed by the model (grade above {}).",
      kWorstGrade));
  command->callback([c, &work] { work = [c] { return RunCommission(*c); }; });
}

}  // namespace ambrig
