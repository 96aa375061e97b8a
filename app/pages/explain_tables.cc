#include "app/pages/explain_tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <set>

#include "app/text/format.h"
#include "discovery/decision/second_round.h"

namespace ambrig {

std::string OneLine(std::string text) {
  std::ranges::replace(text, '\n', ' ');
  return text;
}

namespace {

bool Adopted(const Explanation& e, const EffectInstance& effect) {
  return std::ranges::any_of(e.adopted,
                             [&](const EffectInstance& a) { return IsSameName(a, effect); });
}

std::string SecondCaption(const Explanation& e) {
  std::string beside;
  for (const std::string& name : e.second_beside) beside += (beside.empty() ? "" : " and ") + name;
  return fmt::format("Candidates for one more effect beside {}. {}",
                     beside.empty() ? "what was found before" : beside,
                     SecondRoundAdopted(e)
                         ? "The green one met the acceptance criterion as well."
                         : "None meets the acceptance criterion; the improvement may be due to "
                           "overfitting, and none has a probability.");
}

void RankingTable(HtmlReport& report, const std::vector<RankedEffect>& ranking,
                  const Explanation& e, bool first_round, bool unseen) {
  const bool shapes =
      std::ranges::any_of(ranking, [](const auto& r) { return r.shaped.has_value(); });
  std::vector<std::vector<Cell>> rows;
  for (std::size_t k = 0; k < ranking.size(); ++k) {
    const RankedEffect& r = ranking[k];
    std::vector<Cell> row = {fmt::format("{}", k + 1),
                             Cell(EffectName(r.effect), Adopted(e, r.effect) ? "ok" : ""),
                             fmt::format("{:.1f} %", 100 * r.probability)};
    if (first_round) row.push_back(fmt::format("{:.3f}", e.base_ratio_validate));
    const bool held = std::isfinite(r.fit.ratio_fit);
    row.insert(row.end(), {held ? fmt::format("{:.3f}", r.fit.ratio_validate) : "loses the rotor",
                           held ? fmt::format("{:.3f}", r.fit.ratio_fit) : "–"});
    if (shapes)
      row.push_back(r.shaped ? fmt::format("{:.3f} / {:.3f}", r.shaped->validate, r.shaped->fit)
                             : "");
    row.push_back(ParametersText(r.effect));
    rows.push_back(row);
  }
  std::vector<std::string> columns = {"", "effect", "probability"};
  const std::string of = unseen ? "unseen" : "all";
  if (first_round) columns.push_back(of + ", before");
  columns.insert(columns.end(),
                 {of + (first_round ? ", with it" : ", with it too"), "fitted, with it"});
  if (shapes) columns.push_back(of + " / fitted, free shape");
  columns.push_back("parameters ± sd");
  report.Table(columns, rows,
               first_round
                   ? std::string("Candidates fitted in full, best first. *Before*: rig parameters "
                                 "fitted, no effect. Probabilities are relative to these "
                                 "candidates, with a penalty per parameter.") +
                         (shapes ? " *Free shape*: with the shape of its law fitted too "
                                   "(`ambrig refine`); that error counts for the name."
                                 : "") +
                         (e.verdict == ExplanationVerdict::kUnknown
                              ? " No candidate met the acceptance criterion: "
                                "the best one leaves too large a residual."
                              : "")
                   : SecondCaption(e));
}

void AboutEffect(HtmlReport& report, const RankedEffect& r, std::set<std::string>& told) {
  const EffectDescription* d = FindEffect(r.effect.name);
  if (!d || !told.insert(d->id).second) return;
  std::string text = fmt::format("**{}** (`{}`). {}", d->title, d->id, OneLine(d->physics));
  if (!d->shows_in.empty()) text += fmt::format("\n\n- Shows in: {}", d->shows_in);
  if (!d->confused_with.empty())
    text += fmt::format("\n- Easily confused with: {}", d->confused_with);
  report.Text(text);
}

}  // namespace

void AddRanking(HtmlReport& report, const Explanation& e, bool unseen) {
  report.Heading("Ranked candidates");
  if (e.ranking.empty()) {
    report.Text(
        e.verdict == ExplanationVerdict::kNone || e.verdict == ExplanationVerdict::kParameters
            ? "None was fitted: nothing was left to explain once the rig parameters were adjusted."
            : "None could be fitted to these records.");
    return;
  }
  RankingTable(report, e.ranking, e, true, unseen);
  if (!e.second_round.empty()) RankingTable(report, e.second_round, e, false, unseen);
  report.Heading("Description of these effects", 3);
  std::set<std::string> told;
  for (const RankedEffect& r : e.ranking) AboutEffect(report, r, told);
  if (!e.second_round.empty()) AboutEffect(report, e.second_round.front(), told);
}

namespace {

std::vector<std::vector<Cell>> AddedRows(const std::vector<EffectInstance>& adopted) {
  std::vector<std::vector<Cell>> rows;
  for (const EffectInstance& a : adopted)
    for (std::size_t k = 0; k < a.table.size(); ++k) {
      const EffectParameter& p = a.table[k];
      const double sd = k < a.sd.size() ? a.sd[k] : 0,
                   away = std::isfinite(p.null_value) && p.has_null && sd > 0
                              ? std::abs(a.values[k] - p.null_value) / sd
                              : 0;
      const std::string usual = p.typical_hi != 0 ? FormatSi(p.typical_lo, p.unit) + " to " +
                                                        FormatSi(p.typical_hi, p.unit)
                                                  : "";
      rows.push_back({k == 0 ? EffectName(a) : "", p.name, ValueText(a.values[k], sd, p.unit),
                      away > 0 ? fmt::format("{:.0f} sd", away) : "", Cell(usual, "muted"), p.doc});
    }
  return rows;
}

std::vector<std::vector<Cell>> ShiftRows(const FitResult& fit) {
  std::vector<std::vector<Cell>> rows;
  for (std::size_t k = 0; k < fit.hypothesis.free.size(); ++k) {
    const FreeParameter& p = fit.hypothesis.free[k];
    if (p.effect >= 0) continue;
    const double shift = p.sd > 0 ? (p.value - p.start) / p.sd : 0,
                 sd = k < fit.sd.size() ? fit.sd[k] : 0;
    double lo = 0, hi = 0;
    std::string unit;
    ParameterRange(fit.hypothesis.rig, p.path, &lo, &hi, &unit);
    rows.push_back({p.path, ValueText(p.start, p.sd, unit), ValueText(p.value, sd, unit),
                    Cell(fmt::format("{:+.2f} sd", shift), std::abs(shift) > 2.5 ? "warn" : "")});
  }
  return rows;
}

std::string FarShifts(const FitResult& fit) {
  std::string out;
  for (const FreeParameter& p : fit.hypothesis.free) {
    const double shift = p.effect < 0 && p.sd > 0 ? (p.value - p.start) / p.sd : 0;
    if (std::abs(shift) > 2.5)
      out += fmt::format("{}{} ({:+.1f} sd)", out.empty() ? "" : ", ", p.path, shift);
  }
  return out;
}

}  // namespace

void AddCost(HtmlReport& report, const Explanation& e) {
  const auto added = AddedRows(e.adopted), shifts = ShiftRows(e.final_fit);
  if (added.empty() && shifts.empty()) return;
  report.Heading("Penalty of the accepted effect");
  if (!added.empty()) {
    report.Text(
        fmt::format("{} more number{} in the model. A value many sd from the one that switches the "
                    "effect off is well seen; one within 2 sd is not.",
                    added.size(), added.size() == 1 ? "" : "s"));
    report.Table({"effect", "parameter", "value ± sd", "from off", "usual size", "meaning"}, added);
  }
  if (shifts.empty()) return;
  double squares = 0, n = 0;
  for (const FreeParameter& p : e.final_fit.hypothesis.free)
    if (p.effect < 0 && p.sd > 0) squares += std::pow((p.value - p.start) / p.sd, 2), n += 1;
  report.Text(
      fmt::format("The rig's toleranced parameters moved by {:.2f} sd rms (1 is what their "
                  "tolerances promise). An explanation that needs a parameter "
                  "three sd away is a warning: it may hide a second effect.",
                  n > 0 ? std::sqrt(squares / n) : 0));
  if (const std::string far = FarShifts(e.final_fit); !far.empty())
    report.Verdict(Verdict::kWarn,
                   "**Beyond their tolerances here: " + far +
                       ".** Measure them, or look for another effect that they compensate.");
  report.Table({"rig parameter", "rig file ± tolerance", "fitted ± sd", "shift"}, shifts);
}

namespace {

bool Known(const std::string& word) {
  static const std::set<std::string> kKnown = {
      "x",   "y",   "vx",  "vy",  "theta", "omega", "t",     "bus",     "i1",      "i2",
      "i3",  "i4",  "i5",  "i6",  "i7",    "i8",    "force", "reading", "voltage", "torque",
      "sin", "cos", "tan", "exp", "log",   "sqrt",  "abs",   "min",     "max",     "sign"};
  return kKnown.contains(word);
}

/// Identifiers of the law that it does not know: parameters. Words behind # do not count.
std::vector<std::string> FreeLetters(const std::string& law) {
  std::vector<std::string> out;
  const std::string text = law.substr(0, law.find('#'));
  for (std::size_t k = 0; k < text.size();) {
    const auto c = static_cast<unsigned char>(text[k]);
    if (!std::isalpha(c)) {
      // "1e-05" is a number, not a parameter called e.
      if (std::isdigit(c))
        while (k < text.size() &&
               (std::isalnum(static_cast<unsigned char>(text[k])) || text[k] == '.' ||
                ((text[k] == '-' || text[k] == '+') && text[k - 1] == 'e')))
          ++k;
      else
        ++k;
      continue;
    }
    std::size_t end = k;
    while (end < text.size() &&
           (std::isalnum(static_cast<unsigned char>(text[end])) || text[end] == '_'))
      ++end;
    const std::string word = text.substr(k, end - k);
    if (!Known(word) && std::ranges::find(out, word) == out.end()) out.push_back(word);
    k = end;
  }
  return out;
}

struct Guess {
  double value, lo, hi;
  const char* unit;
};

/// Where a fit of this letter may start, by the meaning it has in the suggested laws.
Guess GuessOf(const std::string& letter, const std::string& dependence) {
  const bool contact = dependence.find("one side") != std::string::npos;
  if (letter == "mu") return {0.1, 0, 1, "-"};
  if (letter == "k3") return {1e10, -1e16, 1e16, "N/m^3"};
  if (letter == "c" && contact) return {2e-5, 0, 5e-4, "m"};
  if (letter == "k") return {1e5, 0, 1e7, "N/m"};
  if (letter.starts_with("k")) return {1e3, -1e6, 1e6, "N/m"};
  if (letter.size() == 3 && letter[0] == 'c') return {10, -1e4, 1e4, "N s/m"};
  return {0.1, -100, 100, "N"};
}

/// "c = 2.3e-05 m" in the law's own comment.
double Hinted(const std::string& law, const std::string& letter, double otherwise) {
  const std::size_t comment = law.find('#');
  const std::size_t at =
      comment == std::string::npos ? comment : law.find(" " + letter + " = ", comment);
  return at == std::string::npos ? otherwise
                                 : std::strtod(law.c_str() + at + letter.size() + 4, nullptr);
}

}  // namespace

std::string FormulaSnippet(const Unexplained& u) {
  const bool plane = u.where.starts_with("plane ");
  const std::string target = plane ? u.where.substr(6, u.where.find_first_of(", ", 6) - 6)
                                   : u.where.substr(0, u.where.find('.'));
  std::string parameters;
  for (const std::string& p : FreeLetters(u.formula)) {
    const Guess g = GuessOf(p, u.dependence);
    // A place or a friction does not switch the force off, its stiffness does.
    const bool switches = std::string(g.unit) != "m" && std::string(g.unit) != "-";
    parameters += fmt::format(
        "parameters.{} = {{ value = {:.3g}{}, min = {:.3g}, max = {:.3g}, unit = \"{}\" }}\n", p,
        Hinted(u.formula, p, g.value), switches ? ", null = 0" : "", g.lo, g.hi, g.unit);
  }
  return fmt::format(
      "[[effect]]\nname = \"formula\"\nlabel = \"what explain described\"\ntarget = \"{}\"\n# "
      "starting values, bounds and units: set them to what you expect\n"
      "{}{}\n",
      target, parameters, u.formula);
}

}  // namespace ambrig
