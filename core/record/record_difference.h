#pragma once
/// Two records beside each other, channel by channel, within tolerances: what a regression test of
/// a user's own rig asks.
///
/// A value a of the first record at time t agrees with the second when the second comes within
///   absolute + relative * (largest |a| of the channel)
/// of it somewhere in [t - time, t + time]; between rows the second is taken as linear. Rows whose
/// window reaches beyond an end of the second are not judged: what stood there is
/// not recorded. With all three 0 the samples must be equal bit for bit (0 and -0 apart).
#include <string>
#include <vector>

#include "core/base/toml.h"
#include "core/record/record.h"

namespace ambrig {

struct ChannelTolerance {
  double absolute = 0;  // [SI unit of the channel]
  double relative = 0;  // [-], of the channel's largest value
  double time = 0;      // [s]
};

/// Tolerances by channel name; a pattern may hold one `*` ("A.i*"). The last that fits counts.
struct RecordTolerances {
  ChannelTolerance all;
  std::vector<std::pair<std::string, ChannelTolerance>> patterns;
  double events = 0;  // [s], how far an event may move

  ChannelTolerance Of(const std::string& channel) const;
};

/// From a file: [all], [channel."A.i*"] with absolute, relative, time; events. @throws InputError
RecordTolerances ReadTolerances(const std::string& file);

enum class ChannelVerdict { kSame, kWithin, kDiffers, kLost, kNew, kOtherUnit, kNan };

struct ChannelDifference {
  std::string channel, unit;
  ChannelVerdict verdict = ChannelVerdict::kSame;
  double first = 0;                // [s], first row beyond the tolerance
  double worst = 0, worst_at = 0;  // largest |a - b| at one instant [unit], [s]
  double rms = 0;                  // of a - b [unit]
  double allowed = 0;              // absolute + relative part [unit]
  std::size_t rows = 0, beyond = 0;
  bool bad() const {
    return verdict != ChannelVerdict::kSame && verdict != ChannelVerdict::kWithin;
  }
};

struct RecordDifference {
  std::vector<ChannelDifference> channels;  // of the first, then those only in the second
  std::string length;                       // what is wrong with start, rate or length; empty: none
  bool identical() const;                   // no bit differs
  bool agrees() const;
  /// The channel that leaves its tolerance first; nullptr when none does.
  const ChannelDifference* First() const;
};

/// `b` may have another rate: it is compared at the rows of `a`. Units as they are (SI).
RecordDifference CompareRecords(const Record& a, const Record& b, const RecordTolerances& t);

/// "same", "within", "differs", "lost", "new", "other unit", "not a number".
const char* VerdictText(ChannelVerdict v);

}  // namespace ambrig
