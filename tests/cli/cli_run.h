#pragma once
/// A folder of its own in which the command runs, and what came out of it.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

namespace ambrig {

struct Outcome {
  int exit = 0;
  std::string text;  // both streams
  std::ptrdiff_t lines() const { return std::count(text.begin(), text.end(), '\n'); }
};

/// Exit code as the shell sees it: 128 + signal when one ended the command.
inline Outcome Shell(const std::string& command) {
  Outcome out;
  FILE* pipe = popen((command + " 2>&1").c_str(), "r");
  char buffer[512];
  while (std::fgets(buffer, sizeof buffer, pipe)) out.text += buffer;
  const int status = pclose(pipe);
  out.exit = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return out;
}

inline std::string ReadText(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream out;
  out << in.rdbuf();
  return out.str();
}

/// First occurrence of `from` replaced; a test that misses it fails.
inline std::string Replaced(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

inline std::string ReferenceRigText() {
  return ReadText(AMBRIG_SOURCE_DIR "/scenarios/library/rigs/reference.toml");
}
inline std::string ScenarioText(const std::string& more) {
  return "name = \"t\"\nrig = \"rig.toml\"\nduration = 0.01\nrecord_rate = 12500.0\n" + more;
}

class CliFolder : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string name = ::testing::UnitTest::GetInstance()->current_test_info()->name();
    std::replace(name.begin(), name.end(), '/', '_');
    folder_ = std::filesystem::temp_directory_path() /
              ("ambrig_cli_" + std::to_string(::getpid()) + "_" + name);
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  void Write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
  }
  Outcome Ambrig(const std::string& arguments) const {
    return Shell("cd " + folder_.string() + " && " + AMBRIG_BINARY + " " + arguments);
  }
  Outcome Run(const std::string& rig, const std::string& scenario,
              const std::string& out = "out") const {
    Write("rig.toml", rig);
    Write("s.toml", scenario);
    return Ambrig("run s.toml --quiet --out " + out);
  }
  /// Everything below the folder, sorted, as one text.
  std::string Files() const {
    std::vector<std::string> names;
    for (const auto& e : std::filesystem::recursive_directory_iterator(folder_))
      if (e.is_regular_file())
        names.push_back(std::filesystem::relative(e.path(), folder_).string());
    std::sort(names.begin(), names.end());
    std::string all;
    for (const std::string& n : names) all += n + " ";
    return all;
  }

  std::filesystem::path folder_;
};

}  // namespace ambrig
