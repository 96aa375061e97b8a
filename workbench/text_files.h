#pragma once
/// Writing a user's text files from the page: only the version that was seen is replaced, and every
/// old version is kept in .ambrig/trash for undo.
#include <mutex>
#include <nlohmann/json.hpp>
#include <string>

#include "workbench/served_folder.h"

namespace ambrig::workbench {

/// Another version of the file is there than the one that was changed.
struct Conflict {
  std::string hash;  // of what is there
};

class TextFiles {
 public:
  explicit TextFiles(const ServedFolder& folder);

  static constexpr std::size_t kLargest = 1 << 20;  // [bytes]
  /// Replaces the version of this hash; "": the file must be new. @return the step's number for
  /// Undo.
  /// @throws Conflict, InputError
  int Replace(const std::string& name, const std::string& text, const std::string& hash);
  /// Takes away the version of this hash, to .ambrig/trash. @return the step's number for Undo.
  /// @throws Conflict, InputError
  int Remove(const std::string& name, const std::string& hash);
  /// A file that was just added whole: a step, too. @throws InputError
  int NoteAdded(const std::string& name);
  /// Puts back what a step replaced or took away, takes away what it added, unless the file changed
  /// since. @throws Conflict, InputError
  nlohmann::ordered_json Undo(int step);
  /// Writes the line that mends a data fault under `data = ...` of the record of a case.
  /// @return {"step", "text", "line"} @throws InputError when the case would no longer be read
  nlohmann::ordered_json Mend(const std::string& case_file, const std::string& data,
                              const std::string& mend);

 private:
  int ReplaceLocked(const std::string& name, const std::string& text, const std::string& hash);
  static void CheckWritable(const std::string& name);
  std::string TrashOf(int step) const;

  const ServedFolder& folder_;
  std::mutex mutex_;
  int last_ = 0;
};

/// `text` of a case with `mend` in the [[record]] whose `data` is the file `data` (as named there,
/// or its last part), behind that line; `line`: where it stands then. @throws InputError
std::string MendedCase(const std::string& text, const std::string& file, const std::string& data,
                       const std::string& mend, int* line);

}  // namespace ambrig::workbench
