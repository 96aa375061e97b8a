#pragma once
/// The door to toml++: the only file that includes it. For core/base/toml*.cc alone
/// (tools/check_layers.py); everybody else knows tables (toml.h) and edits (toml_edit.h).
#define TOML_EXCEPTIONS 1
#include <toml++/toml.h>

#include <memory>
#include <set>
#include <string>

#include "core/base/toml.h"

namespace ambrig {

/// A table with its place in the document, and the keys that were asked for.
struct TomlTable::Node {
  std::shared_ptr<const toml::table> root;  // keeps the document alive
  const toml::table* table = nullptr;
  std::string file, path;
  mutable std::set<std::string, std::less<>> asked;

  const toml::node* Get(std::string_view key) const {
    asked.insert(std::string(key));
    return table->get(key);
  }
};

/// The document `text` of `file`. @throws InputError "file:line: not valid TOML: ..."
toml::table ParseToml(const std::string& text, const std::string& file);

/// A key of a hundred thousand names, a.a.a..., makes tables that toml++ cannot take apart again
/// without all of the stack.
/// @throws InputError "file:line: ..." when a key has more than 32 names.
void RejectDeepKeys(const std::string& text, const std::string& file);

/// Of an integer or a floating-point number (is_number). toml++'s own value<double>() is empty for
/// integers beyond 2^53.
double NumberOf(const toml::node& n);

/// "an integer", "a table": for messages.
std::string TypeName(const toml::node& n);
/// A value as one short line: for messages.
std::string TextOf(const toml::node& n);

}  // namespace ambrig
