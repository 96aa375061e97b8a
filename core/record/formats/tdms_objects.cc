#include "core/record/formats/tdms_objects.h"

#include <cmath>
#include <limits>
#include <optional>

#include "core/base/errors.h"
#include "core/record/byte_reader.h"
#include "core/record/formats/tdms_types.h"
#include "core/record/text_cells.h"

namespace ambrig {

namespace {

constexpr std::size_t kLeadIn = 28;
constexpr std::uint32_t kNoData = 0xffffffff, kSameAsBefore = 0;

/// Bits of the table of contents.
constexpr std::uint32_t kMetaData = 1U << 1, kNewList = 1U << 2, kRawData = 1U << 3,
                        kInterleaved = 1U << 5, kBigEndian = 1U << 6, kDaqmx = 1U << 7;

std::string Hex(std::uint32_t value) {
  std::string text;
  for (; value != 0 || text.empty(); value /= 16) text.insert(0, 1, "0123456789abcdef"[value % 16]);
  return "0x" + text;
}

/// "/'group'/'channel'" -> its parts; a quote within a name is doubled.
std::vector<std::string> PathParts(const std::string& path) {
  std::vector<std::string> parts;
  for (std::size_t k = 0; k < path.size(); ++k) {
    if (path[k] != '\'') continue;
    std::string part;
    for (++k; k < path.size(); ++k) {
      if (path[k] == '\'' && (k + 1 == path.size() || path[k + 1] != '\'')) break;
      if (path[k] == '\'') ++k;
      part += path[k];
    }
    parts.push_back(part);
  }
  return parts;
}

/// How the raw data of an object lie in a segment.
struct RawIndex {
  std::uint32_t type = 0;
  std::uint64_t values = 0;
  std::uint64_t bytes = 0;  // of one chunk
};

class TdmsReader {
 public:
  TdmsReader(const std::string& path, std::string_view bytes) : in_(path, bytes) {}

  std::vector<TdmsChannel> Read() {
    while (in_.left() >= kLeadIn) ReadSegment();
    std::vector<TdmsChannel> out;
    for (const TdmsChannel& c : objects_)
      if (!c.name.empty()) out.push_back(WithScales(c));
    return out;
  }

 private:
  struct Entry {  // of the list of objects with raw data in this segment
    std::size_t object = 0;
    RawIndex index = {};
  };

  void ReadSegment() {
    if (in_.Take(4) != "TDSm") {
      in_.Go(in_.at() - 4);
      in_.Fail("'TDSm' expected, with which a segment begins");
    }
    in_.big_endian(false);
    const auto contents = in_.Number<std::uint32_t>();
    big_endian_ = (contents & kBigEndian) != 0;
    in_.big_endian(big_endian_);
    if (const auto version = in_.Number<std::uint32_t>(); version != 4712 && version != 4713)
      in_.Fail("version " + std::to_string(version) + ", allowed 4712, 4713");
    const auto next = in_.Number<std::uint64_t>(), raw = in_.Number<std::uint64_t>();
    const std::size_t begin = in_.at();
    // All ones: the program was stopped while it wrote the last segment.
    const bool cut = next > in_.left();
    const std::size_t end = cut ? in_.end() : begin + static_cast<std::size_t>(next);
    if (cut && next != std::numeric_limits<std::uint64_t>::max())
      in_.Fail("the segment says " + std::to_string(next) + " bytes, the file has " +
               std::to_string(in_.left()) + " left");
    if (raw > end - begin) {
      if (cut) return in_.Go(in_.end());  // stopped before its data
      in_.Fail("raw data " + std::to_string(raw) + " bytes on, behind the end of the segment");
    }
    if ((contents & kMetaData) != 0) ReadObjects((contents & kNewList) != 0);
    if ((contents & kDaqmx) != 0) FailAtDaqmx();
    in_.Go(begin + static_cast<std::size_t>(raw));
    if ((contents & kRawData) != 0) ReadRaw(end, (contents & kInterleaved) != 0);
    in_.Go(end);
  }

  /// Scales may stand at the channel, its group or the file.
  TdmsChannel WithScales(const TdmsChannel& channel) const {
    TdmsChannel out = channel;
    for (const TdmsChannel& above : objects_) {
      const bool group = above.name.empty() && above.group == channel.group;
      const bool file = above.name.empty() && above.group.empty();
      if ((!group && !file) || out.properties.contains("NI_Number_Of_Scales")) continue;
      for (const auto& [name, value] : above.properties)
        if (name.starts_with("NI_")) out.properties.try_emplace(name, value);
    }
    return out;
  }

  [[noreturn]] void FailAtDaqmx() const {
    in_.Fail(
        "DAQmx raw data, which cannot be read; save the file again without raw logging, e.g. "
        "with the TDMS viewer of DIAdem or LabVIEW, or log with 'TDMS Write'");
  }

  std::string Text() { return Utf8(in_.Take(in_.Number<std::uint32_t>())); }

  std::size_t Object(const std::string& path) {
    const auto [it, fresh] = by_path_.try_emplace(path, objects_.size());
    if (fresh) {
      const std::vector<std::string> parts = PathParts(path);
      TdmsChannel c;
      if (!parts.empty()) c.group = parts[0];
      if (parts.size() > 1) c.name = parts[1];
      objects_.push_back(std::move(c));
      before_.emplace_back();
      place_.push_back(kNowhere);
    }
    return it->second;
  }

  void ReadObjects(bool new_list) {
    if (new_list) {
      for (const Entry& e : list_) place_[e.object] = kNowhere;
      list_.clear();
    }
    const auto count = in_.Number<std::uint32_t>();
    for (std::uint32_t k = 0; k < count; ++k) {
      const std::size_t object = Object(Text());
      ReadIndex(object);
      const auto properties = in_.Number<std::uint32_t>();
      for (std::uint32_t p = 0; p < properties; ++p) {
        const std::string name = Text();
        objects_[object].properties[name] = ReadProperty();
      }
    }
  }

  void ReadIndex(std::size_t object) {
    const auto length = in_.Number<std::uint32_t>();
    if (length == 0x1269 || length == 0x126a || length == 0x69120000 || length == 0x6a120000)
      FailAtDaqmx();
    if (length != kNoData && length != kSameAsBefore) {
      RawIndex index;
      index.type = in_.Number<std::uint32_t>();
      if (index.type == 0xffffffff) FailAtDaqmx();
      if (in_.Number<std::uint32_t>() != 1) in_.Fail("an array of more than one dimension");
      index.values = in_.Number<std::uint64_t>();
      const auto size = TdmsSize(index.type);
      if (!size)
        in_.Fail("values of type " + Hex(index.type) +
                 ", allowed integers, single, double, boolean, time stamp, string");
      if (*size != 0 && index.values > std::numeric_limits<std::uint64_t>::max() / 64)
        in_.Fail(std::to_string(index.values) + " values in a chunk");
      index.bytes = *size == 0 ? in_.Number<std::uint64_t>() : index.values * *size;
      before_[object] = index;
    } else if (length == kSameAsBefore && !before_[object]) {
      in_.Fail("an object is as before, but was never described");
    }
    const RawIndex index = length == kNoData ? RawIndex{} : *before_[object];
    if (place_[object] != kNowhere) {
      list_[place_[object]].index = index;
    } else if (length != kNoData) {
      place_[object] = list_.size();
      list_.push_back({object, index});
    }
  }

  TdmsValue ReadProperty() {
    const auto type = in_.Number<std::uint32_t>();
    if (type == kString) return Text();
    if (!TdmsSize(type)) in_.Fail("a property of type " + Hex(type));
    if (type != kTimestamp) return ReadTdmsNumber(in_, type);
    const TdmsInstant instant = ReadTdmsInstant(in_, big_endian_);
    return static_cast<double>(instant.seconds) + instant.fraction;
  }

  void ReadRaw(std::size_t end, bool interleaved) {
    std::uint64_t chunk = 0;
    for (const Entry& e : list_) {
      chunk += e.index.bytes;
      if (e.index.bytes > in_.end() || chunk > in_.end())
        if (end != in_.end()) in_.Fail("a chunk of raw data larger than the file");
    }
    if (chunk == 0) return;
    while (in_.at() < end) {
      const std::size_t at = in_.at();
      if (interleaved)
        ReadInterleaved(end);
      else
        ReadContiguous(end);
      if (in_.at() == at) return;  // less than a row is left
    }
  }

  void Append(const Entry& e) {
    TdmsChannel& c = objects_[e.object];
    if (e.index.type != kTimestamp) return c.samples.push_back(ReadTdmsNumber(in_, e.index.type));
    const TdmsInstant now = ReadTdmsInstant(in_, big_endian_);
    if (c.samples.empty()) origins_[e.object] = now;
    const TdmsInstant& origin = origins_[e.object];
    c.timestamps = true;
    // Whole seconds are exact as doubles; those of a damaged file may be too far apart
    // for an integer.
    c.samples.push_back(static_cast<double>(now.seconds) - static_cast<double>(origin.seconds) +
                        (now.fraction - origin.fraction));
  }

  /// One channel after the other; the last chunk may be cut.
  void ReadContiguous(std::size_t end) {
    for (const Entry& e : list_) {
      const std::size_t left = end - in_.at();
      if (e.index.type == kString) {
        objects_[e.object].text = true;
        in_.Take(static_cast<std::size_t>(std::min<std::uint64_t>(e.index.bytes, left)));
        continue;
      }
      if (e.index.values == 0) continue;
      const std::size_t size = *TdmsSize(e.index.type);
      const std::uint64_t count = std::min<std::uint64_t>(e.index.values, left / size);
      for (std::uint64_t k = 0; k < count; ++k) Append(e);
      if (count < e.index.values) return in_.Go(end);
    }
  }

  /// Row after row, a value of each channel.
  void ReadInterleaved(std::size_t end) {
    std::size_t row = 0;
    std::uint64_t values = 0;
    for (const Entry& e : list_) {
      if (e.index.values == 0) continue;
      if (e.index.type == kString) in_.Fail("interleaved strings");
      if (values != 0 && e.index.values != values)
        in_.Fail("interleaved channels of unequal length");
      values = e.index.values;
      row += *TdmsSize(e.index.type);
    }
    if (row == 0) return;
    const std::uint64_t rows = std::min<std::uint64_t>(values, (end - in_.at()) / row);
    for (std::uint64_t k = 0; k < rows; ++k)
      for (const Entry& e : list_)
        if (e.index.values != 0) Append(e);
  }

  static constexpr std::size_t kNowhere = std::numeric_limits<std::size_t>::max();

  ByteReader in_;
  bool big_endian_ = false;
  std::vector<TdmsChannel> objects_;
  std::map<std::string, std::size_t> by_path_;
  std::vector<std::optional<RawIndex>> before_;  // of each object, its last description
  std::vector<std::size_t> place_;               // of each object in the list
  std::vector<Entry> list_;
  std::map<std::size_t, TdmsInstant> origins_;  // first time stamps of channels that hold them
};

}  // namespace

const double* TdmsChannel::Number(const std::string& property) const {
  const auto it = properties.find(property);
  return it == properties.end() ? nullptr : std::get_if<double>(&it->second);
}

const std::string* TdmsChannel::Text(const std::string& property) const {
  const auto it = properties.find(property);
  return it == properties.end() ? nullptr : std::get_if<std::string>(&it->second);
}

std::vector<TdmsChannel> ReadTdmsChannels(const std::string& path, std::string_view bytes) {
  return TdmsReader(path, bytes).Read();
}

}  // namespace ambrig
