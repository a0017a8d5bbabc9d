#include "base/trust/trailer.h"

#include <algorithm>
#include <array>

namespace ols::trust {
namespace {

constexpr std::string_view kDomain = "OLS-bus-v1";
// Version, flags, two zeros, magic. No signature covers them, so only one value is valid.
constexpr std::array<std::uint8_t, 8> kEnd{1, 0, 0, 0, 'O', 'L', 'S', 'T'};

void append(std::vector<std::uint8_t>& bytes, Bytes more) {
  bytes.insert(bytes.end(), more.begin(), more.end());
}

void append(std::vector<std::uint8_t>& bytes, std::string_view text) {
  for (const char c : text) bytes.push_back(static_cast<std::uint8_t>(c));
}

void append(std::vector<std::uint8_t>& bytes, std::uint64_t value, int size) {
  for (int byte = size - 1; byte >= 0; --byte) {
    bytes.push_back(static_cast<std::uint8_t>(value >> static_cast<unsigned>(8 * byte)));
  }
}

template <std::size_t Size>
void take(Bytes& rest, std::array<std::uint8_t, Size>& field) {
  std::copy_n(rest.begin(), Size, field.begin());
  rest = rest.subspan(Size);
}

}  // namespace

std::optional<SignedMessage> split_trailer(Bytes message) {
  if (message.size() < kTrailerBytes) return std::nullopt;
  if (!std::ranges::equal(message.last(kEnd.size()), kEnd)) return std::nullopt;
  SignedMessage result;
  result.payload = message.first(message.size() - kTrailerBytes);
  Bytes rest = message.last(kTrailerBytes);
  std::array<std::uint8_t, 8> audience{};
  take(rest, result.trailer.key);
  take(rest, audience);
  take(rest, result.trailer.tag);
  take(rest, result.trailer.signature);
  std::uint64_t value = 0;
  for (const std::uint8_t byte : audience) value = value << 8U | byte;
  result.trailer.audience = static_cast<std::int64_t>(value);
  return result;
}

Bytes without_trailer(Bytes message) {
  const auto split = split_trailer(message);
  return split ? split->payload : message;
}

std::vector<std::uint8_t> signed_text(std::string_view channel, Bytes payload, const KeyId& key,
                                      std::int64_t audience) {
  std::vector<std::uint8_t> text;
  text.reserve(kDomain.size() + 20 + channel.size() + payload.size() + sizeof(Signature));
  append(text, kDomain);
  append(text, payload.size(), 4);
  append(text, channel);
  append(text, payload);
  append(text, key);
  append(text, static_cast<std::uint64_t>(audience), 8);
  return text;
}

bool has_site_tag(const SiteKey& site, std::string_view channel, const SignedMessage& message) {
  const Trailer& trailer = message.trailer;
  std::vector<std::uint8_t> text =
      signed_text(channel, message.payload, trailer.key, trailer.audience);
  append(text, trailer.signature);
  return site_tag(site, text) == trailer.tag;
}

std::vector<std::uint8_t> with_trailer(const SigningKey& key, const SiteKey& site,
                                       std::string_view channel, Bytes payload,
                                       std::int64_t audience) {
  const KeyId id = key_id(key.public_key());
  std::vector<std::uint8_t> text = signed_text(channel, payload, id, audience);
  const Signature signature = key.sign(text);
  append(text, signature);
  const SiteTag tag = site_tag(site, text);
  std::vector<std::uint8_t> message(payload.begin(), payload.end());
  message.reserve(payload.size() + kTrailerBytes);
  append(message, id);
  append(message, static_cast<std::uint64_t>(audience), 8);
  append(message, tag);
  append(message, signature);
  append(message, kEnd);
  return message;
}

}  // namespace ols::trust
