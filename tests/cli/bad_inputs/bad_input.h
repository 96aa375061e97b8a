#pragma once
/// One bad input and what must be said about it; suites of them are made from the parameter tables.
#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

#include "core/base/parameters.h"

namespace ambrig {

struct BadInput {
  std::string name;               // of the case: "rotor.mass below"
  std::string text;               // the whole file
  std::vector<std::string> said;  // fragments of the message, in this order
};

/// Reads every text and asks for an InputError of one line with the fragments; returns how many.
inline std::size_t ExpectRefused(const std::vector<BadInput>& cases,
                                 const std::function<void(const std::string&)>& read) {
  for (const BadInput& c : cases) {
    try {
      read(c.text);
      ADD_FAILURE() << c.name << ": accepted in silence";
    } catch (const InputError& e) {
      const std::string message = e.what();
      EXPECT_EQ(message.find('\n'), std::string::npos) << c.name << ": " << message;
      std::size_t at = 0;
      for (const std::string& part : c.said) {
        const std::size_t found = message.find(part, at);
        EXPECT_NE(found, std::string::npos) << c.name << ": no \"" << part << "\" in " << message;
        if (found != std::string::npos) at = found + part.size();
      }
    } catch (const std::exception& e) {
      ADD_FAILURE() << c.name << ": program error: " << e.what();
    }
  }
  return cases.size();
}

/// Values that no number of this range may have, with the name of the kind.
struct BadValue {
  std::string kind, toml;
};
inline std::vector<BadValue> BadValues(double lo, double hi) {
  std::vector<BadValue> out{
      {"text", "\"much\""}, {"flag", "true"}, {"list", "[1.0, 2.0]"}, {"nan", "nan"}};
  if (std::isfinite(lo)) out.push_back({"below", NumberText(lo - std::max(1e-3, std::abs(lo)))});
  if (std::isfinite(hi)) out.push_back({"above", NumberText(hi + std::max(1e-3, std::abs(hi)))});
  if (std::isfinite(hi)) out.push_back({"inf", "inf"});
  if (std::isfinite(lo)) out.push_back({"minus inf", "-inf"});
  return out;
}

}  // namespace ambrig
