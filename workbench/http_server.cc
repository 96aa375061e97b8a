#include "workbench/http_server.h"

#include <arpa/inet.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <microhttpd.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "core/base/errors.h"

namespace ambrig::workbench {
namespace {

constexpr unsigned kMostConnections = 96;
constexpr unsigned kIdleSeconds = 30;
constexpr std::size_t kHeaderMemory = 32 << 10;

/// One request while its body arrives.
struct Exchange {
  HttpRequest request;
  bool too_large = false;
  int upload = -1;
  std::size_t received = 0;

  ~Exchange() {
    if (upload >= 0) ::close(upload);
    if (!request.upload.empty()) ::unlink(request.upload.c_str());  // was not renamed
  }
  void Take(const char* bytes, std::size_t count);
};

void Exchange::Take(const char* bytes, std::size_t count) {
  received += count;
  if (upload < 0) {
    too_large = too_large || received > kLargestBody;
    if (!too_large) request.body.append(bytes, count);
    return;
  }
  too_large = too_large || received > kLargestUpload;
  while (count > 0 && !too_large) {
    const ssize_t n = ::write(upload, bytes, count);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) {
      too_large = true;  // a full disk
      return;
    }
    bytes += n;
    count -= static_cast<std::size_t>(n);
  }
}

MHD_Result TakeHeader(void* out, MHD_ValueKind, const char* name, const char* value) {
  std::string key = name;
  std::transform(key.begin(), key.end(), key.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  auto& headers = *static_cast<std::map<std::string, std::string>*>(out);
  // A header that stands twice is two opinions: neither counts.
  const bool first = headers.emplace(key, value == nullptr ? "" : value).second;
  if (!first) headers[key] = "\x01twice";
  return MHD_YES;
}

/// With lengths, as a value may hold a zero byte.
MHD_Result TakeQuery(void* out, MHD_ValueKind, const char* name, std::size_t name_size,
                     const char* value, std::size_t value_size) {
  static_cast<std::map<std::string, std::string>*>(out)->emplace(
      std::string(name, name_size), value == nullptr ? "" : std::string(value, value_size));
  return MHD_YES;
}

ssize_t NextBytes(void* stream, std::uint64_t, char* out, std::size_t room) {
  auto& source = *static_cast<std::function<std::string()>*>(stream);
  const std::string bytes = source();
  if (bytes.empty()) return MHD_CONTENT_READER_END_OF_STREAM;
  const std::size_t n = std::min(bytes.size(), room);
  std::memcpy(out, bytes.data(), n);
  return static_cast<ssize_t>(n);
}

MHD_Result Send(MHD_Connection* connection, const HttpResponse& answer) {
  MHD_Response* response = nullptr;
  if (answer.stream) {
    response = MHD_create_response_from_callback(
        MHD_SIZE_UNKNOWN, 1 << 20, NextBytes, new std::function<std::string()>(answer.stream),
        [](void* stream) { delete static_cast<std::function<std::string()>*>(stream); });
  } else {
    response = MHD_create_response_from_buffer(
        answer.body.size(), const_cast<char*>(answer.body.data()), MHD_RESPMEM_MUST_COPY);
  }
  if (response == nullptr) return MHD_NO;
  MHD_add_response_header(response, "Content-Type", answer.type.c_str());
  MHD_add_response_header(response, "X-Content-Type-Options", "nosniff");
  MHD_add_response_header(response, "Referrer-Policy", "no-referrer");
  MHD_add_response_header(response, "Cross-Origin-Resource-Policy", "same-origin");
  if (!answer.headers.contains("Cache-Control"))
    MHD_add_response_header(response, "Cache-Control", "no-store");
  for (const auto& [name, value] : answer.headers)
    MHD_add_response_header(response, name.c_str(), value.c_str());
  const MHD_Result result =
      MHD_queue_response(connection, static_cast<unsigned>(answer.status), response);
  MHD_destroy_response(response);
  return result;
}

HttpResponse Problem(int status, const std::string& text) {
  return {status, "application/json", fmt::format("{{\"error\":\"{}\"}}", text), {}, {}};
}

MHD_Result Begin(HttpHandler& handler, MHD_Connection* connection, const char* url,
                 const char* method, void** state) {
  auto exchange = std::make_unique<Exchange>();
  HttpRequest& r = exchange->request;
  r.method = method;
  r.path = url;
  MHD_get_connection_values(connection, MHD_HEADER_KIND, TakeHeader, &r.headers);
  MHD_get_connection_values_n(connection, MHD_GET_ARGUMENT_KIND, TakeQuery, &r.query);
  if (const auto refusal = handler.Refuse(r)) return Send(connection, *refusal);
  r.upload = handler.UploadFile(r);
  if (!r.upload.empty()) {
    exchange->upload = ::open(r.upload.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
    if (exchange->upload < 0) {
      r.upload.clear();
      return Send(connection, Problem(507, "the upload cannot be stored"));
    }
  }
  *state = exchange.release();
  return MHD_YES;
}

MHD_Result Handle(void* self, MHD_Connection* connection, const char* url, const char* method,
                  const char*, const char* data, std::size_t* size, void** state) {
  HttpHandler& handler = *static_cast<HttpHandler*>(self);
  if (*state == nullptr) return Begin(handler, connection, url, method, state);
  Exchange& exchange = *static_cast<Exchange*>(*state);
  if (*size > 0) {
    exchange.Take(data, *size);
    *size = 0;
    return MHD_YES;
  }
  if (exchange.too_large) return Send(connection, Problem(413, "the body is too large"));
  if (exchange.upload >= 0) {
    ::fsync(exchange.upload);
    ::close(exchange.upload);
    exchange.upload = -1;
  }
  return Send(connection, handler.Answer(exchange.request));
}

void Completed(void*, MHD_Connection*, void** state, MHD_RequestTerminationCode) {
  delete static_cast<Exchange*>(*state);
  *state = nullptr;
}

}  // namespace

struct HttpServer::Daemon {
  MHD_Daemon* mhd = nullptr;
  ~Daemon() {
    if (mhd != nullptr) MHD_stop_daemon(mhd);
  }
};

HttpServer::HttpServer(std::uint16_t port, HttpHandler& handler)
    : daemon_(std::make_unique<Daemon>()) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  daemon_->mhd = MHD_start_daemon(
      MHD_USE_INTERNAL_POLLING_THREAD | MHD_USE_THREAD_PER_CONNECTION | MHD_USE_POLL, port, nullptr,
      nullptr, Handle, &handler, MHD_OPTION_SOCK_ADDR, &address, MHD_OPTION_CONNECTION_LIMIT,
      kMostConnections, MHD_OPTION_CONNECTION_TIMEOUT, kIdleSeconds,
      MHD_OPTION_CONNECTION_MEMORY_LIMIT, kHeaderMemory, MHD_OPTION_NOTIFY_COMPLETED, Completed,
      nullptr, MHD_OPTION_END);
  if (daemon_->mhd == nullptr)
    throw InputError(
        fmt::format("--port {}: cannot listen on 127.0.0.1, allowed: a free port, 0 "
                    "for any",
                    port));
  port_ = MHD_get_daemon_info(daemon_->mhd, MHD_DAEMON_INFO_BIND_PORT)->port;
}

HttpServer::~HttpServer() = default;

}  // namespace ambrig::workbench
