// Answers about jobs, records, events and reports.
#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>

#include "core/base/errors.h"
#include "core/base/read_file.h"
#include "workbench/answers.h"
#include "workbench/campaign_rows.h"
#include "workbench/workbench.h"

namespace ambrig::workbench {
namespace {

using Json = nlohmann::ordered_json;

/// Reports may come from strangers: without an origin they have no token and no folder.
constexpr const char* kReportPolicy =
    "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data: "
    "blob:; "
    "font-src data:; frame-ancestors 'none'; base-uri 'none'; form-action 'none'; "
    "sandbox allow-scripts allow-downloads";

}  // namespace

/// /api/jobs/N/result, /api/jobs/N/log
HttpResponse Workbench::JobFile(const HttpRequest& r) {
  const std::size_t slash = r.path.find('/', 10);
  const int id = IdOf(r.path.substr(0, slash), "/api/jobs/");
  const std::string what = r.path.substr(slash + 1);
  if (jobs_.State(id).is_null()) return ErrorAnswer(404, "there is no such job");
  const std::string folder = jobs_.FolderOf(id);
  if (what == "result") return {200, "application/json", ReadFile(folder + "/result.json"), {}, {}};
  if (what == "log")
    return {200, "text/plain; charset=utf-8", ReadFile(folder + "/log.txt", 1 << 20), {}, {}};
  return ErrorAnswer(404, "there is nothing here");
}

HttpResponse Workbench::Series(const HttpRequest& r) {
  Json request;
  if (r.query.contains("job")) {
    const int id = IdOf(r.Query("job"), "");
    if (jobs_.State(id).is_null()) return ErrorAnswer(404, "there is no such job");
    const bool run = !r.Query("run").empty();
    if (run && !IsServedName(r.Query("run"))) throw InputError("run: allowed: a scenario's name");
    request["file"] = jobs_.FolderOf(id) + (run ? "/run/" + r.Query("run") : "/series.h5");
    request["name"] = fmt::format("job {}", id);
  } else {
    const std::string name = r.Query("p");
    ::close(folder_.OpenToRead(name));
    request["file"] = folder_.path() + "/" + name;
    request["name"] = name;
  }
  if (!r.Query("record").empty()) request["group"] = r.Query("record");
  if (!r.Query("c").empty()) {
    std::vector<std::string> channels;
    std::string rest = r.Query("c") + ",";
    for (std::size_t end; (end = rest.find(',')) != std::string::npos; rest.erase(0, end + 1))
      if (end > 0) channels.push_back(rest.substr(0, end));
    if (channels.size() > 64) throw InputError("c: allowed: at most 64 channels");
    request["channels"] = channels;
  }
  if (r.Query("all") == "1") request["all"] = true;
  for (const char* key : {"t0", "t1", "px"}) {
    if (r.Query(key).empty()) continue;
    const double value = std::strtod(r.Query(key).c_str(), nullptr);
    if (!(std::abs(value) < 1e12)) throw InputError(fmt::format("{}: is no number", key));
    if (std::string(key) == "px")
      request[key] = static_cast<std::size_t>(std::max(1.0, value));
    else
      request[key] = value;
  }
  const std::string answer = reader_.Ask(request);
  return {200,
          answer[0] == 'J' ? "application/json" : "application/octet-stream",
          answer.substr(1),
          {},
          {}};
}

HttpResponse Workbench::EventStream(const HttpRequest& r) {
  auto seq = std::make_shared<std::uint64_t>(
      r.Query("after").empty() ? events_.last()
                               : std::strtoull(r.Query("after").c_str(), nullptr, 10));
  HttpResponse out;
  out.type = "application/x-ndjson";
  out.stream = [this, seq, first = true]() mutable {
    if (first) {
      first = false;
      return fmt::format("{{\"event\":\"hello\",\"seq\":{}}}\n", *seq);
    }
    return events_.After(seq.get(), std::chrono::seconds(10));
  };
  return out;
}

HttpResponse Workbench::NewTicket(const HttpRequest& r) {
  const nlohmann::json body = BodyOf(r);
  std::string file;
  if (body.contains("job") && body["job"].is_number_integer()) {
    const int id = body["job"];
    if (jobs_.State(id).is_null()) return ErrorAnswer(404, "there is no such job");
    file = jobs_.FolderOf(id) + "/report.html";
    std::error_code none;  // a run names its report after the scenario
    for (const auto& entry : std::filesystem::directory_iterator(jobs_.FolderOf(id) + "/run", none))
      if (entry.path().extension() == ".html") file = entry.path().string();
  } else {
    const std::string name = TextIn(body, "file");
    ::close(folder_.OpenToRead(name));
    if (!name.ends_with(".html")) throw InputError(name + ": is no report");
    file = folder_.path() + "/" + name;
  }
  if (!std::filesystem::is_regular_file(file)) return ErrorAnswer(404, "there is no report");
  const std::string ticket = MakeToken();
  const std::scoped_lock lock(tickets_mutex_);
  if (tickets_.size() > 100) tickets_.clear();
  tickets_[ticket] = file;
  return JsonAnswer({{"address", "/report/" + ticket}});
}

HttpResponse Workbench::Report(const std::string& ticket) {
  std::string file;
  {
    const std::scoped_lock lock(tickets_mutex_);
    const auto found = tickets_.find(ticket);
    if (found == tickets_.end())
      return ErrorAnswer(403, "this address was used or never given: open the report again");
    file = found->second;
    tickets_.erase(found);
  }
  return {200,
          "text/html; charset=utf-8",
          ReadFile(file),
          {{"Content-Security-Policy", kReportPolicy}},
          {}};
}

/// /api/rows?job=N&from=K: of the campaign that the job makes.
HttpResponse Workbench::Rows(const HttpRequest& r) {
  const Json state = jobs_.State(IdOf(r.Query("job"), ""));
  if (state.is_null() || state["command"] != "campaign")
    return ErrorAnswer(404, "there is no such campaign");
  const auto argv = state["argv"].get<std::vector<std::string>>();
  const auto out = std::find(argv.begin(), argv.end(), "--out");
  if (out == argv.end() || out + 1 == argv.end()) return ErrorAnswer(404, "there are no rows");
  const int from = r.Query("from").empty() ? 0 : IdOf(r.Query("from"), "");
  if (from < 0) throw InputError("from: allowed: the number of a row");
  const std::string folder = folder_.path() + "/" + out[1];
  if (!std::filesystem::is_regular_file(folder + "/journal.txt"))
    return JsonAnswer(
        {{"columns", Json::array()}, {"runs", 0}, {"total", 0}, {"rows", Json::array()}});
  return JsonAnswer(CampaignRows(folder, static_cast<std::size_t>(from)));
}

HttpResponse Workbench::Watched(const HttpRequest& r) {
  if (r.method == "POST") {
    const nlohmann::json body = BodyOf(r);
    watched_.Set(TextIn(body, "case"), TextIn(body, "folder"), body.value("on", true));
  } else if (r.method != "GET") {
    return ErrorAnswer(405, "allowed: GET, POST");
  }
  return JsonAnswer(watched_.All());
}

}  // namespace ambrig::workbench
