#pragma once
/// A channel thinned for a plot: the least and greatest sample of every pixel column, so that no
/// peak is lost and a noise band keeps its width.
#include <cstddef>
#include <span>
#include <vector>

namespace ambrig::workbench {

/// Least and greatest; nan, nan: no sample counts.
struct Extreme {
  float lo, hi;
};

/// The extremes of every 64 samples, so that a view of many samples reads one in 32 of them.
class ExtremesLevel {
 public:
  static constexpr std::size_t kBlock = 64;
  explicit ExtremesLevel(std::span<const float> samples);
  const std::vector<Extreme>& blocks() const { return blocks_; }

 private:
  std::vector<Extreme> blocks_;
};

/// Of samples [first, last), in `columns` columns of as equal counts as can be; a column without
/// samples has nan. `level` is that of the same samples. nan samples do not count.
std::vector<Extreme> ThinnedExtremes(std::span<const float> samples, const ExtremesLevel& level,
                                     std::size_t first, std::size_t last, std::size_t columns);

}  // namespace ambrig::workbench
