/// ambrig serve: the workbench, a page in the browser over one folder.
#include <fmt/format.h>
#include <sys/stat.h>

#include <chrono>
#include <filesystem>
#include <thread>

#include "app/commands/commands.h"
#include "app/commands/outputs.h"
#include "core/base/atomic_file.h"
#include "core/base/errors.h"
#include "core/base/journal.h"
#include "core/base/read_file.h"
#include "workbench/http_server.h"
#include "workbench/workbench.h"

namespace ambrig {

namespace {

struct ServeCommand {
  std::string folder, address_file;
  int port = 0, reader = -1;
};

/// The key is its user's alone.
void WriteAddress(const std::string& file, const std::string& address) {
  const mode_t before = ::umask(077);
  WriteFileAtomically(file, address + "\n");
  ::umask(before);
}

/// The file of an earlier server, or a new one. @throws InputError
void CheckAddressFile(const std::string& file) {
  if (!std::filesystem::is_regular_file(file)) return;
  const std::string text = ReadFile(file, 64);
  if (!text.empty() && !text.starts_with("http://127.0.0.1:"))
    throw InputError(file + " exists and is not an output of ambrig serve, allowed: another name");
}

int RunServe(const ServeCommand& o) {
  if (o.reader >= 0) return workbench::ServeRecords(o.reader);
  if (o.folder.empty()) throw InputError("serve: allowed: the folder to work in");
  CheckAddressFile(o.address_file);
  const std::string program = std::filesystem::read_symlink("/proc/self/exe").string();
  if (!std::filesystem::is_directory(o.folder))
    throw InputError(o.folder + ": is no folder, allowed: the folder to work in");
  // One server a folder: the journal's lock, which ends with the process.
  const Journal lock((std::filesystem::path(o.folder) / ".ambrig" / "server").string(), "server",
                     {[](std::string_view) {}, [](const JournalEntry&) { return true; }});
  const std::string token = workbench::MakeToken();
  workbench::Workbench bench(o.folder, program, token);
  {
    const workbench::HttpServer server(static_cast<std::uint16_t>(o.port), bench);
    const std::string address = fmt::format("http://127.0.0.1:{}/#token={}", server.port(), token);
    if (!o.address_file.empty()) WriteAddress(o.address_file, address);
    fmt::print(
        "workbench of {}: open this address (it holds the key, keep it to yourself)\n"
        "  {}\nstop: Ctrl-C\n",
        o.folder, address);
    std::fflush(stdout);
    while (!interrupted) std::this_thread::sleep_for(std::chrono::milliseconds(100));
    bench.Close();
  }
  fmt::print("stopped\n");
  return 0;
}

}  // namespace

void AddServe(CLI::App& app, Work& work) {
  auto options = std::make_shared<ServeCommand>();
  CLI::App* command = app.add_subcommand(
      "serve", "open a folder as a page in the browser: compare, explain, adopt, run");
  command->add_option("folder", options->folder, "folder to work in");
  command->add_option("--port", options->port, "port on 127.0.0.1 (default: a free one)")
      ->check(CLI::Range(0, 65535));
  command
      ->add_option("--address-file", options->address_file,
                   "also write the address with its key to this file, readable by you only")
      ->type_name("FILE")
      ->check(OutputFile());
  command->add_option("--reader", options->reader, "")->group("");  // of the server itself
  command->footer(
      "Examples:\n  ambrig serve practice\n  ambrig serve . --port 8080\n"
      "The page starts the commands that you could type; results stand in\n"
      "practice/.ambrig. Only this machine can reach it; from another one:\n"
      "ssh -L 8080:127.0.0.1:8080 HOST.");
  command->callback([options, &work] { work = [options] { return RunServe(*options); }; });
}

}  // namespace ambrig
