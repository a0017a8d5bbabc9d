// The trailer after an LCM message, with its signature: 96 bytes. LCM's own readers ignore bytes
// after a message, so that LCM's tools and logs keep working. Integers are big-endian, as in LCM.
//
//   key id 8 | audience 8 | site tag 8 | Ed25519 signature 64 | version 1 | flags 1 | 0 0 | "OLST"
//
// The signature covers "OLS-bus-v1" | length of the payload (4) | channel | payload | key id |
// audience. The channel is included so that the message of one station cannot pass as a message of
// another. The site tag is a keyed BLAKE2b over all that and the signature. Only members can make a
// site tag, and checking it costs a hundredth of checking the signature. Pure.
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
  std::int64_t audience = 0;  // boot id of the addressed station; 0: any
  SiteTag tag{};
  Signature signature{};
};

// Views into the bytes of a received message.
struct SignedMessage {
  Bytes payload;  // the LCM message
  Trailer trailer;
};

// nullopt if the message does not end with a trailer of this version; then the whole message is
// payload.
std::optional<SignedMessage> split_trailer(Bytes message);
// The message without its trailer, if there is one.
Bytes without_trailer(Bytes message);

// The bytes that the signature covers. The tag covers these bytes followed by the signature.
std::vector<std::uint8_t> signed_text(std::string_view channel, Bytes payload, const KeyId& key,
                                      std::int64_t audience);

// Whether the sender knows the site's secret. Does not verify the member's signature.
bool has_site_tag(const SiteKey& site, std::string_view channel, const SignedMessage& message);

// Returns payload and trailer.
std::vector<std::uint8_t> with_trailer(const SigningKey& key, const SiteKey& site,
                                       std::string_view channel, Bytes payload,
                                       std::int64_t audience);

}  // namespace ols::trust
