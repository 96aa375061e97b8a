/// ambrig crosscheck: scenarios with the compliant rotor and with the rotor on the Open Dynamics
/// Engine; figures of the drop, verdicts, agreement.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/commands/commands.h"
#include "app/commands/outputs.h"
#include "app/commands/progress.h"
#include "app/pages/crosscheck_report.h"
#include "core/base/counted.h"
#include "rig/rig_file.h"
#include "scenarios/scenario.h"

namespace ambrig {

namespace {

struct CrosscheckCommand {
  CommonOptions common;
  std::vector<std::string> paths;
  double step_us = 1;
  int seeds = 1;
};

std::string Rest(const CrosscheckRun& run) {
  std::string text;
  for (std::size_t b = 0; b < run.figures.rest.size(); ++b)
    text += fmt::format("{}{} ({:.0f}, {:.0f})", b > 0 ? "  " : "", run.paths.bearings[b].bearing,
                        std::round(run.figures.rest[b][0] * 1e6) + 0.0,  // not -0
                        std::round(run.figures.rest[b][1] * 1e6) + 0.0);
  return text;
}

void PrintCrosscheckRow(const char* name, const CrosscheckRun& run, double parted) {
  const DropFigures& f = run.figures;
  const std::string touch =
      f.first.empty() ? "-" : fmt::format("{} {:.3f}", f.first, f.touchdown_time * 1e3);
  const std::string severity = f.severity > 0 ? fmt::format("{:.4f}", f.severity) : "";
  fmt::print("  {:<11} {:<13} {:>10} {:>8.1f} {:>8.1f}  {:<8} {:>+6.1f} {:>6}\n", name,
             VerdictName(f), touch, f.rebound * 1e6, f.peak_orbit * 1e6, WhirlName(f.whirl),
             f.turns, parted < 0 ? "-" : fmt::format("{:.1f}", parted * 1e3));
  if (!f.first.empty())
    fmt::print("    peak speed of the centre: {:.2f} sqrt(2 g c){}\n    rests at (x, y) [um]: {}\n",
               f.fall_severity, severity.empty() ? "" : ", " + severity + " Omega c", Rest(run));
}

void PrintCrosscheck(const CrosscheckedScenario& s) {
  const ContactCrosscheck& w = s.crosscheck;
  fmt::print("{}  {}\n",
             w.verdicts_agree() ? Coloured("agree ", "green") : Coloured("DIFFER", "red"),
             Coloured(s.name, "bold"));
  if (!w.contact()) {
    fmt::print("  no contact in either\n");
    return;
  }
  fmt::print("  {:<11} {:<13} {:>10} {:>8} {:>8}  {:<8} {:>6} {:>6}\n", "", "", "touch", "rebound",
             "peak", "", "", "apart");
  fmt::print("  {:<11} {:<13} {:>10} {:>8} {:>8}  {:<8} {:>6} {:>6}\n", "rotor", "verdict",
             "at [ms]", "[um]", "[um]", "whirl", "turns", "[ms]");
  PrintCrosscheckRow("compliant", w.model, -1);
  PrintCrosscheckRow("on ODE", w.ode, w.parted_ode);
  PrintCrosscheckRow("other noise", w.other_noise, w.parted_noise);
  if (w.ode_warnings > 0) fmt::print("  note: ODE's solver gave {} warnings\n", w.ode_warnings);
}

/// Where bouncing has made the paths unlike, what is left to compare is how often what happens.
void PrintTally(const std::vector<CrosscheckedScenario>& all, int seeds) {
  const auto tally = [&](const char* name, CrosscheckRun ContactCrosscheck::*run) {
    std::size_t drops = 0, backward = 0, forward = 0;
    double low = kInfinity, high = 0;
    for (std::size_t k = all.size() - static_cast<std::size_t>(seeds); k < all.size(); ++k) {
      const DropFigures& f = (all[k].crosscheck.*run).figures;
      drops += f.drop ? 1 : 0;
      backward += f.whirl == ContactWhirl::kBackward ? 1 : 0;
      forward += f.whirl == ContactWhirl::kForward ? 1 : 0;
      low = std::min(low, f.peak_orbit);
      high = std::max(high, f.peak_orbit);
    }
    fmt::print(
        "  {:<9} of {} seeds: {} dropped, {} backward, {} forward, peak {:.1f} to {:.1f} um\n",
        name, seeds, drops, backward, forward, low * 1e6, high * 1e6);
  };
  tally("compliant", &ContactCrosscheck::model);
  tally("on ODE", &ContactCrosscheck::ode);
}

CrosscheckedScenario CrosscheckOne(const std::string& file, const RigParameters& rig,
                                   const Scenario& scenario, const CrosscheckCommand& command,
                                   bool other_noise) {
  Progress progress(scenario.name);
  CrosscheckOptions options;
  options.ode.step = command.step_us * 1e-6;
  options.ode.far_step = std::max(options.ode.far_step, options.ode.step);
  options.other_noise = other_noise;
  options.stop = &interrupted;
  options.progress = [&](double f) { progress.Update(f); };
  try {
    return {file, scenario.name, scenario.seed, CrosscheckContact(rig, scenario, options)};
  } catch (const InputError& e) {
    throw InputError(fmt::format("{}: {}", file, e.what()));
  }
}

int Crosscheck(const CrosscheckCommand& command) {
  const std::vector<std::string> files = FindScenarios(command.paths);
  command.common.CheckOutputs(files);
  std::vector<CrosscheckedScenario> all;
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  std::size_t differ = 0, touched = 0;
  for (const std::string& file : files) {
    const RigParameters rig = ReadRig(RigOfScenario(file));
    Scenario scenario = ReadScenario(file, rig);
    const bool named = std::count(command.paths.begin(), command.paths.end(), file) > 0;
    if (scenario.start == StartState::kClamped && !named) {
      fmt::print("skip    {}: clamped rotor\n", scenario.name);
      continue;
    }
    for (int k = 0; k < command.seeds; ++k, ++scenario.seed) {
      CrosscheckedScenario s = CrosscheckOne(file, rig, scenario, command, k == 0);
      if (k == 0) PrintCrosscheck(s);
      json.push_back(CrosscheckJson(s));
      differ += s.crosscheck.verdicts_agree() ? 0 : 1;
      touched += s.crosscheck.contact() ? 1 : 0;
      if (command.common.html.empty() || k > 0)  // paths are large
        for (CrosscheckRun* run :
             {&s.crosscheck.model, &s.crosscheck.ode, &s.crosscheck.other_noise})
          run->paths = {};
      all.push_back(std::move(s));
    }
    if (command.seeds > 1) PrintTally(all, command.seeds);
  }
  fmt::print("{}, {} with contact, differing verdicts: {}\n", Counted(all.size(), "run"), touched,
             differ);
  if (!command.common.html.empty()) WriteCrosscheckReport(all, command.common.html);
  command.common.WriteJson(json);
  return differ > 0 ? 1 : 0;
}

}  // namespace

void AddCrosscheck(CLI::App& app, Work& work) {
  auto command = std::make_shared<CrosscheckCommand>();
  CLI::App* sub =
      app.add_subcommand("crosscheck",
                         "simulate contact with the compliant model and with the Open Dynamics "
                         "Engine, and compare touchdown, whirl, orbit and rest");
  sub->alias("witness");  // name until version 0.1, kept for one release
  sub->add_option("scenario", command->paths, "scenario files, or folders of them")->required();
  sub->add_option("--step", command->step_us, "longest step of ODE near contact [us]")
      ->check(NumberIn(0.05, 10, "us"))
      ->capture_default_str();
  sub->add_option("--seeds", command->seeds,
                  "runs of each scenario, with the next seeds of the noise")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  command->common.AddTo(*sub);
  sub->footer(
      "Examples:\n"
      "  ambrig crosscheck scenarios/library/drop_at_12000rpm.toml --html contact.html\n"
      "  ambrig crosscheck scenarios/library/drop_at_0rpm.toml --seeds 3\n"
      "Apart: first instant at which the centres differ by more than 5 % of the\n"
      "clearance.\n"
      "Omega c: speed of a synchronous whirl round the whole clearance c;\n"
      "sqrt(2 g c): of a free fall through it. Exit code 1 when a verdict differs.");
  sub->callback([command, &work] { work = [command] { return Crosscheck(*command); }; });
}

}  // namespace ambrig
