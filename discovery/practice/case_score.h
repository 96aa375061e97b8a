#pragma once
/// Answers against findings: how often explain is right, and what it takes for what.
#include <array>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace ambrig {

/// (effect, target)
using NamedEffect = std::pair<std::string, std::string>;

/// What a case hides: one slot per effect present, each with the answers that count as right.
struct Answer {
  std::vector<std::string> verdicts;
  std::vector<std::vector<NamedEffect>> slots;
};

/// What was said about it.
struct Finding {
  std::string verdict;
  NamedEffect first;  // of the ranking; empty names: none
  std::vector<NamedEffect> adopted;
  double nominal_ratio = 0, final_ratio = 0, seconds = 0;
};

struct CaseScore {
  std::string name;
  Answer answer;
  Finding finding;
  bool verdict_right = false;
  bool first_right = false;  // the first of the ranking is one of the effects present
  std::size_t found = 0;     // slots that an adopted effect fills
  std::size_t invented = 0;  // adopted effects that fill none
  bool right() const { return verdict_right && found == answer.slots.size() && invented == 0; }
};

CaseScore ScoreCase(const std::string& name, const Answer& answer, const Finding& finding);

/// Cases of one kind (single effect, two effects, none, ...): how many, how many right.
struct Tally {
  std::string kind;
  std::size_t cases = 0, right = 0;
};
std::vector<Tally> Tallies(const std::vector<CaseScore>& all);

/// Confusion matrix: rows what was hidden, columns what was found first ("none", "parameters",
/// "unknown" without one), counts.
std::map<std::string, std::map<std::string, int>> Confusion(const std::vector<CaseScore>& all);

/// Answers of a file in the form of docs/guide/files.md (answers), by case.
/// @throws InputError
std::map<std::string, Answer> ReadAnswers(const std::string& file);

/// The slots as such a file writes them: lines between "effects = [" and "]".
std::string SlotsText(const std::vector<std::vector<NamedEffect>>& slots);

}  // namespace ambrig
