#include "core/record/column_names.h"

#include <algorithm>

#include "core/base/errors.h"
#include "core/record/text_table.h"

namespace ambrig {

namespace {

std::string HdfName(std::string name) {
  if (name.starts_with('/')) name.erase(0, 1);
  std::replace(name.begin(), name.end(), '/', '.');
  return name;
}

/// The rule of the MAT reader: an underscore after a bearing's letter is a dot.
std::string MatName(std::string name) {
  if (name.size() > 2 && name[0] >= 'A' && name[0] <= 'Z' && name[1] == '_')
    std::replace(name.begin(), name.end(), '_', '.');
  return name;
}

std::string CsvName(const std::string& head) { return ParseHead(head).name; }

/// The rule of readers of files with paths, /'group'/'A.x' of TDMS, "Model Root"/"A.x" of dSPACE:
/// the last part where that tells all apart.
std::string LastPart(const std::string& path) {
  std::string name = path.substr(path.rfind('/') + 1);
  for (const char quote : {'"', '\''}) std::erase(name, quote);
  return name;
}

}  // namespace

const Channel* FindColumn(const Record& record, const std::string& name) {
  for (const std::string& spelling :
       {name, CsvName(name), HdfName(name), MatName(name), LastPart(name)})
    if (const Channel* c = record.Find(spelling)) return c;
  return nullptr;
}

std::string ColumnsOf(const Record& record, const std::string& wanted, std::size_t most) {
  std::vector<std::string> left;
  for (const Channel& c : record.channels) left.push_back(c.name);
  std::vector<std::string> sorted;
  while (!left.empty() && sorted.size() < most) {
    std::string all;
    for (const std::string& n : left) all += (all.empty() ? "" : ",") + n;
    const std::string near = Nearest(wanted, all);
    auto it = std::find(left.begin(), left.end(), near);
    if (it == left.end()) it = left.begin();
    sorted.push_back(*it);
    left.erase(it);
  }
  std::string text;
  for (const std::string& n : sorted) text += (text.empty() ? "" : ", ") + n;
  if (!left.empty()) text += " and " + std::to_string(left.size()) + " more";
  return text;
}

}  // namespace ambrig
