#pragma once
/// What a model leaves of a case, taken for noise where all of it looks like noise
/// (discovery/data/stationary_noise.h): sensors whose noise is not white, or larger than stated,
/// shake the rotor through the control loop.
#include <string>
#include <vector>

namespace ambrig {

class CaseModel;

/// A channel of levitated records whose noise is larger than the floor of its targets.
struct UnexpectedNoise {
  std::string channel;
  double rms = 0, expected = 0;  // SI
  double frequency = 0;          // middle of the octave that holds most of it [Hz]
};

struct StationaryRemainder {
  std::vector<UnexpectedNoise> channels;
  std::vector<double> floors;  // of every target, SI
};

/// `predicted`, `residual`: of all rows, as a fit has them. Without channels where some error of a
/// record is something else than noise, or cannot be told from it; then the floors are empty, too.
StationaryRemainder StationaryRemainderOf(const CaseModel& model,
                                          const std::vector<double>& predicted,
                                          const std::vector<double>& residual);

/// A line for each kind of channel, of the one whose noise is the most times larger.
std::vector<std::string> RemainderRemarks(const StationaryRemainder& noise);

}  // namespace ambrig
