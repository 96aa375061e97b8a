#pragma once
/// The process that opens data files for the page. The HDF5 library is not thread-safe and may die
/// of a broken file; so it lives in a process of its own with limited memory, which is started
/// again.
///
/// One request a line (JSON) on the socket, one answer: eight bytes of length (little-endian), then
/// the bytes: "J" and JSON, or "B", four bytes of head length, a JSON head and float32 values.
#include <mutex>
#include <string>

#include <nlohmann/json.hpp>

namespace ambrig::workbench {

/// Serves requests on this descriptor until it is closed: the reader's side. @return exit code
int ServeRecords(int socket);

/// The server's side. Thread-safe: one request at a time.
class RecordReader {
 public:
  explicit RecordReader(std::string program) : program_(std::move(program)) {}
  ~RecordReader();
  RecordReader(const RecordReader&) = delete;
  RecordReader& operator=(const RecordReader&) = delete;

  /// {"file": absolute, "group": "record-1" or ""}: {"rate", "start", "rows", "channels": [{"name",
  /// "unit"}]}, without a group of a file of groups {"groups": [...]}; with "channels", "t0", "t1",
  /// "px" the binary answer. @throws InputError when the file cannot be read or the reader died of
  /// it
  std::string Ask(const nlohmann::ordered_json& request);

 private:
  void StartReader();
  void EndReader();
  bool Exchange(const std::string& line, std::string* answer);

  const std::string program_;
  std::mutex mutex_;
  int socket_ = -1, pid_ = 0;
};

}  // namespace ambrig::workbench
