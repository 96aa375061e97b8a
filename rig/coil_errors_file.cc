#include "rig/coil_errors_file.h"

#include <fmt/format.h>

#include "core/base/toml_checked.h"

namespace ambrig {

void ReadCoilErrors(const TomlTable& bearing, BearingParameters& b) {
  b.coil_errors = CoilErrors{};
  const auto t = bearing.Table("coil_errors");
  if (!t) return;
  const auto of_each_coil = [&](const char* key, const Range& range) {
    const std::vector<double> all = AllWithin(*t, key, {}, range);
    if (t->Has(key) && static_cast<int>(all.size()) != b.coils())
      t->Fail(key, fmt::format("has {} numbers, allowed: {}, one for each coil of {}", all.size(),
                               b.coils(), b.name));
    return all;
  };
  b.coil_errors.current_gain =
      of_each_coil("current_gain", {"-", -0.5, 0.5, "error of a current measurement's gain"});
  b.coil_errors.edge = of_each_coil("edge", {"s", -1e-4, 1e-4, "by which a bridge switches late"});
  t->RejectUnknownKeys();
}

}  // namespace ambrig
