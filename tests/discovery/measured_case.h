#pragma once
/// A whole case on a clamped rotor whose measurements are written down: readings of the reference
/// rig at known places with a gain, an offset per record and white noise. What explains them is
/// known exactly.
#include <fmt/format.h>

#include <string>
#include <vector>

#include "core/math/noise.h"
#include "discovery/case/case.h"
#include "rig/rig_file.h"

namespace ambrig {

/// One record: where bearings A and B are held [m], what the sensors of A.x add.
struct MeasuredPlace {
  double x = 0, y = 0;
  double gain = 1, offset = 0;
};

/// 400 rows of A.x, A.y, B.x, B.y per record, noise of 2e-7 m as the rig file states; the last
/// record is kept back for validation.
inline Case MeasuredCase(const std::vector<MeasuredPlace>& places) {
  constexpr std::size_t kRows = 400;
  Case c;
  c.file = "case.toml";
  c.rig = ReadRig(std::string(AMBRIG_SOURCE_DIR) + "/scenarios/library/rigs/reference.toml");
  c.rig.effects.clear();
  for (std::size_t r = 0; r < places.size(); ++r) {
    const MeasuredPlace& p = places[r];
    CaseRecord record;
    record.data_file = fmt::format("record-{}.h5", r + 1);
    record.scenario = ReadScenarioText(
        fmt::format("name = \"place {}\"\nrig = \"rig.toml\"\nduration = 0.032\n"
                    "record_rate = 12500.0\nfault_tolerance = false\n[start]\nstate = \"clamped\"\n"
                    "position = {{ A = [{}, {}], B = [{}, {}] }}\n"
                    "[speed]\nprofile = [[0.0, 0.0], [0.032, 0.0]]\n",
                    r + 1, p.x, p.y, p.x, p.y),
        "place.toml", c.rig);
    record.validate = r + 1 == places.size();
    record.data.rate = 12500;
    const double value[] = {p.gain * p.x + p.offset, p.y, p.x, p.y};
    const char* const names[] = {"A.x", "A.y", "B.x", "B.y"};
    for (std::uint32_t ch = 0; ch < 4; ++ch) {
      Channel channel{names[ch], "m", std::vector<double>(kRows)};
      for (std::size_t k = 0; k < kRows; ++k)
        channel.samples[k] = value[ch] + 2e-7 * Normal(77 + r, ch, k);
      record.data.channels.push_back(channel);
      record.quality.push_back({names[ch], "good", true, std::vector<char>(kRows, 1), 0, 0});
    }
    c.records.push_back(std::move(record));
  }
  return c;
}

}  // namespace ambrig
