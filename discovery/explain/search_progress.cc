#include "discovery/explain/search_progress.h"

#include <fmt/format.h>

#include "core/base/errors.h"

namespace ambrig {

void SearchProgress::operator()(double fraction, const std::string& text) const {
  if (options_.stop && options_.stop->load()) throw Interrupted();
  if (!options_.progress) return;
  options_.progress(fraction, options_.tell_runs
                                  ? fmt::format("{} [{} simulations]", text, models_.runs())
                                  : text);
}

std::function<void(double, const std::string&)> SearchProgress::Part(double from,
                                                                     double share) const {
  return
      [*this, from, share](double f, const std::string& text) { (*this)(from + share * f, text); };
}

}  // namespace ambrig
