#pragma once
/// A request and its answer, without the library that carries them.
#include <functional>
#include <map>
#include <memory>
#include <string>

namespace ambrig::workbench {

struct HttpRequest {
  std::string method, path;
  std::map<std::string, std::string> query;    // decoded
  std::map<std::string, std::string> headers;  // names in lower case
  std::string body;                            // of requests that are not an upload
  std::string upload;  // of an upload: the temporary file that holds the body

  /// "" when absent.
  std::string Header(const std::string& name) const {
    const auto found = headers.find(name);
    return found == headers.end() ? "" : found->second;
  }
  std::string Query(const std::string& name) const {
    const auto found = query.find(name);
    return found == query.end() ? "" : found->second;
  }
};

struct HttpResponse {
  int status = 200;
  std::string type = "application/json";
  std::string body;
  std::map<std::string, std::string> headers;
  /// Instead of a body: asked for the next bytes until it returns none; may wait up to some
  /// seconds.
  std::function<std::string()> stream;
};

/// Answers. Thread-safe; each connection has a thread of its own.
class HttpHandler {
 public:
  virtual ~HttpHandler() = default;
  /// Before the body is read: a response refuses it.
  virtual std::unique_ptr<HttpResponse> Refuse(const HttpRequest& request) = 0;
  /// Where the body of an upload is to go, a new file; "": the body is kept in memory.
  virtual std::string UploadFile(const HttpRequest& request) = 0;
  virtual HttpResponse Answer(const HttpRequest& request) = 0;
};

/// Largest body that is kept in memory, and largest upload [bytes].
inline constexpr std::size_t kLargestBody = 1 << 20;
inline constexpr std::size_t kLargestUpload = std::size_t{8} << 30;

}  // namespace ambrig::workbench
