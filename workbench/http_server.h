#pragma once
/// The door to libmicrohttpd: listens on 127.0.0.1 only.
#include <cstdint>
#include <memory>

#include "workbench/http_message.h"

namespace ambrig::workbench {

class HttpServer {
 public:
  /// Port 0: a free one. `handler` must outlive it. @throws InputError when the port is taken
  HttpServer(std::uint16_t port, HttpHandler& handler);
  ~HttpServer();  // ends all connections
  HttpServer(const HttpServer&) = delete;
  HttpServer& operator=(const HttpServer&) = delete;

  std::uint16_t port() const { return port_; }

 private:
  struct Daemon;
  std::unique_ptr<Daemon> daemon_;
  std::uint16_t port_ = 0;
};

}  // namespace ambrig::workbench
