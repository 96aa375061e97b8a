#include "discovery/watch/watched_record.h"

#include <fmt/format.h>

#include <filesystem>

#include "core/base/toml.h"
#include "core/base/toml_edit.h"

namespace ambrig {

namespace {
namespace fs = std::filesystem;
}

std::vector<std::string> RecordStems(const std::string& text, const std::string& file) {
  std::vector<std::string> stems;
  for (const TomlTable& t : TomlTable::FromText(text, file).Tables("record"))
    stems.push_back(t.String("kind", "time") == "time" ? fs::path(t.String("data")).stem().string()
                                                       : "");
  return stems;
}

int RepeatedRecord(const std::vector<std::string>& stems, const std::string& data) {
  const std::string name = fs::path(data).filename().string();
  int best = -1;
  std::size_t most = 0;
  for (std::size_t k = 0; k < stems.size(); ++k) {
    if (stems[k].size() <= most || !name.starts_with(stems[k])) continue;
    // "record-1" is no beginning of "record-10.h5".
    const char next = name.size() > stems[k].size() ? name[stems[k].size()] : '.';
    if (std::isdigit(static_cast<unsigned char>(next)) != 0) continue;
    best = static_cast<int>(k);
    most = stems[k].size();
  }
  return best < 0 && stems.size() == 1 && !stems[0].empty() ? 0 : best;
}

std::string CaseOfOneRecord(const std::string& text, const std::string& file, std::size_t record,
                            const std::string& data) {
  const std::size_t records = TomlTable::FromText(text, file).Tables("record").size();
  std::string out = text;
  for (std::size_t k = records; k-- > 0;)
    if (k != record) out = WithoutTomlTable(out, file, fmt::format("record[{}]", k));
  return EditedToml(out, file,
                    {{"record[0].data", fs::absolute(data).lexically_normal().string()},
                     {"record[0].use", "fit"}});
}

}  // namespace ambrig
