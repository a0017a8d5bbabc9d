// The signed trailer behind an LCM message, 96 bytes. LCM's own readers ignore what follows a
// message, so that its tools and logs go on working. Integers are big-endian, as LCM's.
//
//   key id 8 | audience 8 | site tag 8 | Ed25519 signature 64 | version 1 | flags 1 | 0 0 | "OLST"
//
// The signature covers "OLS-bus-v1" | length of the payload (4) | channel | payload | key id |
// audience: with the channel, so that no station's message passes as another's. The site tag, a
// keyed BLAKE2b over all that and the signature, is what a stranger cannot make, and costs a
// hundredth of the signature to check. Pure.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "base/trust/crypto.h"

namespace ols::trust {

inline constexpr std::size_t kTrailerBytes = 96;

struct Trailer {
  KeyId key{};
  std::int64_t audience = 0;  // boot id of the station that it is meant for; 0: any
  SiteTag tag{};
  Signature signature{};
};

// Views into the bytes of a message as received.
struct SignedMessage {
  Bytes payload;  // the LCM message
  Trailer trailer;
};

// Nothing if no trailer of this version is behind the message: all of it is payload.
std::optional<SignedMessage> split_trailer(Bytes message);
// The message without its trailer, if it has one.
Bytes without_trailer(Bytes message);

// What is signed, and with the signature behind it, what the tag covers.
std::vector<std::uint8_t> signed_text(std::string_view channel, Bytes payload, const KeyId& key,
                                      std::int64_t audience);

// Whether it comes from somebody who knows the site's secret. That is no member's signature yet.
bool has_site_tag(const SiteKey& site, std::string_view channel, const SignedMessage& message);

// Payload and trailer.
std::vector<std::uint8_t> with_trailer(const SigningKey& key, const SiteKey& site,
                                       std::string_view channel, Bytes payload,
                                       std::int64_t audience);

}  // namespace ols::trust
