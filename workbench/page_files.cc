#include "workbench/page_files.h"

#include <algorithm>

namespace ambrig::workbench {

const PageFile* FindPageFile(std::string_view name) {
  const auto files = PageFiles();
  const auto found =
      std::find_if(files.begin(), files.end(), [&](const PageFile& f) { return f.name == name; });
  return found == files.end() ? nullptr : &*found;
}

}  // namespace ambrig::workbench
