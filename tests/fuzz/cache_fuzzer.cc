// The cache of current distributions: damaged as it is, and with check sums that fit, behind which
// an entry's numbers stand.
#include <nlohmann/json.hpp>

#include "core/base/fingerprint.h"
#include "faulttolerance/redistribution/redistribution_table.h"
#include "tests/faulttolerance/redistribution_reference.h"
#include "tests/fuzz/fuzz_input.h"

using namespace ambrig;  // NOLINT: a program of one function

namespace {

std::string WithCheckSums(const std::string& text) {
  nlohmann::json root = nlohmann::json::parse(text, nullptr, false);
  if (!root.is_object() || !root.contains("entries")) return text;
  for (nlohmann::json& item : root["entries"]) {
    if (!item.is_object()) continue;
    item.erase("checksum");
    item["checksum"] = HashText(item.dump());
  }
  return root.dump();
}

void Read(const std::string& text) {
  static const RedistributionProblem problem = MakeRedistributionProblem(kPi / 8, "NSNSNSNS");
  static const std::string folder =
      std::filesystem::path(fuzz::FileOf({}, 0, ".json")).parent_path();
  static const std::string file = RedistributionTable(problem, folder).cache_file();
  std::ofstream(file, std::ios::binary) << text;
  const RedistributionTable table(problem, folder);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return fuzz::TakesOrRefuses([&] {
    const std::string text(fuzz::TextOf(data, size));
    Read(text);
    if (std::count(text.begin(), text.end(), '[') < 1000)  // the target's own JSON is recursive
      Read(WithCheckSums(text));
  });
}
