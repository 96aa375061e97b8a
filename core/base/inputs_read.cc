#include "core/base/inputs_read.h"

#include <algorithm>
#include <mutex>

namespace ambrig {
namespace {

struct NotedInputs {
  std::mutex mutex;
  std::vector<std::string> files;
};

NotedInputs& Noted() {
  static NotedInputs noted;
  return noted;
}

}  // namespace

void NoteInput(const std::string& path) {
  NotedInputs& noted = Noted();
  const std::scoped_lock lock(noted.mutex);
  if (std::find(noted.files.begin(), noted.files.end(), path) == noted.files.end())
    noted.files.push_back(path);
}

std::vector<std::string> InputsRead() {
  NotedInputs& noted = Noted();
  const std::scoped_lock lock(noted.mutex);
  return noted.files;
}

void ForgetInputs() {
  NotedInputs& noted = Noted();
  const std::scoped_lock lock(noted.mutex);
  noted.files.clear();
}

}  // namespace ambrig
