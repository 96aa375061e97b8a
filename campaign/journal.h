#pragma once
/// The journal of a campaign: one line a finished run, appended and handed to the system at once.
/// kill -9 loses no line; a line that was cut off (full disk, power) is found by its check sum and
/// its run is done again. One process at a time writes a journal.
#include <map>
#include <mutex>
#include <string>

#include "campaign/campaign_file.h"
#include "campaign/row.h"
#include "core/base/append_file.h"

namespace ambrig {

/// What the first line of a journal says of its campaign.
struct JournalHeader {
  std::string name, file, fingerprint;  // file as an absolute path
  std::size_t runs = 0;
};
JournalHeader HeaderOf(const Campaign& c);

using Rows = std::map<std::size_t, Row>;

struct JournalContent {
  JournalHeader header;
  Rows rows;
  std::size_t damaged = 0;  // lines that no run could be read from
};

/// @throws InputError when `folder` has no journal or one of something else.
JournalContent ReadJournal(const std::string& folder);
bool HasJournal(const std::string& folder);

class Journal {
 public:
  /// Makes the folder, begins a journal or goes on with the one that is there (its rows are read).
  /// @throws InputError when it is of another campaign or rig, in use, or cannot be written.
  Journal(const std::string& folder, const JournalHeader& header);
  const Rows& rows() const { return rows_; }
  std::size_t damaged() const { return damaged_; }
  /// Thread-safe; on return the line is in the system's hands. @throws InputError (full disk ...)
  void Append(const Row& row);
  Rows TakeRows() { return std::move(rows_); }

 private:
  AppendFile file_;
  std::mutex mutex_;
  Rows rows_;
  std::size_t damaged_ = 0;
};

/// FOLDER/table.csv: header and the rows by run. @throws InputError
void WriteTable(const std::string& folder, const Rows& rows);

}  // namespace ambrig
