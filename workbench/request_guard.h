#pragma once
/// Who may ask: the page that this server sent, opened by a browser that has the token. Other web
/// pages of the same browser (another Origin, a rebound host name) and other users of the machine
/// are refused.
#include <string>

#include "workbench/http_message.h"

namespace ambrig::workbench {

/// 256 random bits in hexadecimal digits. @throws InputError when the system has none
std::string MakeToken();

/// Compares without telling by its time where the texts differ.
bool SameSecret(const std::string& a, const std::string& b);

class RequestGuard {
 public:
  explicit RequestGuard(std::string token) : token_(std::move(token)) {}

  /// "" for a request that may be answered; else why not. The page and its scripts (`open`) hold
  /// nothing of the folder and need no token.
  std::string Complaint(const HttpRequest& request, bool open) const;

 private:
  std::string token_;
};

}  // namespace ambrig::workbench
