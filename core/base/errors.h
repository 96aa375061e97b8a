#pragma once
/// Kinds of failure (CONTRIBUTING.md, House rules): a user's mistake is an InputError with one line
/// of text; a caller's mistake is a std::logic_error from Require; equations without a solution
/// within the tolerances are a NoSolution (core/math/no_solution.h); Ctrl-C is
/// Interrupted. A search or a fit that finds nothing better returns a result that says so.
#include <source_location>
#include <stdexcept>
#include <string>

namespace ambrig {

/// What a user wrote is wrong: one line with file:line, key, value and what is allowed.
class InputError : public std::runtime_error {
 public:
  /// Control characters but tabs in `text`, which quotes keys, names and files as they stand
  /// there, become blanks.
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
