// A user's key in NATS notation: base32 of the kind of key, the key and a checksum. Pure.
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
// From an Ed25519 pair: the seed that makes it, and its public half.
NatsKey nats_key(const Key& seed, const Key& public_half);

}  // namespace ols::bridge
