#include "bridge/nats_key.h"

#include <span>
#include <vector>

namespace ols::bridge {
namespace {

constexpr unsigned kSeedPrefix = 18U << 3U, kUserPrefix = 20U << 3U;

// CRC-16/XMODEM.
unsigned checksum(std::span<const std::uint8_t> bytes) {
  unsigned crc = 0;
  for (const std::uint8_t byte : bytes) {
    crc ^= static_cast<unsigned>(byte) << 8U;
    for (int bit = 0; bit < 8; ++bit) {
      crc = (crc & 0x8000U) != 0 ? (crc << 1U ^ 0x1021U) & 0xffffU : crc << 1U & 0xffffU;
    }
  }
  return crc;
}

std::string base32(std::span<const std::uint8_t> bytes) {
  constexpr const char* kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZ234567";
  std::string text;
  unsigned waiting = 0, bits = 0;
  for (const std::uint8_t byte : bytes) {
    waiting = (waiting << 8U | byte) & 0xffffU;
    for (bits += 8; bits >= 5; bits -= 5) text += kDigits[waiting >> (bits - 5) & 31U];
  }
  if (bits > 0) text += kDigits[waiting << (5 - bits) & 31U];
  return text;
}

std::string encoded(std::vector<std::uint8_t> bytes, const Key& key) {
  bytes.insert(bytes.end(), key.begin(), key.end());
  const unsigned crc = checksum(bytes);
  bytes.push_back(static_cast<std::uint8_t>(crc & 0xffU));
  bytes.push_back(static_cast<std::uint8_t>(crc >> 8U));
  return base32(bytes);
}

}  // namespace

NatsKey nats_key(const Key& seed, const Key& public_half) {
  return {encoded({static_cast<std::uint8_t>(kSeedPrefix | kUserPrefix >> 5U),
                   static_cast<std::uint8_t>((kUserPrefix & 31U) << 3U)},
                  seed),
          encoded({static_cast<std::uint8_t>(kUserPrefix)}, public_half)};
}

}  // namespace ols::bridge
