#include "effects/formula_parser.h"

#include <fmt/format.h>
#include <muParser.h>

#include <algorithm>
#include <bit>
#include <cctype>
#include <cmath>
#include <cstdint>

#include "core/base/errors.h"
#include "core/math/constants.h"

namespace ambrig {

struct FormulaExpression::Inside {
  mu::Parser parser;
  std::vector<double> values;      // bound by address: never resized
  std::vector<std::size_t> reads;  // places of the values that the formula has in it
  double result = 0;               // of the values as they stand
};

namespace {

std::string Joined(const std::vector<std::string>& names) {
  std::string all;
  for (const auto& n : names) all += (all.empty() ? "" : ", ") + n;
  return all;
}

/// Assignments and lists are muParser's own extras; a law has neither.
std::string Forbidden(const std::string& text) {
  int depth = 0;
  for (std::size_t k = 0; k < text.size(); ++k) {
    if (text[k] == '(') ++depth;
    if (text[k] == ')') --depth;
    if (text[k] == ',' && depth == 0) return "one formula is allowed, not a list";
    if (text[k] != '=') continue;
    const bool second = k > 0 && std::string("=<>!").find(text[k - 1]) != std::string::npos;
    const bool first = k + 1 < text.size() && text[k + 1] == '=';
    if (!second && !first) return "\"=\" assigns; compare with \"==\"";
  }
  return "";
}

double Sign(double v) { return v > 0 ? 1 : (v < 0 ? -1 : 0); }

std::string Reason(const mu::Parser::exception_type& e, const std::vector<std::string>& names) {
  switch (e.GetCode()) {
    case mu::ecUNASSIGNABLE_TOKEN: {
      const std::string near = Nearest(e.GetToken(), Joined(names) + ", " + FormulaFunctions());
      return fmt::format("unknown name \"{}\"{}; known: {}; functions: {}", e.GetToken(),
                         near.empty() ? "" : fmt::format(", did you mean {}?", near), Joined(names),
                         FormulaFunctions());
    }
    case mu::ecEMPTY_EXPRESSION:
      return "is empty, allowed: a formula such as \"-k * x\"";
    case mu::ecUNEXPECTED_EOF:
      return "ends too early";
    case mu::ecMISSING_PARENS:
      return "a closing parenthesis is missing";
    default: {
      std::string text = e.GetMsg();
      std::replace(text.begin(), text.end(), '\n', ' ');
      return text;
    }
  }
}

}  // namespace

const std::string& FormulaFunctions() {
  static const std::string all =
      "abs, acos, acosh, asin, asinh, atan, atan2, atanh, avg, cos, cosh, exp, ln, log, log10, "
      "log2, max, "
      "min, pi, rint, sign, sin, sinh, sqrt, sum, tan, tanh";
  return all;
}

bool IsFormulaName(const std::string& name) {
  if (name.empty() || std::isdigit(static_cast<unsigned char>(name[0]))) return false;
  for (char c : name)
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '_') return false;
  return (", " + FormulaFunctions() + ",").find(", " + name + ",") == std::string::npos;
}

FormulaExpression::FormulaExpression(const std::string& text, const std::vector<std::string>& names,
                                     const std::string& where)
    : inside_(std::make_unique<Inside>()) {
  mu::Parser& parser = inside_->parser;
  inside_->values.assign(names.size(), 0.0);
  const auto fail = [&](const std::string& why) {
    constexpr std::size_t kShown = 80;  // characters: a formula may be longer than a message
    const std::string shown = text.size() > kShown ? text.substr(0, kShown) + "..." : text;
    throw InputError(fmt::format("{} = \"{}\": {}", where, shown, why));
  };
  if (const std::string why = Forbidden(text); !why.empty()) fail(why);
  try {
    parser.ClearConst();
    parser.DefineConst("pi", kPi);
    parser.DefineFun("sign", Sign);
    for (std::size_t k = 0; k < names.size(); ++k) parser.DefineVar(names[k], &inside_->values[k]);
    parser.SetExpr(text);
    inside_->result = parser.Eval();
    for (const auto& [name, value] : parser.GetUsedVar())
      inside_->reads.push_back(static_cast<std::size_t>(value - inside_->values.data()));
  } catch (const mu::Parser::exception_type& e) {
    fail(Reason(e, names));
  }
}

FormulaExpression::~FormulaExpression() = default;
FormulaExpression::FormulaExpression(FormulaExpression&&) noexcept = default;

double FormulaExpression::operator()(const double* values) const {
  // an integrator asks several times at one instant and angle
  bool same = true;
  for (const std::size_t k : inside_->reads) {
    same = same && std::bit_cast<std::uint64_t>(inside_->values[k]) ==
                       std::bit_cast<std::uint64_t>(values[k]);
    inside_->values[k] = values[k];
  }
  if (!same) inside_->result = inside_->parser.Eval();
  return inside_->result;
}

}  // namespace ambrig
