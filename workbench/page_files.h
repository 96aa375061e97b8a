#pragma once
/// The page and its scripts, read from the binary itself (cmake/workbench_page.cmake).
#include <span>
#include <string_view>

namespace ambrig::workbench {

struct PageFile {
  std::string_view name;  // "app.js"
  std::string_view type;  // "text/javascript"
  std::string_view bytes;
};

std::span<const PageFile> PageFiles();
/// nullptr: there is none of this name.
const PageFile* FindPageFile(std::string_view name);

}  // namespace ambrig::workbench
