#pragma once
/// The three kinds of failure (docs/architecture.md): the user's mistake is an InputError with one
/// line of text; the caller's mistake is a std::logic_error from Require; a numerical outcome is a
/// result struct and never an exception.
#include <source_location>
#include <stdexcept>
#include <string>

namespace ambrig {

/// What a user wrote is wrong: one line with file:line, key, value and what is allowed.
class InputError : public std::runtime_error {
 public:
  /// Control characters but tabs in `text`, which quotes keys, names and files as they stand there, become blanks.
  explicit InputError(const std::string& text);
};

/// The run was stopped by Ctrl-C; nothing half-written is left.
class Interrupted : public std::runtime_error {
 public:
  Interrupted() : std::runtime_error("interrupted") {}
};

/// Always-on check of a precondition. @throws std::logic_error naming the place.
void Require(bool condition, const char* what,
             std::source_location where = std::source_location::current());

/// The entry of `allowed` nearest to `word` in edit distance; empty when none is near.
std::string Nearest(const std::string& word, const std::string& comma_separated_allowed);

}  // namespace ambrig
