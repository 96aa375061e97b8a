#pragma once
/// The workbench's answers: the page, and the requests below /api/ about one folder.
#include <atomic>
#include <map>
#include <mutex>
#include <string>

#include "workbench/event_log.h"
#include "workbench/folder_index.h"
#include "workbench/http_message.h"
#include "workbench/jobs.h"
#include "workbench/record_reader.h"
#include "workbench/request_guard.h"
#include "workbench/served_folder.h"
#include "workbench/text_files.h"
#include "workbench/watched_folders.h"

namespace ambrig::workbench {

class Workbench : public HttpHandler {
 public:
  /// `program`: this binary, for jobs and the reader. @throws InputError
  Workbench(const std::string& folder, const std::string& program, const std::string& token);
  ~Workbench() override;

  std::unique_ptr<HttpResponse> Refuse(const HttpRequest& request) override;
  std::string UploadFile(const HttpRequest& request) override;
  HttpResponse Answer(const HttpRequest& request) override;
  /// Ends the event streams, so that the server can be closed.
  void Close() { events_.Close(); }

 private:
  HttpResponse Page(const std::string& name) const;
  HttpResponse Api(const HttpRequest& request);
  HttpResponse File(const HttpRequest& request);
  HttpResponse Job(const HttpRequest& request);
  HttpResponse JobFile(const HttpRequest& request);
  HttpResponse Series(const HttpRequest& request);
  HttpResponse EventStream(const HttpRequest& request);
  HttpResponse Upload(const HttpRequest& request);
  HttpResponse Rows(const HttpRequest& request);
  HttpResponse Watched(const HttpRequest& request);
  HttpResponse Undo(int step);
  HttpResponse NewTicket(const HttpRequest& request);
  HttpResponse Report(const std::string& ticket);

  ServedFolder folder_;
  RequestGuard guard_;
  EventLog events_;
  Jobs jobs_;
  FolderIndex index_;
  TextFiles texts_;
  RecordReader reader_;
  WatchedFolders watched_;
  std::atomic<unsigned> uploads_{0};
  std::mutex tickets_mutex_;
  std::map<std::string, std::string> tickets_;  // -> absolute file, valid once
};

}  // namespace ambrig::workbench
