#pragma once
/// The door to muParser: a scalar expression over named values. Nobody else includes muParser.
#include <memory>
#include <string>
#include <vector>

namespace ambrig {

/// A formula that has been read once and is evaluated often. Not for two threads at once.
class FormulaExpression {
 public:
  /// @throws InputError "WHERE = \"text\": what is wrong, where; allowed names".
  FormulaExpression(const std::string& text, const std::vector<std::string>& names,
                    const std::string& where);
  ~FormulaExpression();
  FormulaExpression(FormulaExpression&&) noexcept;

  /// Values in the order of the names.
  double operator()(const double* values) const;

 private:
  struct Inside;
  std::unique_ptr<Inside> inside_;
};

/// Functions and constants that every formula knows, comma separated.
const std::string& FormulaFunctions();
/// A name that a parameter may have: letters, digits, _, not one of the functions.
bool IsFormulaName(const std::string& name);

}  // namespace ambrig
