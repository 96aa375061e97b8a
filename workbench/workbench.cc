#include "workbench/workbench.h"

#include <fmt/format.h>
#include <unistd.h>

#include <filesystem>

#include "core/base/errors.h"
#include "core/base/fingerprint.h"
#include "core/base/read_file.h"
#include "workbench/page_files.h"

namespace ambrig::workbench {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kPolicy =
    "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data: blob:; "
    "connect-src 'self'; frame-ancestors 'none'; base-uri 'none'; form-action 'none'; "
    "require-trusted-types-for 'script'; trusted-types lit-html";
/// Reports may come from strangers: without an origin they have no token and no folder.
constexpr const char* kReportPolicy =
    "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data: "
    "blob:; "
    "font-src data:; frame-ancestors 'none'; base-uri 'none'; form-action 'none'; "
    "sandbox allow-scripts allow-downloads";

HttpResponse JsonAnswer(const Json& json, int status = 200) {
  return {status,
          "application/json",
          json.dump(-1, ' ', false, Json::error_handler_t::replace),
          {},
          {}};
}

HttpResponse ErrorAnswer(int status, const std::string& text) {
  return JsonAnswer({{"error", text}}, status);
}

bool NeedsNoToken(const HttpRequest& r) {
  return r.method == "GET" &&
         (r.path == "/" || r.path.starts_with("/a/") || r.path.starts_with("/report/"));
}

/// The number behind the last slash; -1: none.
int IdOf(const std::string& path, const std::string& before) {
  const std::string digits = path.substr(std::min(path.size(), before.size()));
  if (digits.empty() || digits.size() > 8 ||
      digits.find_first_not_of("0123456789") != std::string::npos)
    return -1;
  return std::stoi(digits);
}

nlohmann::json BodyOf(const HttpRequest& r) {
  nlohmann::json body = nlohmann::json::parse(r.body, nullptr, false);
  if (!body.is_object()) throw InputError("the body is no JSON object");
  return body;
}

std::string TextIn(const nlohmann::json& body, const char* key) {
  if (!body.contains(key) || !body[key].is_string())
    throw InputError(fmt::format("{}: is missing", key));
  return body[key];
}

}  // namespace

Workbench::Workbench(const std::string& folder, const std::string& program,
                     const std::string& token)
    : folder_(folder),
      guard_(token),
      jobs_(folder_, program, events_),
      index_(folder_, jobs_),
      texts_(folder_),
      reader_(program) {}

Workbench::~Workbench() = default;

std::unique_ptr<HttpResponse> Workbench::Refuse(const HttpRequest& r) {
  const std::string why = guard_.Complaint(r, NeedsNoToken(r));
  if (!why.empty()) return std::make_unique<HttpResponse>(ErrorAnswer(403, why));
  if (r.method != "GET" && r.method != "PUT" && r.method != "POST" && r.method != "DELETE")
    return std::make_unique<HttpResponse>(ErrorAnswer(405, "allowed: GET, PUT, POST, DELETE"));
  return nullptr;
}

std::string Workbench::UploadFile(const HttpRequest& r) {
  if (r.method != "PUT" || r.path != "/api/upload") return "";
  return fmt::format("{}/.ambrig/upload-{}-{}", folder_.path(), ::getpid(), ++uploads_);
}

HttpResponse Workbench::Answer(const HttpRequest& r) {
  try {
    if (r.path == "/") return Page("index.html");
    if (r.path.starts_with("/a/")) return Page(r.path.substr(3));
    if (r.path.starts_with("/report/")) return Report(r.path.substr(8));
    if (r.path.starts_with("/api/")) return Api(r);
    return ErrorAnswer(404, "there is nothing here");
  } catch (const Conflict& c) {
    return JsonAnswer({{"error", "the file changed since it was read"}, {"hash", c.hash}}, 412);
  } catch (const InputError& e) {
    return ErrorAnswer(400, e.what());
  } catch (const std::exception& e) {
    return ErrorAnswer(500, e.what());
  }
}

HttpResponse Workbench::Page(const std::string& name) const {
  const PageFile* file = FindPageFile(name);
  if (!file) return ErrorAnswer(404, "there is nothing here");
  return {200,
          std::string(file->type),
          std::string(file->bytes),
          {{"Content-Security-Policy", kPolicy}, {"Cache-Control", "no-cache"}},
          {}};
}

HttpResponse Workbench::Api(const HttpRequest& r) {
  const std::string what = r.path.substr(5);
  if (what == "folder" && r.method == "GET") return JsonAnswer(index_.Folder());
  if (what == "file") return File(r);
  if (what == "upload" && r.method == "PUT") return Upload(r);
  if (what == "result" && r.method == "GET")
    return JsonAnswer(index_.Result(r.Query("kind"), r.Query("p")));
  if (what == "series" && r.method == "GET") return Series(r);
  if (what == "jobs" || what.starts_with("jobs/")) return Job(r);
  if (what == "events" && r.method == "GET") return EventStream(r);
  if (what == "ticket" && r.method == "POST") return NewTicket(r);
  if (what.starts_with("undo/") && r.method == "POST")
    return JsonAnswer(texts_.Undo(IdOf(what, "undo/")));
  if (what == "mend" && r.method == "POST") {
    const nlohmann::json body = BodyOf(r);
    const Json done =
        texts_.Mend(TextIn(body, "case"), TextIn(body, "record"), TextIn(body, "mend"));
    events_.Add({{"event", "file"}, {"file", body["case"]}});
    return JsonAnswer(done);
  }
  return ErrorAnswer(404, "there is nothing here");
}

HttpResponse Workbench::File(const HttpRequest& r) {
  const std::string name = r.Query("p");
  if (r.method == "GET") {
    const std::string text = folder_.Read(name, TextFiles::kLargest);
    return {200, "text/plain; charset=utf-8", text, {{"ETag", '"' + HashText(text) + '"'}}, {}};
  }
  if (r.method != "PUT") return ErrorAnswer(405, "allowed: GET, PUT");
  std::string hash = r.Header("if-match");
  std::erase(hash, '"');
  const int step = texts_.Replace(name, r.body, hash);
  events_.Add({{"event", "file"}, {"file", name}});
  HttpResponse out = JsonAnswer({{"step", step}, {"hash", HashText(r.body)}});
  out.headers["ETag"] = '"' + HashText(r.body) + '"';
  return out;
}

HttpResponse Workbench::Upload(const HttpRequest& r) {
  const std::string name = r.Query("p");
  if (name.ends_with(".html")) throw InputError(name + ": allowed: records and text files");
  folder_.MoveIn(r.upload, name);
  events_.Add({{"event", "file"}, {"file", name}});
  return JsonAnswer({{"file", name}}, 201);
}

HttpResponse Workbench::Job(const HttpRequest& r) {
  if (r.path == "/api/jobs") {
    if (r.method == "GET") return JsonAnswer(jobs_.All());
    if (r.method == "POST") return JsonAnswer(jobs_.Start(BodyOf(r)), 202);
    return ErrorAnswer(405, "allowed: GET, POST");
  }
  if (r.path.find('/', 10) != std::string::npos) return JobFile(r);
  const int id = IdOf(r.path, "/api/jobs/");
  if (r.method == "DELETE") return JsonAnswer({{"stopped", jobs_.Stop(id)}});
  const Json state = jobs_.State(id);
  return state.is_null() ? ErrorAnswer(404, "there is no such job") : JsonAnswer(state);
}

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

}  // namespace ambrig::workbench
