#include "core/record/channels.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "core/base/errors.h"

namespace ambrig {

namespace {

constexpr std::string_view kDirections = "xyz";
constexpr int kAxial = 2;

/// The number of a coil, from 1, without leading zeros; 0 for any other text.
int CoilNumber(std::string_view text) {
  int number = 0;
  const char* end = text.data() + text.size();
  const auto [at, error] = std::from_chars(text.data(), end, number);
  return error == std::errc{} && at == end && text[0] != '0' && number > 0 ? number : 0;
}

/// Direction of a channel of `row`, from the last letter of its name; -1 for any other text.
int DirectionOf(const ChannelRow& row, std::string_view text) {
  if (text.size() != 1) return -1;
  const std::size_t direction = kDirections.find(text[0]);
  if (direction == std::string_view::npos) return -1;
  return direction == kAxial && !row.axial.empty() ? -1 : static_cast<int>(direction);
}

/// `name` as a channel of `row`: PLANE.MARK and then a direction or the number of a coil.
std::optional<ChannelId> MatchRow(const ChannelRow& row, std::string_view name) {
  if (row.scope == ChannelScope::kRig)
    return name == row.mark ? std::optional(ChannelId{row.kind, "", 0}) : std::nullopt;
  if (!row.axial.empty() && name == row.axial) return ChannelId{row.kind, "", kAxial};
  const std::string mark = fmt::format(".{}", row.mark);
  const std::size_t dot = name.rfind(mark);
  if (dot == std::string_view::npos || dot == 0) return std::nullopt;
  const std::string_view rest = name.substr(dot + mark.size());
  const int index =
      row.scope == ChannelScope::kCoil ? CoilNumber(rest) - 1 : DirectionOf(row, rest);
  if (index < 0) return std::nullopt;
  return ChannelId{row.kind, std::string(name.substr(0, dot)), index};
}

}  // namespace

const ChannelRow& RowOf(ChannelKind kind) {
  const auto* row = std::ranges::find(kChannels, kind, &ChannelRow::kind);
  Require(row != std::end(kChannels), "a kind of channel that has a row");
  return *row;
}

std::string ChannelId::name() const {
  const ChannelRow& r = row();
  if (r.scope == ChannelScope::kRig) return std::string(r.mark);
  if (r.scope == ChannelScope::kCoil) return fmt::format("{}.{}{}", plane, r.mark, index + 1);
  if (index == kAxial && !r.axial.empty()) return std::string(r.axial);
  return fmt::format("{}.{}{}", plane, r.mark, kDirections[static_cast<std::size_t>(index)]);
}

std::optional<ChannelId> ParseChannel(std::string_view name) {
  for (const ChannelRow& row : kChannels)
    if (auto id = MatchRow(row, name)) return id;
  return std::nullopt;
}

bool IsOfKind(std::string_view name, ChannelKind kind) {
  const auto id = ParseChannel(name);
  return id && id->kind == kind;
}

std::string_view ChannelWords(std::string_view name) {
  const auto id = ParseChannel(name);
  return id ? id->row().words : "unknown";
}

const Channel* Find(const Record& record, const ChannelId& id) { return record.Find(id.name()); }

}  // namespace ambrig
