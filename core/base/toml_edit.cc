#include "core/base/toml_edit.h"

#include <fmt/format.h>

#include <charconv>
#include <filesystem>
#include <sstream>

#include "core/base/errors.h"
#include "core/base/toml_node.h"

namespace ambrig {

namespace {

struct Step {
  std::string key;
  long index = -1;  // in an array of tables, the last one in a list of numbers; -1: none
};

[[noreturn]] void Fail(const std::string& file, const TomlEdit& e, const char* what) {
  throw InputError(
      fmt::format("{}: {}: {}, allowed: the path of a number such as controller.kp or "
                  "controller.filter[0].frequency",
                  file, e.path, what));
}

std::vector<Step> StepsOf(const std::string& file, const TomlEdit& e) {
  std::vector<Step> steps;
  std::istringstream in(e.path);
  std::string part;
  while (std::getline(in, part, '.')) {
    Step s;
    const std::size_t open = part.find('[');
    s.key = part.substr(0, open);
    if (open != std::string::npos) {
      const char *begin = part.data() + open + 1, *last = part.data() + part.size() - 1;
      const auto [end, error] = std::from_chars(begin, last, s.index);
      if (error != std::errc{} || end != last || *last != ']' || s.index < 0)
        Fail(file, e, "is no path");
    }
    if (s.key.empty()) Fail(file, e, "is no path");
    steps.push_back(s);
  }
  if (steps.empty()) Fail(file, e, "is no path");
  return steps;
}

/// The table that holds the path's last key.
toml::table& Holder(toml::table& root, const std::string& file, const TomlEdit& e,
                    const std::vector<Step>& steps) {
  toml::table* at = &root;
  for (std::size_t k = 0; k + 1 < steps.size(); ++k) {
    toml::node* next = at->get(steps[k].key);
    if (next && steps[k].index >= 0)
      next = next->is_array() ? next->as_array()->get(static_cast<std::size_t>(steps[k].index))
                              : nullptr;
    if (!next || !next->is_table()) Fail(file, e, "goes through a table that is not there");
    at = next->as_table();
  }
  return *at;
}

/// What the last step names: the value of a key or an element of its list; nullptr when there is
/// none.
toml::node* Named(toml::table& holder, const Step& last) {
  toml::node* found = holder.get(last.key);
  if (!found || last.index < 0) return found;
  return found->is_array() ? found->as_array()->get(static_cast<std::size_t>(last.index)) : nullptr;
}

void Apply(toml::table& root, const std::string& file, const TomlEdit& e) {
  const std::vector<Step> steps = StepsOf(file, e);
  toml::table* at = &Holder(root, file, e, steps);
  toml::node* old = Named(*at, steps.back());
  if (old && old->is_array()) Fail(file, e, "is a list");
  if (steps.back().index >= 0) {
    if (!old || !old->is_number() || !std::holds_alternative<double>(e.value))
      Fail(file, e, "is no number of a list");
    at->get(steps.back().key)
        ->as_array()
        ->replace(at->get(steps.back().key)->as_array()->cbegin() + steps.back().index,
                  std::get<double>(e.value));
    return;
  }
  if (std::holds_alternative<std::string>(e.value)) {
    at->insert_or_assign(steps.back().key, std::get<std::string>(e.value));
  } else if (old && old->is_table() && old->as_table()->contains("value")) {
    old->as_table()->insert_or_assign("value", std::get<double>(e.value));
  } else {
    if (old && !old->is_number()) Fail(file, e, "is no number");
    at->insert_or_assign(steps.back().key, std::get<double>(e.value));
  }
}

void MakeFilesAbsolute(toml::node& node, const std::filesystem::path& folder) {
  if (toml::array* a = node.as_array())
    for (toml::node& child : *a) MakeFilesAbsolute(child, folder);
  toml::table* t = node.as_table();
  if (!t) return;
  for (auto&& [key, child] : *t) {
    if (key.str() == "file" && child.is_string()) {
      const std::filesystem::path name = child.as_string()->get();
      if (name.is_relative()) *child.as_string() = (folder / name).lexically_normal().string();
    } else {
      MakeFilesAbsolute(child, folder);
    }
  }
}

}  // namespace

std::string EditedToml(const std::string& text, const std::string& file,
                       const std::vector<TomlEdit>& edits) {
  toml::table root = ParseToml(text, file);
  for (const TomlEdit& e : edits) Apply(root, file, e);
  MakeFilesAbsolute(root, std::filesystem::absolute(file).parent_path());
  std::ostringstream out;
  out << toml::toml_formatter(
             root, toml::toml_formatter::default_flags & ~toml::format_flags::allow_literal_strings)
      << '\n';
  return out.str();
}

double TomlNumberAt(const std::string& text, const std::string& file, const std::string& path) {
  const TomlEdit e{path, 0.0};
  toml::table root = ParseToml(text, file);
  const std::vector<Step> steps = StepsOf(file, e);
  const toml::node* found = Named(Holder(root, file, e, steps), steps.back());
  if (found && found->is_table()) found = found->as_table()->get("value");
  if (!found || !found->is_number()) Fail(file, e, "is no number of this file");
  return NumberOf(*found);
}

}  // namespace ambrig
