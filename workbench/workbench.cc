#include "workbench/workbench.h"

#include <fmt/format.h>
#include <unistd.h>

#include "core/base/errors.h"
#include "core/base/fingerprint.h"
#include "workbench/answers.h"
#include "workbench/page_files.h"

namespace ambrig::workbench {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kPolicy =
    "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data: blob:; "
    "connect-src 'self'; frame-ancestors 'none'; base-uri 'none'; form-action 'none'; "
    "require-trusted-types-for 'script'; trusted-types lit-html";
bool NeedsNoToken(const HttpRequest& r) {
  return r.method == "GET" &&
         (r.path == "/" || r.path.starts_with("/a/") || r.path.starts_with("/report/"));
}

}  // namespace

Workbench::Workbench(const std::string& folder, const std::string& program,
                     const std::string& token)
    : folder_(folder),
      guard_(token),
      jobs_(folder_, program, events_),
      index_(folder_, jobs_),
      texts_(folder_),
      reader_(program),
      watched_(folder_, jobs_, events_) {}

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
  if (what == "rows" && r.method == "GET") return Rows(r);
  if (what == "watched") return Watched(r);
  if (what.starts_with("undo/") && r.method == "POST") return Undo(IdOf(what, "undo/"));
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
  if (r.method != "PUT" && r.method != "DELETE")
    return ErrorAnswer(405, "allowed: GET, PUT, DELETE");
  std::string hash = r.Header("if-match");
  std::erase(hash, '"');
  if (r.method == "DELETE") {
    const int removed = texts_.Remove(name, hash);
    events_.Add({{"event", "file"}, {"file", name}});
    return JsonAnswer({{"step", removed}});
  }
  const int step = texts_.Replace(name, r.body, hash);
  events_.Add({{"event", "file"}, {"file", name}});
  HttpResponse out = JsonAnswer({{"step", step}, {"hash", HashText(r.body)}});
  out.headers["ETag"] = '"' + HashText(r.body) + '"';
  return out;
}

HttpResponse Workbench::Undo(int step) {
  const Json done = texts_.Undo(step);
  events_.Add({{"event", "file"}, {"file", done["file"]}});
  return JsonAnswer(done);
}

HttpResponse Workbench::Upload(const HttpRequest& r) {
  const std::string name = r.Query("p");
  if (name.ends_with(".html")) throw InputError(name + ": allowed: records and text files");
  folder_.MoveIn(r.upload, name);
  const int step = texts_.NoteAdded(name);
  events_.Add({{"event", "file"}, {"file", name}});
  return JsonAnswer({{"file", name}, {"step", step}}, 201);
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

}  // namespace ambrig::workbench
