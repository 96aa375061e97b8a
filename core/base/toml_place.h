#pragma once
/// Where the nodes of a TOML document stand in its text. For core/base/toml_edit.cc alone, as
/// toml_node.h.
#include <cstddef>
#include <string>
#include <vector>

#include "core/base/toml_node.h"

namespace ambrig {

/// The characters [begin, end) of a text.
struct TomlSpan {
  std::size_t begin = 0, end = 0;
};

/// The text of a document with its lines, to find the places of its nodes.
class TomlPlaces {
 public:
  explicit TomlPlaces(const std::string& text);

  /// A value with its quotes or brackets; of a table with a header the header alone.
  TomlSpan Of(const toml::node& node) const;
  /// The first character of the line that `at` is in, and that of the next line.
  std::size_t LineBegin(std::size_t at) const;
  std::size_t NextLine(std::size_t at) const;
  /// White space before the first character of its line.
  std::string Indentation(std::size_t at) const;

  /// A table, or an array of tables, that is written with headers [a] or [[a]].
  bool HasHeader(const toml::node& node) const;
  /// The last value that stands under the table's own header, also by dotted keys; the header when
  /// there is none.
  TomlSpan LastOf(const toml::table& table) const { return LastValue(table, Of(table)); }
  /// The same of the values before the first header; empty when there is none.
  TomlSpan LastOfRoot(const toml::table& root) const { return LastValue(root, {}); }
  /// Where a first value may stand before the first header: behind the comment of the whole file.
  std::size_t Top() const;
  /// Lines of a table and of the tables with headers inside it: from each header to its last value.
  std::vector<TomlSpan> Blocks(const toml::node& node) const;

 private:
  std::size_t Offset(const toml::source_position& position) const;
  TomlSpan LastValue(const toml::table& table, TomlSpan last) const;

  const std::string& text_;
  std::vector<std::size_t> lines_;  // where each begins
};

}  // namespace ambrig
