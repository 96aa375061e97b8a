#pragma once
/// Tells the caller of explain how far the search is, and stops it where the caller wants that.
#include <functional>
#include <string>

#include "discovery/explain/explain.h"
#include "discovery/explain/search_models.h"

namespace ambrig {

/// Keeps references to both.
class SearchProgress {
 public:
  SearchProgress(const ExplainOptions& options, const SearchModels& models)
      : options_(options), models_(models) {}

  /// `fraction`: 0 to 1, of the whole search.
  /// @throws Interrupted where the caller has asked to stop
  void operator()(double fraction, const std::string& text) const;
  /// Of a part that begins at `from` and takes `share` of the search: its own fractions are 0 to 1.
  std::function<void(double, const std::string&)> Part(double from, double share) const;

 private:
  const ExplainOptions& options_;
  const SearchModels& models_;
};

}  // namespace ambrig
