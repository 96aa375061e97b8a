#include "core/base/toml.h"

#include <fmt/format.h>

#define TOML_EXCEPTIONS 1
#include <toml++/toml.h>

#include <filesystem>
#include <fstream>
#include <sstream>

namespace ambrig {

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

namespace {
std::string TypeName(const toml::node& n) {
  switch (n.type()) {
    case toml::node_type::string: return "a string";
    case toml::node_type::integer: return "an integer";
    case toml::node_type::floating_point: return "a number";
    case toml::node_type::boolean: return "true/false";
    case toml::node_type::array: return "an array";
    case toml::node_type::table: return "a table";
    default: return "a date";
  }
}
std::string Text(const toml::node& n) {
  std::ostringstream out;
  if (const auto* t = n.as_table()) out << toml::toml_formatter(*t, toml::format_flags::none);
  else if (const auto* a = n.as_array()) out << *a;
  else n.visit([&](const auto& v) {
    if constexpr (toml::is_floating_point<decltype(v)>) out << NumberText(v.get());
    else if constexpr (toml::is_value<decltype(v)>) out << v;
  });
  std::string text = out.str();
  for (char& c : text)
    if (c == '\n') c = ' ';
  return text.size() > 60 ? text.substr(0, 57) + "..." : text;
}
}  // namespace

TomlTable::TomlTable(std::shared_ptr<const Node> node) : node_(std::move(node)) {}

TomlTable TomlTable::FromText(const std::string& text, const std::string& file_name) {
  try {
    auto root = std::make_shared<toml::table>(toml::parse(text, file_name));
    auto node = std::make_shared<Node>();
    node->root = root;
    node->table = root.get();
    node->file = file_name;
    return TomlTable(node);
  } catch (const toml::parse_error& e) {
    throw InputError(fmt::format("{}:{}: not valid TOML: {}", file_name, e.source().begin.line,
                                 e.description()));
  }
}

TomlTable TomlTable::FromFile(const std::string& file) {
  std::error_code ignored;
  if (std::filesystem::is_directory(file, ignored))
    throw InputError(fmt::format("{}: is a folder, allowed: a TOML file", file));
  std::ifstream in(file, std::ios::binary);
  if (!in) throw InputError(fmt::format("{}: cannot open the file for reading", file));
  std::ostringstream text;
  text << in.rdbuf();
  if (in.bad()) throw InputError(fmt::format("{}: cannot read the file", file));
  return FromText(text.str(), file);
}

const std::string& TomlTable::file() const { return node_->file; }
const std::string& TomlTable::path() const { return node_->path; }

std::string TomlTable::Where(std::string_view key) const {
  const toml::node* n = key.empty() ? nullptr : node_->table->get(key);
  const auto line = n ? n->source().begin.line : node_->table->source().begin.line;
  std::string full = node_->path;
  if (!key.empty()) full += (full.empty() ? "" : ".") + std::string(key);
  return fmt::format("{}:{}: {}", node_->file, line, full.empty() ? "file" : full);
}

void TomlTable::Fail(std::string_view key, const std::string& text) const {
  // "gap = -1, allowed ...", but "gap: is missing".
  throw InputError(fmt::format("{}{}{}", Where(key), text.starts_with("=") ? " " : ": ", text));
}

bool TomlTable::Has(std::string_view key) const { return node_->Get(key) != nullptr; }

std::vector<std::string> TomlTable::Keys() const {
  std::vector<std::string> keys;
  for (const auto& [k, v] : *node_->table) keys.emplace_back(k.str());
  return keys;
}

bool TomlTable::IsNumber(std::string_view key) const {
  const auto* n = node_->table->get(key);
  return n && n->is_number();
}
bool TomlTable::IsString(std::string_view key) const {
  const auto* n = node_->table->get(key);
  return n && n->is_string();
}
bool TomlTable::IsBool(std::string_view key) const {
  const auto* n = node_->table->get(key);
  return n && n->is_boolean();
}
bool TomlTable::IsTable(std::string_view key) const {
  const auto* n = node_->table->get(key);
  return n && n->is_table();
}
bool TomlTable::IsArray(std::string_view key) const {
  const auto* n = node_->table->get(key);
  return n && n->is_array();
}

double TomlTable::NumberOr(std::string_view key, double fallback, double* sd, double* fitted) const {
  if (sd) *sd = 0;
  const toml::node* n = node_->Get(key);
  if (!n) return fallback;
  if (const auto* t = n->as_table()) {
    for (const auto& [k, v] : *t)
      if (k.str() != "value" && k.str() != "sd" && !(fitted && k.str() == "fitted"))
        throw InputError(fmt::format("{}.{}: unknown key, allowed: value, sd", Where(key), k.str()));
    const auto* value = t->get("value");
    if (!value || !value->is_number())
      Fail(key, fmt::format("= {}, allowed: a number or {{ value = number, sd = number }}", Text(*n)));
    if (const auto* s = t->get("sd")) {
      if (!s->is_number() || !(s->value<double>().value() >= 0) ||
          !std::isfinite(s->value<double>().value()))
        throw InputError(fmt::format("{}.sd = {}, allowed: a number of 0 or more", Where(key), Text(*s)));
      if (sd) *sd = s->value<double>().value();
    }
    if (const auto* f = t->get("fitted"); f && fitted) {
      if (!f->is_number() || !std::isfinite(f->value<double>().value()))
        throw InputError(fmt::format("{}.fitted = {}, allowed: a number", Where(key), Text(*f)));
      *fitted = f->value<double>().value();
    }
    n = value;
  }
  if (!n->is_number())
    throw InputError(fmt::format("{} = {} is {}, allowed: a number", Where(key), Text(*n), TypeName(*n)));
  const double v = n->value<double>().value();
  if (std::isnan(v)) Fail(key, "= nan, allowed: a number");
  return v;
}

double TomlTable::Number(std::string_view key) const {
  if (!Has(key)) Fail(key, "is missing, allowed: a number");
  return Number(key, 0, nullptr);
}
double TomlTable::Number(std::string_view key, double fallback) const { return Number(key, fallback, nullptr); }
double TomlTable::Number(std::string_view key, double fallback, double* sd) const {
  const double v = NumberOr(key, fallback, sd);
  if (Has(key) && std::isinf(v) && !std::isinf(fallback)) Fail(key, fmt::format("= {}, allowed: a finite number", v));
  return v;
}

long long TomlTable::Integer(std::string_view key, long long fallback) const {
  const toml::node* n = node_->Get(key);
  if (!n) return fallback;
  const auto v = n->value<double>();
  if (!n->is_number() || *v != std::floor(*v) || std::abs(*v) > 9e15)
    throw InputError(fmt::format("{} = {}, allowed: an integer", Where(key), Text(*n)));
  return static_cast<long long>(*v);
}

bool TomlTable::Bool(std::string_view key, bool fallback) const {
  const toml::node* n = node_->Get(key);
  if (!n) return fallback;
  if (!n->is_boolean())
    throw InputError(fmt::format("{} = {} is {}, allowed: true or false", Where(key), Text(*n), TypeName(*n)));
  return n->value<bool>().value();
}

std::string TomlTable::String(std::string_view key) const {
  if (!Has(key)) Fail(key, "is missing, allowed: a string");
  return String(key, "");
}
std::string TomlTable::String(std::string_view key, const std::string& fallback) const {
  const toml::node* n = node_->Get(key);
  if (!n) return fallback;
  if (!n->is_string())
    throw InputError(fmt::format("{} = {} is {}, allowed: a string", Where(key), Text(*n), TypeName(*n)));
  return n->value<std::string>().value();
}

std::string TomlTable::Choice(std::string_view key, const std::string& fallback,
                              const std::string& allowed) const {
  std::string word = String(key, fallback);
  std::istringstream list(allowed);
  std::string entry;
  while (std::getline(list, entry, ',')) {
    entry.erase(0, entry.find_first_not_of(' '));
    if (entry == word) return word;
  }
  const std::string near = Nearest(word, allowed);
  throw InputError(fmt::format("{} = \"{}\", allowed: {}{}", Where(key), word, allowed,
                               near.empty() ? "" : fmt::format(" (did you mean {}?)", near)));
}

std::vector<double> TomlTable::Numbers(std::string_view key) const {
  if (!Has(key)) Fail(key, "is missing, allowed: an array of numbers");
  return Numbers(key, {});
}
std::vector<double> TomlTable::Numbers(std::string_view key, const std::vector<double>& fallback) const {
  const toml::node* n = node_->Get(key);
  if (!n) return fallback;
  const auto* a = n->as_array();
  if (!a) throw InputError(fmt::format("{} = {} is {}, allowed: an array of numbers", Where(key), Text(*n), TypeName(*n)));
  std::vector<double> out;
  for (const auto& v : *a) {
    if (!v.is_number() || !std::isfinite(v.value<double>().value()))
      throw InputError(fmt::format("{} = {}: entry {} is not a finite number", Where(key), Text(*n), out.size() + 1));
    out.push_back(v.value<double>().value());
  }
  return out;
}

std::vector<std::string> TomlTable::Strings(std::string_view key) const {
  const toml::node* n = node_->Get(key);
  if (!n) return {};
  const auto* a = n->as_array();
  if (!a) throw InputError(fmt::format("{} is {}, allowed: an array of strings", Where(key), TypeName(*n)));
  std::vector<std::string> out;
  for (const auto& v : *a) {
    if (!v.is_string())
      throw InputError(fmt::format("{} = {}: entry {} is not a string", Where(key), Text(*n), out.size() + 1));
    out.push_back(v.value<std::string>().value());
  }
  return out;
}

std::vector<std::vector<double>> TomlTable::Rows(std::string_view key) const {
  const toml::node* n = node_->Get(key);
  if (!n) return {};
  const auto* a = n->as_array();
  if (!a) throw InputError(fmt::format("{} is {}, allowed: an array of rows [[t, value], ...]", Where(key), TypeName(*n)));
  std::vector<std::vector<double>> out;
  for (const auto& row : *a) {
    const auto* r = row.as_array();
    std::vector<double> values;
    if (r)
      for (const auto& v : *r)
        if (v.is_number() && std::isfinite(v.value<double>().value())) values.push_back(v.value<double>().value());
    if (!r || values.size() != r->size() || values.empty())
      throw InputError(fmt::format("{}: row {} is not an array of finite numbers", Where(key), out.size() + 1));
    out.push_back(values);
  }
  return out;
}

std::optional<TomlTable> TomlTable::Table(std::string_view key) const {
  const toml::node* n = node_->Get(key);
  if (!n) return std::nullopt;
  const auto* t = n->as_table();
  if (!t) throw InputError(fmt::format("{} = {} is {}, allowed: a table", Where(key), Text(*n), TypeName(*n)));
  auto node = std::make_shared<Node>();
  node->root = node_->root;
  node->table = t;
  node->file = node_->file;
  node->path = (node_->path.empty() ? "" : node_->path + ".") + std::string(key);
  return TomlTable(node);
}

std::vector<TomlTable> TomlTable::Tables(std::string_view key) const {
  const toml::node* n = node_->Get(key);
  if (!n) return {};
  const auto* a = n->as_array();
  const auto fail = [&] {
    throw InputError(fmt::format("{} is {}, allowed: tables, each written [[{}]]", Where(key), TypeName(*n), key));
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
  if (!a) throw InputError(fmt::format("{} is {}, allowed: an array of rows of tables [[{{...}}], ...]", Where(key), TypeName(*n)));
  std::vector<std::vector<TomlTable>> out;
  for (const auto& row : *a) {
    const auto* r = row.as_array();
    if (!r) throw InputError(fmt::format("{}: row {} is not an array of tables", Where(key), out.size() + 1));
    out.emplace_back();
    for (const auto& item : *r) {
      auto node = Inside(fmt::format("{}[{}][{}]", key, out.size(), out.back().size() + 1));
      node->table = item.as_table();
      if (!node->table) throw InputError(fmt::format("{}: row {} is not an array of tables", Where(key), out.size()));
      out.back().push_back(TomlTable(node));
    }
  }
  return out;
}

void TomlTable::RejectMisspelt(std::string_view key) const {
  for (const auto& [k, v] : *node_->table) {
    const std::string given(k.str());
    if (!node_->asked.contains(given) && !Nearest(given, std::string(key)).empty())
      throw InputError(fmt::format("{}: unknown key, did you mean {}? allowed: {}", Where(given), key, key));
  }
}

void TomlTable::RejectUnknownKeys() const {
  for (const auto& [k, v] : *node_->table) {
    const std::string key(k.str());
    if (node_->asked.count(key)) continue;
    std::string allowed;
    for (const std::string& a : node_->asked) allowed += (allowed.empty() ? "" : ", ") + a;
    const std::string near = Nearest(key, allowed);
    throw InputError(fmt::format("{}: unknown key, allowed: {}{}", Where(key), allowed,
                                 near.empty() ? "" : fmt::format(" (did you mean {}?)", near)));
  }
}

}  // namespace ambrig
