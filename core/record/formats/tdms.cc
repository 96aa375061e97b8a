/// TDMS files of LabVIEW and DIAdem: channels with the wave-form properties wf_increment and
/// wf_start_offset, or with a channel of times beside them; linear and polynomial scales applied.
#include <algorithm>
#include <cmath>
#include <set>

#include "core/base/errors.h"
#include "core/base/parameters.h"
#include "core/base/read_file.h"
#include "core/record/formats/format.h"
#include "core/record/formats/tdms_objects.h"
#include "core/record/time_base.h"
#include "core/record/time_groups.h"

namespace ambrig {

namespace {

constexpr double kRawSource = 4294967295.0;  // a scale's input is the raw data

std::string Name(const TdmsChannel& c) { return c.group + "/" + c.name; }

/// Scale number `k` of a channel, from its properties.
class Scale {
 public:
  Scale(const TdmsChannel& channel, int k, const std::string& path)
      : channel_(channel), prefix_("NI_Scale[" + std::to_string(k) + "]_"), path_(path) {
    const std::string* kind = channel.Text(prefix_ + "Scale_Type");
    kind_ = kind == nullptr ? "" : *kind;
    if (kind_ == "Linear") {
      coefficients_ = {Property("Linear_Y_Intercept"), Property("Linear_Slope")};
    } else if (kind_ == "Polynomial") {
      const double* size = channel.Number(prefix_ + "Polynomial_Coefficients_Size");
      const int n = size == nullptr ? 4 : static_cast<int>(std::clamp(*size, 0.0, 100.0));
      for (int i = 0; i < n; ++i)
        coefficients_.push_back(Property("Polynomial_Coefficients[" + std::to_string(i) + "]"));
    } else {
      throw InputError(path + ": " + Name(channel) + " has a scale of kind '" + kind_ +
                       "', allowed: Linear, Polynomial; save it scaled");
    }
    const double* source = channel.Number(prefix_ + kind_ + "_Input_Source");
    source_ = source == nullptr ? kRawSource : *source;
  }

  double source() const { return source_; }
  double operator()(double x) const {
    double y = 0;
    for (auto c = coefficients_.rbegin(); c != coefficients_.rend(); ++c) y = y * x + *c;
    return y;
  }

 private:
  double Property(const std::string& name) const {
    const double* value = channel_.Number(prefix_ + name);
    if (value == nullptr)
      throw InputError(path_ + ": " + Name(channel_) + ": property " + prefix_ + name +
                       " is missing");
    return *value;
  }

  const TdmsChannel& channel_;
  std::string prefix_;
  const std::string& path_;
  std::string kind_;
  std::vector<double> coefficients_;
  double source_ = kRawSource;
};

/// Raw data to what was measured: the last scale, fed with its source, and so on.
void ApplyScales(TdmsChannel& c, const std::string& path) {
  const double* count = c.Number("NI_Number_Of_Scales");
  const std::string* status = c.Text("NI_Scaling_Status");
  if (count == nullptr || !(*count >= 1) || (status != nullptr && *status == "scaled")) return;
  if (*count > 100)
    throw InputError(path + ": " + Name(c) + " has " + NumberText(*count) + " scales, allowed 100");
  std::vector<Scale> chain;  // the last first
  for (double k = *count - 1; k != kRawSource;) {
    chain.emplace_back(c, static_cast<int>(k), path);
    const double source = chain.back().source();
    if (source != kRawSource && !(source >= 0 && source < k))
      throw InputError(path + ": " + Name(c) + ": scale " + NumberText(k) + " is fed by scale " +
                       NumberText(source) + ", allowed: an earlier one");
    k = source;
  }
  for (double& x : c.samples)
    for (auto scale = chain.rbegin(); scale != chain.rend(); ++scale) x = (*scale)(x);
}

std::string UnitOfChannel(const TdmsChannel& c) {
  const std::string* unit = c.Text("unit_string");
  if (unit == nullptr) unit = c.Text("NI_UnitDescription");
  return unit == nullptr ? "" : *unit;
}

bool OverFrequency(const TdmsChannel& c) {
  const std::string* unit = c.Text("wf_xunit_string");
  return unit != nullptr && *unit == "Hz";
}

/// Channel names, with the group's where two groups use one.
std::vector<std::string> ChannelNames(const std::vector<TdmsChannel>& channels) {
  std::multiset<std::string> all;
  for (const TdmsChannel& c : channels) all.insert(c.name);
  std::vector<std::string> names;
  for (const TdmsChannel& c : channels) names.push_back(all.count(c.name) == 1 ? c.name : Name(c));
  return names;
}

/// A time base of the channels' own properties; rate 0 where they have none.
TimedChannel WithTime(TdmsChannel& c, const std::string& name, const std::string& path) {
  TimedChannel out{{name, c.timestamps ? "s" : UnitOfChannel(c), std::move(c.samples)}};
  const double *step = c.Number("wf_increment"), *start = c.Number("wf_start_offset");
  if (step == nullptr || *step == 0 || IsTimeName(name)) return out;
  if (!(*step > 0) || !std::isfinite(*step))
    throw InputError(path + ": " + name + ": wf_increment = " + NumberText(*step) +
                     " s, allowed: above 0");
  out.rate = RateOfPeriod(*step, 15);
  out.start = start == nullptr ? 0 : *start;
  return out;
}

/// The record of the channels that have a time of their own; without any, of those that share the
/// length of a channel of times.
Record Assemble(std::vector<TimedChannel> channels, const std::string& path) {
  const auto untimed = [](const TimedChannel& c) { return c.rate == 0; };
  std::vector<std::string> notes;
  const bool any = std::any_of(channels.begin(), channels.end(),
                               [&](const TimedChannel& c) { return !untimed(c); });
  const auto time = std::find_if(channels.begin(), channels.end(), [](const TimedChannel& c) {
    return IsTimeName(c.channel.name.substr(c.channel.name.rfind('/') + 1));
  });
  if (!any && time != channels.end() && time->channel.name.find('/') != std::string::npos)
    time->channel.name = time->channel.name.substr(time->channel.name.rfind('/') + 1);
  const std::size_t rows = time == channels.end() ? 0 : time->channel.samples.size();
  const bool by_column = !any && time != channels.end();
  std::erase_if(channels, [&](const TimedChannel& c) {
    const bool out = any ? untimed(c) : by_column && c.channel.samples.size() != rows;
    if (out)
      notes.push_back(path + ": " + c.channel.name +
                      (any ? " has no wf_increment" : " is not as long as the channel of times") +
                      ", left out");
    return out;
  });
  Record record = OneTimeBase(std::move(channels), path);
  record.notes.insert(record.notes.end(), notes.begin(), notes.end());
  return record;
}

Measurement ReadTdms(const std::string& path) {
  const std::string bytes = ReadFile(path);
  std::vector<TdmsChannel> channels = ReadTdmsChannels(path, bytes);
  std::vector<std::string> notes;
  std::erase_if(channels, [&](const TdmsChannel& c) {
    const char* why = c.text              ? " holds text"
                      : OverFrequency(c)  ? " is not over time"
                      : c.samples.empty() ? " has no samples"
                                          : nullptr;
    if (why != nullptr) notes.push_back(path + ": " + Name(c) + why + ", left out");
    return why != nullptr;
  });
  const std::vector<std::string> names = ChannelNames(channels);
  std::vector<TimedChannel> timed;
  for (std::size_t k = 0; k < channels.size(); ++k) {
    ApplyScales(channels[k], path);
    timed.push_back(WithTime(channels[k], names[k], path));
  }
  Measurement out;
  out.record = Assemble(std::move(timed), path);
  out.record.notes.insert(out.record.notes.end(), notes.begin(), notes.end());
  FinishRecord(out.record, path);
  return out;
}

}  // namespace

RecordFormat TdmsFormat() {
  return {"TDMS", ".tdms", [](std::string_view begin) { return begin.starts_with("TDSm"); },
          ReadTdms};
}

}  // namespace ambrig
