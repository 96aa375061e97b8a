#include "workbench/request_guard.h"

#include <sys/random.h>

#include <algorithm>
#include <array>

#include "core/base/errors.h"

namespace ambrig::workbench {
namespace {

/// The name of this machine to itself, with any port.
bool IsLoopbackHost(const std::string& host) {
  const std::string name =
      host.starts_with("[") ? host.substr(0, host.find(']') + 1) : host.substr(0, host.find(':'));
  const std::string rest = host.substr(name.size());
  const bool port = rest.empty() || (rest.size() > 1 && rest.size() <= 6 && rest[0] == ':' &&
                                     std::all_of(rest.begin() + 1, rest.end(), [](unsigned char c) {
                                       return c >= '0' && c <= '9';
                                     }));
  return port && (name == "127.0.0.1" || name == "localhost" || name == "[::1]");
}

}  // namespace

std::string MakeToken() {
  std::array<unsigned char, 32> bytes{};
  if (::getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size()))
    throw InputError("no random numbers from the system for the token");
  constexpr char kDigits[] = "0123456789abcdef";
  std::string text;
  for (const unsigned char b : bytes) {
    text += kDigits[b >> 4];
    text += kDigits[b & 15];
  }
  return text;
}

bool SameSecret(const std::string& a, const std::string& b) {
  unsigned difference = a.size() == b.size() ? 0 : 1;
  for (std::size_t k = 0; k < a.size(); ++k)
    difference |= static_cast<unsigned char>(a[k]) ^
                  static_cast<unsigned char>(b.empty() ? 0 : b[k % b.size()]);
  return difference == 0;
}

std::string RequestGuard::Complaint(const HttpRequest& request, bool open) const {
  const std::string host = request.Header("host");
  if (!IsLoopbackHost(host)) return "Host is not this machine";
  if (request.headers.contains("origin") && request.Header("origin") != "http://" + host)
    return "Origin is another page";
  const std::string site = request.Header("sec-fetch-site");
  // A link from elsewhere may open the page itself, which holds nothing.
  if (!site.empty() && site != "same-origin" && site != "none" &&
      !(open && request.Header("sec-fetch-mode") == "navigate"))
    return "Sec-Fetch-Site is another page";
  if (open) return "";
  const std::string authorization = request.Header("authorization");
  if (!authorization.starts_with("Bearer ") || !SameSecret(token_, authorization.substr(7)))
    return "no token, or another one: open the address that `ambrig serve` printed";
  return "";
}

}  // namespace ambrig::workbench
