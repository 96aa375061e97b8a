#pragma once
/// A folder with a small campaign in it, and the program run there.
#include <sys/wait.h>

#include <cstdio>
#include <string>

#include "tests/core/temporary_folder.h"

namespace ambrig::testing {

struct Outcome {
  int exit = 0;
  std::string text;  // both streams
};

inline Outcome Shell(const std::string& command) {
  Outcome out;
  FILE* pipe = popen(("( " + command + " ) 2>&1").c_str(), "r");
  char buffer[512];
  while (std::fgets(buffer, sizeof buffer, pipe)) out.text += buffer;
  const int status = pclose(pipe);
  out.exit = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return out;
}

/// 8 sets x 2 kinds x 2 speeds = 32 runs of 10 ms.
inline constexpr const char* kSmallCampaign = R"(name = "small"
rig = "rig.toml"
duration = 0.01
[faults]
bearings = ["A"]
sets = "single"
time = 0.002
[[faults.kind]]
kind = "open"
[[faults.kind]]
kind = "partial-short"
parameters = { fraction = 0.5 }
[operation]
speeds = [0.0, 157.0]
[spread]
draws = 1
)";

class CampaignFolder {
 public:
  CampaignFolder() {
    Write("rig.toml",
          ReadBytes(std::string(AMBRIG_SOURCE_DIR) + "/scenarios/library/rigs/reference.toml"));
    Write("c.toml", kSmallCampaign);
  }
  void Write(const std::string& name, const std::string& text) const {
    WriteBytes(folder_.File(name), text);
  }
  std::string Read(const std::string& name) const { return ReadBytes(folder_.File(name)); }
  std::string File(const std::string& name) const { return folder_.File(name); }
  Outcome Ambrig(const std::string& arguments) const {
    return In(AMBRIG_BINARY + (" " + arguments));
  }
  Outcome In(const std::string& command) const {
    return Shell("cd " + folder_.File("") + " || exit 99; " + command);
  }

 private:
  TemporaryFolder folder_;
};

}  // namespace ambrig::testing
