// The functions of libsodium that the bus needs: Ed25519 signatures (RFC 8032), and BLAKE2b (RFC
// 7693) with and without a key. Pure, except for drawing keys.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace ols::trust {

using Bytes = std::span<const std::uint8_t>;
using PublicKey = std::array<std::uint8_t, 32>;
using Seed = std::array<std::uint8_t, 32>;  // a private key
using Signature = std::array<std::uint8_t, 64>;
using SiteKey = std::array<std::uint8_t, 32>;  // the secret that all members share; site tags are
                                               // made with it
using SiteTag = std::array<std::uint8_t, 8>;
// The first bytes of a public key's BLAKE2b hash.
using KeyId = std::array<std::uint8_t, 8>;

class SigningKey {
 public:
  explicit SigningKey(const Seed& seed);
  Signature sign(Bytes text) const;
  const PublicKey& public_key() const { return public_; }

 private:
  PublicKey public_{};
  std::array<std::uint8_t, 64> secret_{};
};

bool is_signed_by(const PublicKey& key, Bytes text, const Signature& signature);
SiteTag site_tag(const SiteKey& key, Bytes text);
KeyId key_id(const PublicKey& key);

std::array<std::uint8_t, 32> draw_secret();

// from_hex() returns nullopt unless the text is exactly Size bytes in hexadecimal. to_hex() writes
// lower case.
std::string to_hex(Bytes bytes);
template <std::size_t Size>
std::optional<std::array<std::uint8_t, Size>> from_hex(std::string_view text);

// Six words for a public key, to be compared by voice. The words spell 96 bits of the key's hash as
// proquints (Wilkerson, arXiv:0901.4016).
std::string spoken(const PublicKey& key);

}  // namespace ols::trust
