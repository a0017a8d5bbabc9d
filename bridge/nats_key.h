// A user's key as NATS writes it: base32 of a kind, the key and a checksum. Pure.
#pragma once

#include <array>
#include <cstdint>
#include <string>

namespace ols::bridge {

using Key = std::array<std::uint8_t, 32>;

struct NatsKey {
  std::string seed;        // "SU...": secret, into a file for its owner alone
  std::string public_key;  // "U...": into the configuration of the server
};
// Of an Ed25519 pair: the seed that it was made from, and its public half.
NatsKey nats_key(const Key& seed, const Key& public_half);

}  // namespace ols::bridge
