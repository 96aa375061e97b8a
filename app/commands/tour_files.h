#pragma once
/// The files of `ambrig tour`: inside the program, so that it needs no source folder.
#include <string_view>
#include <vector>

namespace ambrig {

struct TourFile {
  const char* name;
  std::string_view text;
};
const std::vector<TourFile>& TourFiles();

}  // namespace ambrig
