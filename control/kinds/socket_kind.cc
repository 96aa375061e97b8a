/// kind = "socket": a controller behind a Unix or TCP socket, firmware under test.
#include <fmt/format.h>

#include <charconv>
#include <filesystem>

#include "control/external/external_controller.h"
#include "core/base/read_file.h"

namespace ambrig {

namespace {

bool IsPort(const std::string& text) {
  unsigned port = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), port);
  return error == std::errc{} && end == text.data() + text.size() && port > 0 && port < 65536;
}

/// A path of a Unix socket is meant beside the rig file, like every file that it names.
std::string AddressOf(const TomlTable& t) {
  const std::string a = t.String("address");
  if (a.starts_with("unix:") && a.size() > 5)
    return "unix:" + std::filesystem::absolute(Beside(t.file(), a.substr(5))).string();
  const std::size_t colon = a.rfind(':');
  if (a.starts_with("tcp:") && colon > 4 && IsPort(a.substr(colon + 1))) return a;
  t.Fail("address", fmt::format("= \"{}\", allowed: \"unix:PATH\" or \"tcp:HOST:PORT\"", a));
}

void ReadSocket(const TomlTable& t, const ControllerNames&, ControllerParameters& c) {
  auto settings = std::make_shared<ExternalSettings>();
  settings->address = AddressOf(t);
  ReadExternal(t, "address", *settings);
  c.own = std::move(settings);
}

std::unique_ptr<PositionController> MakeSocket(const ControllerParameters& c,
                                               const ControllerSite& site) {
  return std::make_unique<ExternalController>(dynamic_cast<const ExternalSettings&>(*c.own), site);
}

}  // namespace

const ControllerKind& SocketKind() {
  static constexpr ControllerKind kind{
      .name = "socket",
      .doc = "a controller behind a socket, firmware under test",
      .read = ReadSocket,
      .make = MakeSocket,
  };
  return kind;
}

}  // namespace ambrig
