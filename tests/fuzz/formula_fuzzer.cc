// Formulas over named values; what is read is evaluated once.
#include "effects/formula_parser.h"
#include "tests/fuzz/fuzz_input.h"

using namespace ambrig;  // NOLINT: a program of one function

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return fuzz::TakesOrRefuses([&] {
    const double values[] = {0.5, -2.0, 1e-6};
    FormulaExpression(std::string(fuzz::TextOf(data, size)), {"x", "v", "i"}, "force.x")(values);
  });
}
