#include "core/base/toml.h"

#include <fmt/format.h>

#include <filesystem>
#include <sstream>

#include "core/base/inputs_read.h"
#include "core/base/read_file.h"
#include "core/base/toml_node.h"

namespace ambrig {

namespace {
constexpr std::size_t kLargestFile = 16 << 20;  // [bytes] a device without an end is no rig
}

std::string TypeName(const toml::node& n) {
  switch (n.type()) {
    case toml::node_type::string:
      return "a string";
    case toml::node_type::integer:
      return "an integer";
    case toml::node_type::floating_point:
      return "a number";
    case toml::node_type::boolean:
      return "true/false";
    case toml::node_type::array:
      return "an array";
    case toml::node_type::table:
      return "a table";
    default:
      return "a date";
  }
}
std::string TextOf(const toml::node& n) {
  std::ostringstream out;
  if (const auto* t = n.as_table())
    out << toml::toml_formatter(*t, toml::format_flags::none);
  else if (const auto* a = n.as_array())
    out << *a;
  else
    n.visit([&](const auto& v) {
      if constexpr (toml::is_floating_point<decltype(v)>)
        out << NumberText(v.get());
      else if constexpr (toml::is_value<decltype(v)>)
        out << v;
    });
  std::string text = out.str();
  for (char& c : text)
    if (c == '\n') c = ' ';
  return text.size() > 60 ? text.substr(0, 57) + "..." : text;
}

double NumberOf(const toml::node& n) {
  const auto* integer = n.as_integer();
  return integer ? static_cast<double>(integer->get()) : n.as_floating_point()->get();
}

toml::table ParseToml(const std::string& text, const std::string& file) {
  RejectDeepKeys(text, file);
  try {
    return toml::parse(text, file);
  } catch (const toml::parse_error& e) {
    throw InputError(
        fmt::format("{}:{}: not valid TOML: {}", file, e.source().begin.line, e.description()));
  }
}

TomlTable::TomlTable(std::shared_ptr<const Node> node) : node_(std::move(node)) {}

TomlTable TomlTable::FromText(const std::string& text, const std::string& file_name) {
  auto root = std::make_shared<toml::table>(ParseToml(text, file_name));
  auto node = std::make_shared<Node>();
  node->root = root;
  node->table = root.get();
  node->file = file_name;
  return TomlTable(node);
}

TomlTable TomlTable::FromFile(const std::string& file) {
  std::error_code ignored;
  if (std::filesystem::is_directory(file, ignored))
    throw InputError(fmt::format("{}: is a folder, allowed: a TOML file", file));
  const std::string text = ReadFile(file, kLargestFile + 1);
  NoteInput(file);
  if (text.size() > kLargestFile)
    throw InputError(fmt::format("{}: is larger than 16 MiB, allowed: a TOML file", file));
  return FromText(text, file);
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

double TomlTable::NumberOr(std::string_view key, double fallback, double* sd,
                           double* true_value) const {
  if (sd) *sd = 0;
  const toml::node* n = node_->Get(key);
  if (!n) return fallback;
  if (const auto* t = n->as_table()) {
    for (const auto& [k, v] : *t)
      if (k.str() != "value" && k.str() != "sd" && !(true_value && k.str() == "fitted"))
        throw InputError(fmt::format("{}.{}: unknown key, allowed: value, sd{}", Where(key),
                                     k.str(), true_value ? ", fitted" : ""));
    const auto* value = t->get("value");
    if (!value || !value->is_number())
      Fail(key,
           fmt::format("= {}, allowed: a number or {{ value = number, sd = number }}", TextOf(*n)));
    if (const auto* s = t->get("sd")) {
      if (!s->is_number() || !(NumberOf(*s) >= 0) || !std::isfinite(NumberOf(*s)))
        throw InputError(
            fmt::format("{}.sd = {}, allowed: a number of 0 or more", Where(key), TextOf(*s)));
      if (sd) *sd = NumberOf(*s);
    }
    if (const auto* f = t->get("fitted"); f && true_value) {
      if (!f->is_number() || !std::isfinite(NumberOf(*f)))
        throw InputError(fmt::format("{}.fitted = {}, allowed: a number", Where(key), TextOf(*f)));
      *true_value = NumberOf(*f);
    }
    n = value;
  }
  if (!n->is_number())
    throw InputError(
        fmt::format("{} = {} is {}, allowed: a number", Where(key), TextOf(*n), TypeName(*n)));
  const double v = NumberOf(*n);
  if (std::isnan(v)) Fail(key, "= nan, allowed: a number");
  return v;
}

double TomlTable::Number(std::string_view key) const {
  if (!Has(key)) Fail(key, "is missing, allowed: a number");
  return Number(key, 0, nullptr);
}
double TomlTable::Number(std::string_view key, double fallback) const {
  return Number(key, fallback, nullptr);
}
double TomlTable::Number(std::string_view key, double fallback, double* sd) const {
  const double v = NumberOr(key, fallback, sd);
  if (Has(key) && std::isinf(v) && !std::isinf(fallback))
    Fail(key, fmt::format("= {}, allowed: a finite number", v));
  return v;
}

long long TomlTable::Integer(std::string_view key, long long fallback) const {
  const toml::node* n = node_->Get(key);
  if (!n) return fallback;
  const double v = n->is_number() ? NumberOf(*n) : kRequired;
  if (v != std::floor(v) || !(std::abs(v) <= 9e15))
    throw InputError(fmt::format("{} = {}, allowed: an integer", Where(key), TextOf(*n)));
  return static_cast<long long>(v);
}

bool TomlTable::Bool(std::string_view key, bool fallback) const {
  const toml::node* n = node_->Get(key);
  if (!n) return fallback;
  if (!n->is_boolean())
    throw InputError(
        fmt::format("{} = {} is {}, allowed: true or false", Where(key), TextOf(*n), TypeName(*n)));
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
    throw InputError(
        fmt::format("{} = {} is {}, allowed: a string", Where(key), TextOf(*n), TypeName(*n)));
  const std::string text = n->value<std::string>().value();
  // A zero byte would end a file name half-way, a control character break a message's one line.
  for (const char c : text)
    if (static_cast<unsigned char>(c) < 32 && c != '\t' && c != '\n' && c != '\r')
      Fail(key, fmt::format("holds the control character {}, allowed: printable text",
                            static_cast<int>(c)));
  return text;
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

void TomlTable::RejectMisspelt(std::string_view key) const {
  for (const auto& [k, v] : *node_->table) {
    const std::string given(k.str());
    if (!node_->asked.contains(given) && !Nearest(given, std::string(key)).empty())
      throw InputError(
          fmt::format("{}: unknown key, did you mean {}? allowed: {}", Where(given), key, key));
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
