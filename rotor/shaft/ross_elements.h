#pragma once
/// The tables of ROSS's rotor file as they stand there (rotor/shaft/ross_file.h says which),
/// TOML or JSON.
#include <fmt/format.h>

#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "core/base/errors.h"
#include "core/base/parameters.h"

namespace ambrig {

/// One table of the file, whatever its format. Booleans are 0 and 1.
struct RossElement {
  std::string kind, name, where;
  std::map<std::string, std::vector<double>> numbers;
  std::map<std::string, std::string> texts;
  std::map<std::string, double> material;
  bool two_axes = false;  // coefficients over speed and frequency of the whirl (version 3)

  [[noreturn]] void Fail(const std::string& text) const {
    throw InputError(fmt::format("{}: {}", where, text));
  }
  /// "ShaftElement_7 (element 7)"
  std::string Label() const {
    const std::string tag = name.empty() ? kind : kind + "_" + name;
    const char* place = kind.find("Shaft") == 0 ? "element" : "node";
    return Has("n") ? fmt::format("{} ({} {})", tag, place, numbers.at("n")[0]) : tag;
  }
  bool Has(const std::string& key) const { return numbers.count(key) && !numbers.at(key).empty(); }
  double Get(const std::string& key) const {
    if (!Has(key)) Fail(key + " is missing");
    return numbers.at(key)[0];
  }
  double Get(const std::string& key, double fallback) const {
    return Has(key) ? numbers.at(key)[0] : fallback;
  }
  int Node() const {
    const double n = Get("n");
    if (n < 0 || n > 1e6 || n != std::floor(n))
      Fail(fmt::format("n = {}, allowed: a node number", NumberText(n)));
    return static_cast<int>(n);
  }
};

/// @throws InputError for a file that is neither.
std::vector<RossElement> ReadRossElements(const std::string& file);

}  // namespace ambrig
