#include <fmt/format.h>
#include <csignal>
#include <cstdio>

#include "app/commands/commands.h"
#include "core/base/errors.h"
#include "core/base/memory_reuse.h"

namespace ambrig {
std::atomic<bool> interrupted{false};
}

namespace {

constexpr const char* kExamples = R"(Examples:
  ambrig run scenarios/library/coil_a3_opens_1500rpm.toml     what happens when coil A3 breaks
  ambrig check scenarios/library --jobs 2                     every scenario with expectations
  ambrig campaign scenarios/campaigns/single_coils.toml       many runs on all cores, resumable
  ambrig detectors scenarios/studies/detectors.toml           detectors of coil faults: ROC, delays
  ambrig crosscheck scenarios/library/drop_at_1500rpm.toml    contact by two independent models
  ambrig rotor convert rotor.json shaft.toml                  a shaft from ROSS's file, or to it
  ambrig design study.toml                                    controllers compared: Pareto front, report
  ambrig redistribute rig.toml --bearing A --failed 3         currents after a coil failure
  ambrig analyze rig.toml --speed 3000:9000 -o out            modes, margins, sensitivity, unbalance
  ambrig compare case.toml                                    model beside measurement
  ambrig explain case.toml                                    which physical effect is missing
  ambrig adopt case.toml eddy-currents --target A             add it, compare again

Exit codes: 0 done, 1 an expectation is not met, 2 wrong input, 3 program error, 130 interrupted.)";

int Main(int argc, char** argv) {
  ambrig::KeepFreedMemory();
  CLI::App app{
      "ambrig: magnetic-bearing rigs with redundant actuators - simulate, break, compare, explain"};
  app.footer(kExamples);
  app.require_subcommand(1);
  app.set_version_flag("--version", "ambrig 0.1.0");
  ambrig::Work work;
  ambrig::AddCommands(app, work);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    if (e.get_exit_code() == 0) return app.exit(e);
    fmt::print(stderr, "ambrig: {} (see ambrig --help)\n", e.what());
    return 2;
  }
  return work ? work() : 2;
}

}  // namespace

int main(int argc, char** argv) {
  std::signal(SIGINT, [](int) { ambrig::interrupted = true; });
  std::signal(SIGTERM, [](int) { ambrig::interrupted = true; });
  std::signal(SIGPIPE, SIG_IGN);
  try {
    return Main(argc, argv);
  } catch (const ambrig::InputError& e) {
    fmt::print(stderr, "ambrig: {}\n", e.what());
    return 2;
  } catch (const ambrig::Interrupted&) {
    fmt::print(stderr, "ambrig: interrupted, nothing half-written is left\n");
    return 130;
  } catch (const std::exception& e) {
    fmt::print(stderr, "ambrig: program error: {}\n", e.what());
    return 3;
  }
}
