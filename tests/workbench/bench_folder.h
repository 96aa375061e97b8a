#pragma once
/// A folder to serve, and one beside it that must stay unseen.
#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <thread>

namespace ambrig::workbench {

class BenchFolder : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string name = ::testing::UnitTest::GetInstance()->current_test_info()->name();
    base_ = std::filesystem::temp_directory_path() /
            ("ambrig_bench_" + std::to_string(::getpid()) + "_" + name);
    std::filesystem::create_directories(base_ / "served" / "sub");
    std::filesystem::create_directories(base_ / "other");
    Write("other/secret.toml", "secret = 1\n");
    Write("served/a.toml", "x = 1\n");
    Write("served/sub/b.csv", "t,x\n0,1\n1,2\n");
  }
  /// The command of a server that was killed may write for a moment more.
  void TearDown() override {
    std::error_code failed;
    for (int tries = 0; tries < 100; ++tries) {
      std::filesystem::remove_all(base_, failed);
      if (!failed) return;
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    ADD_FAILURE() << base_ << ": " << failed.message();
  }

  void Write(const std::string& name, const std::string& text) const {
    std::ofstream(base_ / name, std::ios::binary) << text;
  }
  std::string Text(const std::string& name) const {
    std::ifstream in(base_ / name, std::ios::binary);
    std::ostringstream out;
    out << in.rdbuf();
    return out.str();
  }
  std::string served() const { return (base_ / "served").string(); }

  std::filesystem::path base_;
};

}  // namespace ambrig::workbench
