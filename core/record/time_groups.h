#pragma once
/// Files that hold channels of several rates: a record has one time base.
#include <string>
#include <vector>

#include "core/record/record.h"

namespace ambrig {

struct TimedChannel {
  Channel channel;
  double rate = 0;   // [Hz]
  double start = 0;  // [s]
};

/// The record of the channels that share rate, start and length with most others (the first ones of
/// as many); a note for every other channel.
Record OneTimeBase(std::vector<TimedChannel> channels, const std::string& path);

/// The rate [Hz] of a period that was written with `digits` digits: the whole number of hertz of
/// which it is the rounded period, else 1 / period.
double RateOfPeriod(double period, int digits);

}  // namespace ambrig
