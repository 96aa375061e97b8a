// Every file of an instrument, cut at every byte and with lengths that ask for more than there is:
// a record or one line of error, within bounded memory.
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <random>

#include "core/base/errors.h"
#include "core/record/read_record.h"
#include "tests/core/record/formats/instrument_files.h"
#include "tests/core/temporary_folder.h"

namespace ambrig {
namespace {

constexpr std::size_t kAllowed = std::size_t{1} << 27;  // [bytes] beyond what the test has now

[[maybe_unused]] std::size_t AddressSpace() {  // not with sanitizers
  std::ifstream in("/proc/self/statm");
  std::size_t pages = 0;
  in >> pages;
  return pages * 4096;
}

/// Allocations beyond a limit fail while it lives; sanitizers reserve terabytes, so not with them.
class MemoryLimit {
 public:
  MemoryLimit() {
#ifndef AMBRIG_SANITIZED
    getrlimit(RLIMIT_AS, &before_);
    const rlimit small = {AddressSpace() + kAllowed, before_.rlim_max};
    setrlimit(RLIMIT_AS, &small);
#endif
  }
  ~MemoryLimit() {
#ifndef AMBRIG_SANITIZED
    setrlimit(RLIMIT_AS, &before_);
#endif
  }

 private:
  rlimit before_ = {};
};

/// A file in memory: thousands of versions of it cost no disk.
class MemoryFile {
 public:
  MemoryFile() : fd_(memfd_create("damaged", 0)), path_("/proc/self/fd/" + std::to_string(fd_)) {}
  ~MemoryFile() { close(fd_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  const std::string& path() const { return path_; }
  void Write(const std::string& bytes) const {
    ASSERT_EQ(ftruncate(fd_, 0), 0);
    ASSERT_EQ(pwrite(fd_, bytes.data(), bytes.size(), 0), static_cast<ssize_t>(bytes.size()));
  }

 private:
  int fd_;
  std::string path_;
};

class DamagedFiles : public ::testing::TestWithParam<std::string> {
 protected:
  /// Reads a file of these bytes; whatever is not a record must be one line that names the file.
  void Read(const std::string& bytes, const std::string& what) {
    file_.Write(bytes);
    try {
      const Measurement m = ReadMeasurement(file_.path());
      EXPECT_TRUE(!m.record.channels.empty() || !m.frequency.responses.empty()) << what;
    } catch (const InputError& e) {
      const std::string text = e.what();
      EXPECT_TRUE(text.starts_with(file_.path() + ":")) << what << ": " << text;
      EXPECT_EQ(text.find('\n'), std::string::npos) << what << ": " << text;
    } catch (const std::exception& e) {
      ADD_FAILURE() << what << ": " << e.what();
    }
  }

  const MemoryFile file_;
  const std::string whole_ = testing::ReadBytes(testing::InstrumentFile(GetParam()));
};

TEST_P(DamagedFiles, CutAtEveryByte) {
  const MemoryLimit limit;
  const std::size_t step = whole_.size() > 3000 ? 7 : 1;
  for (std::size_t size = 0; size < whole_.size(); size += step)
    Read(whole_.substr(0, size), "cut at " + std::to_string(size));
}

TEST_P(DamagedFiles, LengthsThatAskForMore) {
#ifdef AMBRIG_SANITIZED
  GTEST_SKIP() << "the sanitizer ends the program where an allocation fails";
#endif
  const MemoryLimit limit;
  const bool binary = whole_.find('\0') != std::string::npos;
  const std::size_t step = 1 + whole_.size() / 400;
  for (const std::string& large : {binary ? std::string("\xff\xff\xff\x7f") : std::string("9999"),
                                   binary ? std::string("\0\0\0\x10", 4) : std::string("-1E9")})
    for (std::size_t at = 0; at + large.size() <= whole_.size(); at += step) {
      std::string bytes = whole_;
      Read(bytes.replace(at, large.size(), large), "at " + std::to_string(at));
    }
}

TEST_P(DamagedFiles, BytesAtRandom) {
  const MemoryLimit limit;
  std::mt19937 random(1);
  for (int k = 0; k < 100; ++k) {
    std::string bytes = whole_;
    for (int n = 0; n < 1 + k % 5; ++n)
      bytes[random() % bytes.size()] = static_cast<char>(random() % 256);
    Read(bytes, "seed step " + std::to_string(k));
  }
}

std::vector<std::string> InstrumentFiles() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(testing::InstrumentFolder())) {
    const std::string name = entry.path().filename().string();
    if (!name.ends_with(".py") && !name.ends_with(".md")) names.push_back(name);
  }
  std::sort(names.begin(), names.end());
  return names;
}

INSTANTIATE_TEST_SUITE_P(Instruments, DamagedFiles, ::testing::ValuesIn(InstrumentFiles()),
                         [](const auto& test) {
                           std::string name = test.param;
                           std::replace(name.begin(), name.end(), '.', '_');
                           return name;
                         });

}  // namespace
}  // namespace ambrig
