#include "app/commands/command_line.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <system_error>

#include "app/commands/commands.h"
#include "app/text/screen.h"
#include "core/base/errors.h"
#include "core/base/memory_reuse.h"
#include "core/base/version.h"

namespace ambrig {

namespace {

constexpr const char* kStart =
    R"(ambrig: magnetic-bearing rigs - simulate, break, compare, explain

  ambrig tour            three lessons of two minutes, files included
  ambrig run SCENARIO    what happens in a run; then open out/NAME.html
  ambrig --help          all commands
)";

constexpr const char* kExamples = R"(Examples:
  ambrig tour                       files for three lessons of two minutes
  ambrig run tour/coil_opens.toml   coil A3 breaks: timeline, record, report
  ambrig run tour/my_fault.toml     a fault of your own: edit the file, repeat
  ambrig analyze tour/rig.toml      modes, margins, sensitivity, unbalance

Every command has examples: ambrig COMMAND --help. The examples of campaign,
check, design, explain and others use the folders scenarios and examples of
the project.

Exit codes: 0 done, 1 an expectation is not met, 2 wrong input, 3 program error, 130 interrupted.)";

/// Help within 80 columns.
class NarrowHelp : public CLI::Formatter {
 public:
  std::string make_help(const CLI::App* app, std::string name,
                        CLI::AppFormatMode mode) const override {
    const std::string text = CLI::Formatter::make_help(app, std::move(name), mode);
    return mode == CLI::AppFormatMode::Sub ? text : WrappedHelp(text);
  }
};

/// Words that people type for a command whose name is spelt otherwise.
constexpr std::pair<std::string_view, const char*> kWordsForCommands[] = {
    {"workbench", "serve"},  {"gui", "serve"},        {"web", "serve"},
    {"simulate", "run"},     {"convert", "rotor"},    {"sweep", "campaign"},
    {"optimise", "design"},  {"optimize", "design"},  {"validation", "validate"},
    {"identify", "explain"}, {"diagnose", "explain"}, {"help", "--help"},
    {"version", "--version"}};

/// The command that was probably meant, "" where none is near.
std::string Meant(const std::string& word, const std::string& names) {
  for (const auto& [other, command] : kWordsForCommands)
    if (word == other) return command;
  return Nearest(word, names);
}

/// The first of the arguments that a command has no place for, as they were typed; "" where there
/// is none.
std::string ExtraComplaint(const CLI::App& app, const CLI::App& command) {
  const std::vector<std::string> extra = app.remaining(true);
  const auto option = std::find_if(extra.begin(), extra.end(), [](const std::string& word) {
    return word.size() > 1 && word[0] == '-';
  });
  const std::string call = "ambrig" + (&command == &app ? std::string() : " " + command.get_name());
  if (option == extra.end())
    return extra.empty() ? "" : fmt::format("{}: one argument more than {} takes", extra[0], call);
  std::string names;
  for (const CLI::Option* o : command.get_options())
    for (const std::string& name : o->get_lnames()) names += (names.empty() ? "--" : ", --") + name;
  const std::string near = Nearest(option->substr(0, option->find('=')), names);
  return fmt::format("{} is no option of {}{}", *option, call,
                     near.empty() ? "" : fmt::format(", did you mean {}?", near));
}

/// "--seed = 1e3, allowed: an integer" of CLI11's "Could not convert: --seed = 1e3"; others as they
/// are.
std::string WithAllowed(const CLI::App& command, std::string what) {
  constexpr std::string_view kBegin = "Could not convert: ";
  if (!what.starts_with(kBegin)) return what;
  what.erase(0, kBegin.size());
  const CLI::Option* option = command.get_option_no_throw(what.substr(0, what.find(' ')));
  const bool whole = option != nullptr && option->get_type_name().find("INT") != std::string::npos;
  return what + (whole ? ", allowed: an integer, e.g. 1000" : ", allowed: a number");
}

/// What is wrong with a command line: a command that does not exist is named before all else, then
/// what stands there beyond a command's arguments, then what is missing.
std::string OptionComplaint(const CLI::App& app, const std::vector<std::string>& arguments,
                            const CLI::ParseError& e) {
  const auto told = [&](const CLI::App& command, const std::string& help) {
    const bool counted = dynamic_cast<const CLI::ExtrasError*>(&e) != nullptr ||
                         dynamic_cast<const CLI::RequiredError*>(&e) != nullptr;
    const std::string extra = counted ? ExtraComplaint(app, command) : "";
    return fmt::format("{} (see ambrig {})", extra.empty() ? WithAllowed(command, e.what()) : extra,
                       help);
  };
  if (arguments.empty() || arguments[0].starts_with('-')) return told(app, "--help");
  std::string names;
  for (const CLI::App* sub : app.get_subcommands([](const CLI::App*) { return true; })) {
    if (sub->check_name(arguments[0])) return told(*sub, arguments[0] + " --help");
    names += (names.empty() ? "" : ", ") + sub->get_name();
  }
  const std::string near = Meant(arguments[0], names);
  return fmt::format("{} is no command{}; allowed: {}", arguments[0],
                     near.empty() ? "" : fmt::format(", did you mean {}?", near), names);
}

/// What stands in the buffer of standard output is a result too. A closed one (`>&-`) was not
/// wanted.
int Printed(int code) {
  errno = 0;
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return code;
  const int why = errno != 0 ? errno : EIO;
  if (why == EBADF) return code;
  throw std::system_error(why, std::generic_category());
}

}  // namespace

int RunCommandLine(int argc, char** argv) {
  KeepFreedMemory();
  CLI::App app{
      "ambrig: magnetic-bearing rigs with redundant actuators - simulate, break, compare, explain",
      "ambrig"};
  app.set_version_flag("--version", std::string(ProgramVersion()));
  app.formatter(std::make_shared<NarrowHelp>());
  Work work;
  AddCommands(app, work);
  app.footer(kExamples);  // after the commands, which would inherit it
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    if (e.get_exit_code() == 0) return Printed(app.exit(e));
    const std::vector<std::string> arguments(argv + 1, argv + argc);
    fmt::print(stderr, "ambrig: {}\n", PrintableLine(OptionComplaint(app, arguments, e)));
    return 2;
  }
  if (work) return Printed(work());
  fmt::print("{}", kStart);
  return Printed(0);
}

}  // namespace ambrig
