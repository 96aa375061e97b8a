#pragma once
/// Rounds of the Advanced Encryption Standard (FIPS 197) for machines without an instruction for
/// them. A state is four words, its columns, least significant byte on top.
#include <array>
#include <cstdint>

namespace ambrig {

using AesState = std::array<std::uint32_t, 4>;

namespace aes {

struct Tables {
  std::array<std::uint8_t, 256> s{};  // SubBytes
  // what a byte on top of a column mixes into it, substituted
  std::array<std::uint32_t, 256> column{};
};

/// Times x in GF(2^8) modulo x^8 + x^4 + x^3 + x + 1.
constexpr std::uint8_t Doubled(std::uint8_t a) {
  return static_cast<std::uint8_t>((a << 1) ^ (a & 0x80 ? 0x1b : 0));
}

constexpr Tables MakeTables() {
  std::array<std::uint8_t, 256> power{}, logarithm{};  // of x + 1, which generates the field
  std::uint8_t at = 1;
  for (int k = 0; k < 255; ++k) {
    power[static_cast<std::size_t>(k)] = at;
    logarithm[at] = static_cast<std::uint8_t>(k);
    at = static_cast<std::uint8_t>(at ^ Doubled(at));
  }
  Tables t;
  for (std::size_t a = 0; a < 256; ++a) {
    const unsigned inverse = a == 0 ? 0 : power[(255U - logarithm[a]) % 255];
    unsigned s = 0x63;
    for (int turn = 0; turn < 5; ++turn) s ^= (inverse << turn | inverse >> (8 - turn)) & 0xff;
    t.s[a] = static_cast<std::uint8_t>(s);
    const unsigned twice = Doubled(t.s[a]);
    t.column[a] = twice | s << 8 | s << 16 | (twice ^ s) << 24;
  }
  return t;
}

inline constexpr Tables kTables = MakeTables();

constexpr unsigned Byte(const AesState& s, int column, int row) {
  return s[static_cast<std::size_t>(column & 3)] >> (8 * row) & 0xff;
}

}  // namespace aes

/// ShiftRows, SubBytes, MixColumns, and the key added.
constexpr AesState AesRound(const AesState& s, const AesState& key) {
  AesState out = key;
  for (int c = 0; c < 4; ++c)
    for (int row = 0; row < 4; ++row) {
      const std::uint32_t mixed = aes::kTables.column[aes::Byte(s, c + row, row)];
      out[static_cast<std::size_t>(c)] ^=
          row == 0 ? mixed : mixed << (8 * row) | mixed >> (32 - 8 * row);
    }
  return out;
}

/// The same without MixColumns.
constexpr AesState AesLastRound(const AesState& s, const AesState& key) {
  AesState out = key;
  for (int c = 0; c < 4; ++c)
    for (int row = 0; row < 4; ++row)
      out[static_cast<std::size_t>(c)] ^=
          static_cast<std::uint32_t>(aes::kTables.s[aes::Byte(s, c + row, row)]) << (8 * row);
  return out;
}

}  // namespace ambrig
