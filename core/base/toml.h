#pragma once
/// The door to toml++: tables that know their file and line, so that every wrong key, type or value
/// ends in one line "file:line: path = value, allowed ...". Nobody else includes toml++.
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/parameters.h"

namespace ambrig {

/// One `{ value, sd }` of a file: the one-sigma knowledge of a parameter. `true_value` is what the
/// simulated plant has while the controller keeps `value`: a calibration's result (the key `fitted`
/// of a rig file, written by `ambrig adopt`) or the draw of a Monte Carlo campaign.
struct Tolerance {
  std::string path;               // "rotor.mass", "bearings.A.gap"
  double sd = 0;                  // same unit as the value
  double true_value = kRequired;  // same unit; nan: the plant has `value` too
};

/// A TOML table (or the file's root) with its place in the file. Keys that were asked for are
/// remembered; RejectUnknownKeys() complains about the others.
class TomlTable {
 public:
  /// @throws InputError when the file cannot be read or is not TOML (file:line and reason).
  static TomlTable FromFile(const std::string& file);
  static TomlTable FromText(const std::string& text, const std::string& file_name);

  const std::string& file() const;
  const std::string& path() const;  // "bearings.A", "" for the root
  /// "rig.toml:31: bearings.A.gap"; the table's own line when the key is absent.
  std::string Where(std::string_view key = {}) const;

  bool Has(std::string_view key) const;
  std::vector<std::string> Keys() const;

  /// Plain or {value, sd}; never nan. Infinite only where the fallback is. Without fallback:
  /// required.
  double Number(std::string_view key) const;
  double Number(std::string_view key, double fallback) const;
  /// Also returns the sd of `{ value, sd }` (0 when plain).
  double Number(std::string_view key, double fallback, double* sd) const;
  long long Integer(std::string_view key, long long fallback) const;
  bool Bool(std::string_view key, bool fallback) const;
  std::string String(std::string_view key) const;
  std::string String(std::string_view key, const std::string& fallback) const;
  /// One of a comma separated list, else an error that names the list and the nearest entry.
  std::string Choice(std::string_view key, const std::string& fallback,
                     const std::string& comma_separated_allowed) const;
  std::vector<double> Numbers(std::string_view key) const;
  std::vector<double> Numbers(std::string_view key, const std::vector<double>& fallback) const;
  std::vector<std::string> Strings(std::string_view key) const;
  /// [[a, b], [c, d]]: rows of numbers.
  std::vector<std::vector<double>> Rows(std::string_view key) const;
  std::optional<TomlTable> Table(std::string_view key) const;
  std::vector<TomlTable> Tables(std::string_view key) const;  // [[key]]; empty when absent
  /// [[{...}, {...}], [{...}]]: rows of tables.
  std::vector<std::vector<TomlTable>> TableRows(std::string_view key) const;
  bool IsNumber(std::string_view key) const;
  bool IsString(std::string_view key) const;
  bool IsBool(std::string_view key) const;
  bool IsTable(std::string_view key) const;
  bool IsArray(std::string_view key) const;

  /// Reads every field of a parameter table and checks its range; fields whose in-class default
  /// is kRequired must be present. Tolerances found are appended under this table's path.
  template <class P, std::size_t n>
  void Read(P& p, const Field<P> (&fields)[n], std::vector<Tolerance>* tolerances = nullptr) const {
    P fitted = p;  // nan where the file has none
    for (const Field<P>& f : fields) {
      double sd = 0, true_value = kRequired;
      p.*f.at = NumberOr(f.key, p.*f.at, &sd, &true_value);
      fitted.*f.at = true_value;
      if (std::isnan(p.*f.at)) RejectMisspelt(f.key);
      if ((sd > 0 || !std::isnan(true_value)) && tolerances)
        tolerances->push_back(
            {(path().empty() ? "" : path() + ".") + std::string(f.key), sd, true_value});
    }
    CheckRanges(p, fields, [&](std::string_view key) { return Where(key); });
    CheckFitted(fitted, fields);
  }

  /// @throws InputError for the first key that no reader asked for, naming the nearest known one.
  void RejectUnknownKeys() const;
  /// A required key is missing: throws when another, unknown one looks like it.
  void RejectMisspelt(std::string_view key) const;
  /// "file:line: path.key: text", thrown.
  [[noreturn]] void Fail(std::string_view key, const std::string& text) const;

 private:
  struct Node;
  double NumberOr(std::string_view key, double fallback, double* sd,
                  double* true_value = nullptr) const;
  /// A calibrated value is the plant's, and must be as possible as the drawing's.
  template <class P, std::size_t n>
  void CheckFitted(const P& fitted, const Field<P> (&fields)[n]) const {
    for (const Field<P>& f : fields)
      if (const double v = fitted.*f.at; v < f.lo || v > f.hi)
        ThrowOutOfRange(Where(f.key) + ".fitted", f.key, v, f.unit, f.lo, f.hi, f.doc);
  }
  explicit TomlTable(std::shared_ptr<const Node> node);
  std::shared_ptr<Node> Inside(const std::string& name) const;
  std::shared_ptr<const Node> node_;
};

}  // namespace ambrig
