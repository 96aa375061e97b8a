#include "campaign/campaign_values.h"

#include <fmt/format.h>

namespace ambrig {

std::vector<double> List(const TomlTable& t, const char* key, const std::vector<double>& fallback,
                         double lo, double hi, const char* unit) {
  const std::vector<double> values =
      t.IsNumber(key) ? std::vector<double>{t.Number(key)} : t.Numbers(key, fallback);
  if (values.empty())
    t.Fail(key, fmt::format("= [], allowed: at least one number from {} to {} {}", lo, hi, unit));
  for (std::size_t k = 0; k < values.size(); ++k) {
    if (!(values[k] >= lo && values[k] <= hi))
      t.Fail(key, fmt::format("= {}, allowed: {} to {} {}", values[k], lo, hi, unit));
    for (std::size_t j = 0; j < k; ++j)
      if (values[j] == values[k])
        t.Fail(key, fmt::format("= {} is given twice, allowed: different values", values[k]));
  }
  return values;
}

double In(const TomlTable& t, const char* key, double fallback, double lo, double hi,
          const char* unit) {
  const double v = t.Number(key, fallback);
  if (!(v >= lo && v <= hi))
    t.Fail(key, fmt::format("= {}, allowed: {} to {} {}", v, lo, hi, unit));
  return v;
}

}  // namespace ambrig
