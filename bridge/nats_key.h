// A user's key in NATS notation: kind of key, key and checksum, together in base32. Pure.
#pragma once

#include <array>
#include <cstdint>
#include <string>

namespace ols::bridge {

using Key = std::array<std::uint8_t, 32>;

struct NatsKey {
  std::string seed;        // "SU...": secret; kept in a file that only its owner can read
  std::string public_key;  // "U...": for the server's configuration
};
// Writes an Ed25519 key pair, given as its seed and its public half, in this notation.
NatsKey nats_key(const Key& seed, const Key& public_half);

}  // namespace ols::bridge
