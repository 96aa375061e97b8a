/// The reader's side: records in memory, thinned.
#include "workbench/record_reader.h"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <cstring>

#include "core/base/errors.h"
#include "core/base/json_file.h"
#include "workbench/record_shelf.h"

namespace ambrig::workbench {
namespace {

using Json = nlohmann::ordered_json;

constexpr rlim_t kMemory = rlim_t{1} << 30;  // [bytes]
constexpr std::size_t kMostColumns = 20000;
constexpr std::size_t kMostWhole = 4000000;  // values of an export

std::string Describe(const KeptRecord& k) {
  Json channels = Json::array();
  for (const KeptChannel& c : k.channels) channels.push_back({{"name", c.name}, {"unit", c.unit}});
  return "J" + JsonText(Json{{"rate", k.rate},
                             {"start", k.start},
                             {"rows", k.rows},
                             {"channels", channels},
                             {"notes", k.notes}});
}

std::size_t RowAt(const KeptRecord& r, double t) {
  const double row = (t - r.start) * r.rate;
  if (!(row > 0)) return 0;
  return std::min(static_cast<std::size_t>(std::min(row, 1e15)), r.rows);
}

/// Whether every sample is wanted, as for an export, and can be sent.
bool IsWhole(const Json& request, std::size_t rows) {
  if (!request.value("all", false)) return false;
  if (rows * request["channels"].size() > kMostWhole)
    throw InputError(
        fmt::format("{} rows of {} channels are too many to export, allowed: {} values; "
                    "zoom in",
                    rows, request["channels"].size(), kMostWhole));
  return true;
}

/// Of each channel the extremes of its columns as lo, hi pairs, or, where the view has fewer
/// samples than two a column, the samples.
std::string View(KeptRecord& r, const Json& request) {
  const std::size_t columns =
      std::clamp<std::size_t>(request.value("px", std::size_t{600}), 1, kMostColumns);
  const std::size_t first = RowAt(r, request.value("t0", r.start));
  const double end = r.start + static_cast<double>(r.rows) / r.rate;
  const std::size_t last = std::min(RowAt(r, request.value("t1", end)) + 1, r.rows);
  const std::size_t rows = last > first ? last - first : 0;
  const bool raw = rows <= 2 * columns || IsWhole(request, rows);
  std::vector<float> values;
  Json channels = Json::array();
  for (const std::string& name : request["channels"].get<std::vector<std::string>>()) {
    KeptChannel* c = r.Find(name);
    if (!c) throw InputError(fmt::format("no channel {}", name));
    channels.push_back({{"name", name}, {"unit", c->unit}});
    if (raw) {
      values.insert(values.end(), c->samples.begin() + static_cast<std::ptrdiff_t>(first),
                    c->samples.begin() + static_cast<std::ptrdiff_t>(last));
      continue;
    }
    if (!c->level) c->level.emplace(c->samples);
    for (const Extreme& e : ThinnedExtremes(c->samples, *c->level, first, last, columns)) {
      values.push_back(e.lo);
      values.push_back(e.hi);
    }
  }
  std::string head = Json{
      {"mode", raw ? "samples" : "extremes"},
      {"start", r.start + static_cast<double>(first) / r.rate},
      {"step",
       raw ? 1 / r.rate : static_cast<double>(rows) / static_cast<double>(columns) / r.rate},
      {"count", raw ? rows : columns},
      {"rate", r.rate},
      {"channels",
       channels}}.dump();
  head.resize((head.size() + 3) / 4 * 4, ' ');  // floats begin on a multiple of four
  const auto bytes = static_cast<std::uint32_t>(head.size());
  std::string out = "B";
  out.append(reinterpret_cast<const char*>(&bytes), sizeof bytes);
  out += head;
  out.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(float));
  return out;
}

std::string AnswerTo(RecordShelf& shelf, const std::string& line) {
  try {
    const Json request = Json::parse(line);
    KeptRecord& k = shelf.Get(request.at("file"), request.value("group", ""));
    return request.contains("channels") ? View(k, request) : Describe(k);
  } catch (const std::bad_alloc&) {
    return "J" + Json{{"error", "the record is too large for the reader's memory"}}.dump();
  } catch (const std::exception& e) {
    return "J" + JsonText(Json{{"error", e.what()}});
  }
}

bool SendAll(int socket, const char* bytes, std::size_t count) {
  while (count > 0) {
    const ssize_t n = ::write(socket, bytes, count);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    bytes += n;
    count -= static_cast<std::size_t>(n);
  }
  return true;
}

}  // namespace

int ServeRecords(int socket) {
#ifndef AMBRIG_SANITIZED  // whose shadow memory is larger than any limit
  const rlimit limit{kMemory, kMemory};
  ::setrlimit(RLIMIT_AS, &limit);
#endif
  RecordShelf shelf;
  std::string rest;
  char block[1 << 16];
  for (;;) {
    const ssize_t n = ::read(socket, block, sizeof block);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return 0;
    rest.append(block, static_cast<std::size_t>(n));
    for (std::size_t end; (end = rest.find('\n')) != std::string::npos; rest.erase(0, end + 1)) {
      const std::string answer = AnswerTo(shelf, rest.substr(0, end));
      const std::uint64_t bytes = answer.size();
      if (!SendAll(socket, reinterpret_cast<const char*>(&bytes), sizeof bytes) ||
          !SendAll(socket, answer.data(), answer.size()))
        return 0;
    }
  }
}

}  // namespace ambrig::workbench
