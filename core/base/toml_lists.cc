// Arrays of numbers, strings, rows and tables.
#include <fmt/format.h>

#include <cmath>

#include "core/base/toml_node.h"

namespace ambrig {

std::vector<double> TomlTable::Numbers(std::string_view key) const {
  if (!Has(key)) Fail(key, "is missing, allowed: an array of numbers");
  return Numbers(key, {});
}
std::vector<double> TomlTable::Numbers(std::string_view key,
                                       const std::vector<double>& fallback) const {
  const toml::node* n = node_->Get(key);
  if (!n) return fallback;
  const auto* a = n->as_array();
  if (!a)
    throw InputError(fmt::format("{} = {} is {}, allowed: an array of numbers", Where(key),
                                 TextOf(*n), TypeName(*n)));
  std::vector<double> out;
  for (const auto& v : *a) {
    if (!v.is_number() || !std::isfinite(NumberOf(v)))
      throw InputError(
          fmt::format("{} = {}: entry {} is not a finite number, allowed: finite numbers",
                      Where(key), TextOf(*n), out.size() + 1));
    out.push_back(NumberOf(v));
  }
  return out;
}

std::vector<std::string> TomlTable::Strings(std::string_view key) const {
  const toml::node* n = node_->Get(key);
  if (!n) return {};
  const auto* a = n->as_array();
  if (!a)
    throw InputError(
        fmt::format("{} is {}, allowed: an array of strings", Where(key), TypeName(*n)));
  std::vector<std::string> out;
  for (const auto& v : *a) {
    if (!v.is_string())
      throw InputError(
          fmt::format("{} = {}: entry {} is not a string", Where(key), TextOf(*n), out.size() + 1));
    out.push_back(v.value<std::string>().value());
  }
  return out;
}

std::vector<std::vector<double>> TomlTable::Rows(std::string_view key) const {
  const toml::node* n = node_->Get(key);
  if (!n) return {};
  const auto* a = n->as_array();
  if (!a)
    throw InputError(fmt::format("{} is {}, allowed: an array of rows [[t, value], ...]",
                                 Where(key), TypeName(*n)));
  std::vector<std::vector<double>> out;
  for (const auto& row : *a) {
    const auto* r = row.as_array();
    std::vector<double> values;
    if (r)
      for (const auto& v : *r)
        if (v.is_number() && std::isfinite(NumberOf(v))) values.push_back(NumberOf(v));
    if (!r || values.size() != r->size() || values.empty())
      throw InputError(
          fmt::format("{}: row {} is not an array of finite numbers", Where(key), out.size() + 1));
    out.push_back(values);
  }
  return out;
}

std::optional<TomlTable> TomlTable::Table(std::string_view key) const {
  const toml::node* n = node_->Get(key);
  if (!n) return std::nullopt;
  const auto* t = n->as_table();
  if (!t)
    throw InputError(
        fmt::format("{} = {} is {}, allowed: a table", Where(key), TextOf(*n), TypeName(*n)));
  auto node = Inside(std::string(key));
  node->table = t;
  return TomlTable(node);
}

std::vector<TomlTable> TomlTable::Tables(std::string_view key) const {
  const toml::node* n = node_->Get(key);
  if (!n) return {};
  const auto* a = n->as_array();
  const auto fail = [&] {
    throw InputError(fmt::format("{} is {}, allowed: tables, each written [[{}]]", Where(key),
                                 TypeName(*n), key));
  };
  if (!a) fail();
  std::vector<TomlTable> out;
  for (const auto& item : *a) {
    const auto* t = item.as_table();
    if (!t) fail();
    auto node = Inside(fmt::format("{}[{}]", key, out.size() + 1));
    node->table = t;
    out.push_back(TomlTable(node));
  }
  return out;
}

std::shared_ptr<TomlTable::Node> TomlTable::Inside(const std::string& name) const {
  auto node = std::make_shared<Node>();
  node->root = node_->root;
  node->file = node_->file;
  node->path = (node_->path.empty() ? "" : node_->path + ".") + name;
  return node;
}

std::vector<std::vector<TomlTable>> TomlTable::TableRows(std::string_view key) const {
  const toml::node* n = node_->Get(key);
  if (!n) return {};
  const auto* a = n->as_array();
  if (!a)
    throw InputError(fmt::format("{} is {}, allowed: an array of rows of tables [[{{...}}], ...]",
                                 Where(key), TypeName(*n)));
  std::vector<std::vector<TomlTable>> out;
  for (const auto& row : *a) {
    const auto* r = row.as_array();
    if (!r)
      throw InputError(
          fmt::format("{}: row {} is not an array of tables", Where(key), out.size() + 1));
    out.emplace_back();
    for (const auto& item : *r) {
      auto node = Inside(fmt::format("{}[{}][{}]", key, out.size(), out.back().size() + 1));
      node->table = item.as_table();
      if (!node->table)
        throw InputError(
            fmt::format("{}: row {} is not an array of tables", Where(key), out.size()));
      out.back().push_back(TomlTable(node));
    }
  }
  return out;
}

}  // namespace ambrig
