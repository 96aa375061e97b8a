#include "app/commands/rig_difference.h"

#include <fmt/format.h>

#include "app/json/rig_json.h"
#include "app/pages/html.h"
#include "rig/rig_file.h"

namespace ambrig {
namespace {

std::string OrAbsent(const std::string& text) { return text.empty() ? "-" : text; }

std::string SdText(double sds) { return sds == 0 ? "" : fmt::format("{:+.2f} sd", sds); }

}  // namespace

bool IsRigFile(const std::string& file) {
  return std::filesystem::path(file).extension() == ".toml";
}

int DiffRigs(const std::string& a, const std::string& b, const CommonOptions& common) {
  const std::vector<RigDifference> all = RigDifferences(ReadRig(a), ReadRig(b));
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  std::vector<std::vector<Cell>> cells;
  for (const RigDifference& d : all) {
    fmt::print("{}  {} -> {} {} {}\n", d.what, OrAbsent(d.a), OrAbsent(d.b),
               d.unit == "-" ? "" : d.unit, SdText(d.sds));
    rows.push_back({{"what", d.what}, {"unit", d.unit}, {"a", d.a}, {"b", d.b}, {"sds", d.sds}});
    cells.push_back({Cell(d.what), Cell(OrAbsent(d.a)), Cell(OrAbsent(d.b)), Cell(d.unit),
                     Cell(SdText(d.sds))});
  }
  fmt::print("{}\n", all.empty() ? Coloured("the same rig: no value differs", "green")
                                 : Coloured("different", "red"));
  common.WriteJson({{"a", a}, {"b", b}, {"identical", all.empty()}, {"differences", rows}});
  if (!common.html.empty()) {
    HtmlReport report("Two rigs", "ambrig diff");
    report.Table({"what", a, b, "unit", "difference"}, cells);
    report.Write(common.html);
  }
  return all.empty() ? 0 : 1;
}

}  // namespace ambrig
