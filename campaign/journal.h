#pragma once
/// The journal of a campaign (core/base/journal.h): one line for every finished run. A run whose
/// line is damaged is done again.
#include <map>
#include <mutex>
#include <string>

#include "campaign/campaign_file.h"
#include "campaign/row.h"
#include "core/base/journal.h"

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

class CampaignJournal {
 public:
  /// Makes the folder, begins a journal or goes on with the one that is there: its rows are read,
  /// and checked by `check`.
  /// @throws InputError when it is of another campaign or rig, in use, or cannot be written.
  CampaignJournal(const std::string& folder, const JournalHeader& header,
                  const RowCheck& check = CheckRow);
  const Rows& rows() const { return content_.rows; }
  std::size_t damaged() const { return journal_.damaged(); }
  /// Thread-safe; on return the line is in the system's hands. @throws InputError (full disk ...)
  void Append(Row row);
  Rows TakeRows() { return std::move(content_.rows); }

 private:
  JournalContent content_;
  Journal journal_;
  std::mutex mutex_;
};

/// FOLDER/table.csv: header and the rows by run. @throws InputError
void WriteTable(const std::string& folder, const Rows& rows);

}  // namespace ambrig
