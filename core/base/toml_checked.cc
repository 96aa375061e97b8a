#include "core/base/toml_checked.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "core/base/read_file.h"

namespace ambrig {

namespace {

void CheckRange(const TomlTable& t, std::string_view key, double value, const Range& r) {
  if (r.lo <= value && value <= r.hi) return;
  ThrowOutOfRange(t.Where(key), key, value, r.unit, r.lo, r.hi, r.doc);
}

}  // namespace

std::pair<TomlTable, std::string> InnermostOf(const TomlTable& root, const std::string& path) {
  std::pair<TomlTable, std::string> out(root, path);
  auto& [table, rest] = out;
  for (std::size_t dot = rest.find('.'); dot != std::string::npos; dot = rest.find('.')) {
    const std::string inner = rest.substr(0, dot);
    if (!table.IsTable(inner)) break;
    table = *table.Table(inner);
    rest = rest.substr(dot + 1);
  }
  return out;
}

double Within(const TomlTable& t, std::string_view key, double fallback, const Range& range) {
  const double value = t.Number(key, fallback);
  if (!t.Has(key) && !std::isnan(fallback)) return value;
  if (std::isnan(value)) t.RejectMisspelt(key);
  CheckRange(t, key, value, range);
  return value;
}

std::vector<double> AllWithin(const TomlTable& t, std::string_view key,
                              const std::vector<double>& fallback, const Range& range) {
  const std::vector<double> values = t.Numbers(key, fallback);
  if (t.Has(key))
    for (const double v : values) CheckRange(t, key, v, range);
  return values;
}

std::string ExistingFile(const TomlTable& t, std::string_view key, const std::string& fallback) {
  const std::string name = fallback.empty() ? t.String(key) : t.String(key, fallback);
  const std::string path = Beside(t.file(), name);
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  const auto fail = [&](const char* why) {
    t.Fail(key, fmt::format("= \"{}\", allowed: a file ({}: {})", name, path, why));
  };
  if (name.empty()) fail("no name");
  if (!std::filesystem::exists(status)) fail("no such file");
  if (std::filesystem::is_directory(status)) fail("is a folder");
  return path;
}

void CheckSpread(std::string_view where, double sd, double value, double lo, double hi,
                 std::string_view unit) {
  constexpr double kLargest = 1e12;  // of a parameter without bounds
  if (sd == 0 || std::isnan(value)) return;
  double most = std::min(hi - lo, kLargest);
  if (lo > 0) most = std::min(most, std::abs(value));
  if (sd <= most) return;
  const std::string u = unit == "-" ? "" : fmt::format(" {}", unit);
  throw InputError(fmt::format("{}.sd = {}{}, allowed 0 to {}{} ({})", where, sd, u, most, u,
                               lo > 0 ? "at most the value itself" : "the width of its range"));
}

}  // namespace ambrig
