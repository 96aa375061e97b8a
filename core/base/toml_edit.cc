#include "core/base/toml_edit.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <sstream>

#include "core/base/errors.h"
#include "core/base/toml_node.h"
#include "core/base/toml_place.h"

namespace ambrig {

namespace {

struct Step {
  std::string key;
  long index = -1;  // in an array of tables, the last one in a list of numbers; -1: none
};

[[noreturn]] void Fail(const std::string& file, const std::string& path, const char* what) {
  throw InputError(
      fmt::format("{}: {}: {}, allowed: the path of a number such as controller.kp or "
                  "controller.filter[0].frequency",
                  file, path, what));
}

std::vector<Step> StepsOf(const std::string& file, const std::string& path) {
  std::vector<Step> steps;
  std::istringstream in(path);
  std::string part;
  while (std::getline(in, part, '.')) {
    Step s;
    const std::size_t open = part.find('[');
    s.key = part.substr(0, open);
    if (open != std::string::npos) {
      const char *begin = part.data() + open + 1, *last = part.data() + part.size() - 1;
      const auto [end, error] = std::from_chars(begin, last, s.index);
      if (error != std::errc{} || end != last || *last != ']' || s.index < 0)
        Fail(file, path, "is no path");
    }
    if (s.key.empty()) Fail(file, path, "is no path");
    steps.push_back(s);
  }
  if (steps.empty()) Fail(file, path, "is no path");
  return steps;
}

/// What a step names in a table: the value of a key or an element of its list; nullptr when there
/// is none.
const toml::node* Named(const toml::table& holder, const Step& step) {
  const toml::node* found = holder.get(step.key);
  if (!found || step.index < 0) return found;
  return found->is_array() ? found->as_array()->get(static_cast<std::size_t>(step.index)) : nullptr;
}

/// The tables on the way to the path's last key, the root first; shorter than the path when one is
/// not there.
std::vector<const toml::table*> Way(const toml::table& root, const std::vector<Step>& steps) {
  std::vector<const toml::table*> way = {&root};
  for (std::size_t k = 0; k + 1 < steps.size(); ++k) {
    const toml::node* next = Named(*way.back(), steps[k]);
    if (!next || !next->is_table()) break;
    way.push_back(next->as_table());
  }
  return way;
}

/// One edit of one document.
class Editor {
 public:
  Editor(const std::string& text, const std::string& file, const std::string& path)
      : text_(text),
        file_(file),
        path_(path),
        root_(ParseToml(text, file)),
        places_(text),
        steps_(StepsOf(file, path)),
        way_(Way(root_, steps_)) {}

  bool complete() const { return way_.size() == steps_.size(); }
  const toml::table& holder() const {
    if (!complete()) Fail(file_, path_, "goes through a table that is not there");
    return *way_.back();
  }
  const toml::node* target() const { return Named(holder(), steps_.back()); }

  std::string Edited(const TomlEdit& e) const {
    const toml::node* old = target();
    if (!old && steps_.back().index >= 0) Fail(file_, path_, "is no number of a list");
    if (const auto* number = std::get_if<double>(&e.value)) return WithNumber(old, *number);
    if (old && places_.HasHeader(*old)) Fail(file_, path_, "is a table");
    if (const auto* literal = std::get_if<TomlLiteral>(&e.value)) return With(old, literal->text);
    if (old && (old->is_array() || old->is_table())) Fail(file_, path_, "is no single value");
    return With(old, Quoted(std::get<std::string>(e.value)));
  }

  std::string Without() const {
    const toml::node* old = target();
    if (!old || !places_.HasHeader(*old)) Fail(file_, path_, "is no table with a header");
    std::vector<TomlSpan> blocks = places_.Blocks(*old);
    std::ranges::sort(blocks, {}, &TomlSpan::begin);
    std::string out = text_;
    for (auto block = blocks.rbegin(); block != blocks.rend(); ++block)
      out.erase(block->begin, block->end - block->begin);
    return out;
  }

  static std::string Quoted(const std::string& text) {
    std::ostringstream out;
    out << toml::toml_formatter(
        toml::value(text),
        toml::toml_formatter::default_flags & ~(toml::format_flags::allow_literal_strings |
                                                toml::format_flags::allow_multi_line_strings));
    return out.str();
  }

 private:
  std::string WithNumber(const toml::node* old, double value) const {
    if (old && old->is_array()) Fail(file_, path_, "is a list");
    if (old && old->is_table() && old->as_table()->contains("value"))
      old = old->as_table()->get("value");
    if (old && !old->is_number()) Fail(file_, path_, "is no number");
    return With(old, TomlNumber(value));
  }

  /// `written` in place of `old`, or as the value of a key that is new.
  std::string With(const toml::node* old, const std::string& written) const {
    if (!old) return WithNewKey(written);
    const TomlSpan span = places_.Of(*old);
    return text_.substr(0, span.begin) + written + text_.substr(span.end);
  }

  std::string WithNewKey(const std::string& written) const {
    if (holder().is_inline()) return WithKeyInline(written);
    // A table by dotted keys stands under the header of a table around it.
    std::size_t k = way_.size() - 1;
    while (k > 0 && !places_.HasHeader(*way_[k])) --k;
    std::string key;
    for (std::size_t s = k; s < steps_.size(); ++s) key += (s > k ? "." : "") + steps_[s].key;
    const std::string line = key + " = " + written + '\n';
    if (k > 0 && HeaderIsOfAnother(k)) return text_ + "\n[" + HeaderOf(k) + "]\n" + line;
    const TomlSpan last = k == 0 ? places_.LastOfRoot(root_) : places_.LastOf(*way_[k]);
    const std::size_t at = last.end == 0 ? places_.Top() : places_.NextLine(last.end - 1);
    const std::string indentation = last.end == 0 ? "" : places_.Indentation(last.begin);
    const bool ended = at == 0 || text_[at - 1] == '\n';
    return text_.substr(0, at) + (ended ? "" : "\n") + indentation + line + text_.substr(at);
  }

  std::string WithKeyInline(const std::string& written) const {
    const std::string entry = steps_.back().key + " = " + written;
    const toml::table& table = holder();
    const TomlSpan all = places_.Of(table);
    if (table.empty())
      return text_.substr(0, all.begin) + "{ " + entry + " }" + text_.substr(all.end);
    std::size_t end = all.begin;
    for (auto&& [key, child] : table) end = std::max(end, places_.Of(child).end);
    return text_.substr(0, end) + ", " + entry + text_.substr(end);
  }

  std::string HeaderOf(std::size_t k) const {
    std::string out;
    for (std::size_t s = 0; s < k; ++s) {
      if (steps_[s].index >= 0) Fail(file_, path_, "is in a table without a header of its own");
      out += (s > 0 ? "." : "") + steps_[s].key;
    }
    return out;
  }

  /// [a.b] makes a table a that has no header of its own.
  bool HeaderIsOfAnother(std::size_t k) const {
    const TomlSpan span = places_.Of(*way_[k]);
    const toml::table header = ParseToml(text_.substr(span.begin, span.end - span.begin), file_);
    std::size_t depth = 0;
    for (const toml::node* at = &header; at;) {
      if (const toml::array* a = at->as_array()) at = a->get(0);
      const toml::table* t = at->as_table();
      if (t->empty()) break;
      at = &t->begin()->second;
      ++depth;
    }
    return depth != k;
  }

  const std::string &text_, &file_, &path_;
  toml::table root_;
  TomlPlaces places_;
  std::vector<Step> steps_;
  std::vector<const toml::table*> way_;
};

/// Strings under a key `file` or `commissioning`, anywhere in the document.
void FindFiles(const toml::node& node, std::vector<const toml::node*>& out) {
  if (const toml::array* a = node.as_array())
    for (const toml::node& child : *a) FindFiles(child, out);
  const toml::table* t = node.as_table();
  if (!t) return;
  for (auto&& [key, child] : *t) {
    const bool learnt = key.str() == "commissioning" && child.value_or(std::string()) != "none";
    if ((key.str() == "file" || learnt) && child.is_string())
      out.push_back(&child);
    else
      FindFiles(child, out);
  }
}

}  // namespace

std::string EditedToml(const std::string& text, const std::string& file,
                       const std::vector<TomlEdit>& edits) {
  if (edits.empty()) ParseToml(text, file);
  std::string out = text;
  for (const TomlEdit& e : edits) out = Editor(out, file, e.path).Edited(e);
  return out;
}

std::string WithoutTomlTable(const std::string& text, const std::string& file,
                             const std::string& path) {
  return Editor(text, file, path).Without();
}

std::string WithAbsoluteFiles(const std::string& text, const std::string& file) {
  const toml::table root = ParseToml(text, file);
  const TomlPlaces places(text);
  std::vector<const toml::node*> names;
  FindFiles(root, names);
  std::vector<std::pair<TomlSpan, std::string>> changes;
  const std::filesystem::path folder = std::filesystem::absolute(file).parent_path();
  for (const toml::node* node : names) {
    const std::filesystem::path name = node->as_string()->get();
    if (name.is_relative())
      changes.emplace_back(places.Of(*node),
                           Editor::Quoted((folder / name).lexically_normal().string()));
  }
  std::ranges::sort(changes, std::greater{}, [](const auto& c) { return c.first.begin; });
  std::string out = text;
  for (const auto& [span, written] : changes)
    out.replace(span.begin, span.end - span.begin, written);
  return out;
}

bool HasTomlPath(const std::string& text, const std::string& file, const std::string& path) {
  const Editor editor(text, file, path);
  return editor.complete() && editor.target() != nullptr;
}

double TomlNumberAt(const std::string& text, const std::string& file, const std::string& path) {
  const Editor editor(text, file, path);
  const toml::node* found = editor.target();
  if (found && found->is_table()) found = found->as_table()->get("value");
  if (!found || !found->is_number()) Fail(file, path, "is no number of this file");
  return NumberOf(*found);
}

std::string TomlNumber(double value) {
  if (std::isnan(value)) return "nan";
  if (std::isinf(value)) return value > 0 ? "inf" : "-inf";
  std::string text = fmt::format("{}", value);
  if (text.find_first_of(".e") == std::string::npos) text += ".0";
  return text;
}

}  // namespace ambrig
