// Every number that an option of any command takes has its range in the help text, and what lies
// outside is refused with one line that names the option. The commands and options are those of the
// help texts.
#include <gmock/gmock.h>

#include <regex>

#include "tests/cli/cli_run.h"

namespace ambrig {
namespace {

using ::testing::AnyOf;
using ::testing::HasSubstr;

struct NumberOption {
  std::string command, option, line;
};

std::vector<NumberOption> NumberOptions() {
  std::vector<NumberOption> out;
  std::istringstream help(Shell(std::string(AMBRIG_BINARY) + " --help").text);
  const std::regex number("^ +(?:-[a-z],)?(--[a-z-]+) (?:INT|UINT|FLOAT|NUMBER).*");
  bool inside = false;
  for (std::string line; std::getline(help, line);) {
    if (line.find("ubcommands:") != std::string::npos) inside = true;
    if (!inside || !line.starts_with("  ") || line.starts_with("  ambrig ") || line[2] == ' ')
      continue;
    const std::string command = line.substr(2, line.find_first_of(" ,", 2) - 2);
    std::istringstream text(Shell(std::string(AMBRIG_BINARY) + " " + command + " --help").text);
    std::smatch match;
    for (std::string row; std::getline(text, row);)
      if (std::regex_match(row, match, number)) out.push_back({command, match[1], row});
  }
  return out;
}

TEST(OptionRanges, EveryNumberSaysItsRange) {
  const std::vector<NumberOption> all = NumberOptions();
  EXPECT_GE(all.size(), 30U);
  for (const NumberOption& o : all) {
    if (o.option == "--row") continue;  // its range is the campaign's
    EXPECT_THAT(o.line, AnyOf(HasSubstr(" in ["), HasSubstr(" to "))) << o.command;
  }
}

TEST(OptionRanges, WhatLiesOutsideIsRefused) {
  for (const NumberOption& o : NumberOptions())
    for (const char* value : {"1e300", "-1e300", "nan", "ten"}) {
      const Outcome said =
          Shell(std::string(AMBRIG_BINARY) + " " + o.command + " " + o.option + "=" + value);
      EXPECT_EQ(said.exit, 2) << o.command << " " << o.option << "=" << value;
      EXPECT_EQ(said.lines(), 1) << said.text;
      EXPECT_THAT(said.text, HasSubstr(o.option)) << o.command;
    }
}

}  // namespace
}  // namespace ambrig
