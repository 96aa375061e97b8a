#pragma once
/// Every mistake in a file ends with one line "file:line: key = value, allowed ...", exit code 2
/// and no file written. One row per mistake; each table of a rig or scenario has rows for a wrong
/// key, type, range and contradiction.
#include "tests/cli/cli_run.h"

namespace ambrig {

/// In the reference rig `from` becomes `to`; with an empty `from`, `to` is appended to the
/// scenario.
struct Mistake {
  const char *name, *from, *to;
  std::vector<const char*> said;  // parts of the line, in this order
};

inline void PrintTo(const Mistake& m, std::ostream* out) { *out << m.name; }

class Messages : public CliFolder, public ::testing::WithParamInterface<Mistake> {
 protected:
  void ExpectOneLine(const Outcome& o) const {
    EXPECT_EQ(o.exit, 2) << o.text;
    EXPECT_EQ(o.lines(), 1) << o.text;
    EXPECT_EQ(Files(), "rig.toml s.toml ") << o.text;
    std::size_t at = 0;
    for (const char* part : GetParam().said) {
      const std::size_t found = o.text.find(part, at);
      EXPECT_NE(found, std::string::npos) << "no \"" << part << "\" in " << o.text;
      if (found == std::string::npos) return;
      at = found;
    }
  }
};

inline std::string NameOf(const ::testing::TestParamInfo<Mistake>& which) {
  return which.param.name;
}

}  // namespace ambrig
