#include <fmt/format.h>

#include "core/base/toml_node.h"

namespace ambrig {

namespace {

constexpr int kDeepest = 32;  // names in one dotted key; nested values toml++ itself limits to 256

/// The text with its place, outside of strings and comments.
class KeyScanner {
 public:
  KeyScanner(const std::string& text, const std::string& file) : text_(text), file_(file) {}

  void Scan() {
    for (at_ = 0; at_ < text_.size(); ++at_) {
      const char c = text_[at_];
      if (c == '"' || c == '\'')
        SkipString(c);
      else if (c == '#')
        at_ = std::min(text_.find('\n', at_), text_.size()) - 1;
      else if (c == '.')
        Deeper();
      else if (std::string_view("\n,=[]{}").find(c) != std::string_view::npos)
        NewKey(c);
    }
  }

 private:
  void NewKey(char c) {
    dots_ = 0;
    if (c == '\n') ++line_;
  }

  void Deeper() {
    if (++dots_ >= kDeepest)
      throw InputError(
          fmt::format("{}:{}: not valid TOML: a key of more than {} names, allowed: up to {}",
                      file_, line_, kDeepest, kDeepest));
  }

  /// From the opening quote to the closing one; a string that does not end is the parser's to
  /// report.
  void SkipString(char quote) {
    const bool many_lines = text_.compare(at_, 3, std::string(3, quote)) == 0;
    const std::string end(many_lines ? 3 : 1, quote);
    for (at_ += end.size(); at_ < text_.size() && text_.compare(at_, end.size(), end) != 0; ++at_) {
      if (text_[at_] == '\\' && quote == '"') ++at_;
      if (at_ >= text_.size() || text_[at_] != '\n') continue;
      ++line_;
      if (!many_lines) return;
    }
    at_ += end.size() - 1;
  }

  const std::string& text_;
  const std::string& file_;
  std::size_t at_ = 0;
  int line_ = 1, dots_ = 0;
};

}  // namespace

void RejectDeepKeys(const std::string& text, const std::string& file) {
  KeyScanner(text, file).Scan();
}

}  // namespace ambrig
