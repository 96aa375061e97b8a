#include "core/base/errors.h"

#include <algorithm>
#include <sstream>
#include <vector>

namespace ambrig {

namespace {
std::string OneLine(std::string text) {
  for (char& c : text)
    if ((static_cast<unsigned char>(c) < 32 && c != '\t') || c == 127) c = ' ';
  return text;
}
}  // namespace

InputError::InputError(const std::string& text) : std::runtime_error(OneLine(text)) {}

void Require(bool condition, const char* what, std::source_location where) {
  if (condition) return;
  std::ostringstream text;
  text << where.file_name() << ':' << where.line() << ": required: " << what;
  throw std::logic_error(text.str());
}

namespace {
std::size_t EditDistance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t above = row[j];
      row[j] = std::min({above + 1, row[j - 1] + 1, diagonal + (a[i - 1] == b[j - 1] ? 0 : 1)});
      diagonal = above;
    }
  }
  return row[b.size()];
}
}  // namespace

std::string Nearest(const std::string& word, const std::string& comma_separated_allowed) {
  std::istringstream list(comma_separated_allowed);
  std::string entry, best;
  std::size_t best_distance = std::max<std::size_t>(2, word.size() / 2);
  while (std::getline(list, entry, ',')) {
    entry.erase(0, entry.find_first_not_of(' '));
    const std::size_t d = EditDistance(word, entry);
    if (d <= best_distance && (best.empty() || d < best_distance)) {
      best_distance = d;
      best = entry;
    }
  }
  return best;
}

}  // namespace ambrig
