#include "edge/device/certificate_key.h"

#include <sodium.h>

#include <array>
#include <optional>
#include <regex>
#include <stdexcept>
#include <vector>

namespace ols::device {
namespace {

constexpr int kBase64 = sodium_base64_VARIANT_ORIGINAL;

using Bytes = std::span<const std::uint8_t>;

// An element of DER (ITU-T X.690).
struct Element {
  std::uint8_t tag = 0;
  Bytes content;
  Bytes whole;  // with tag and length
};

// Takes the element at the front.
std::optional<Element> take(Bytes& rest) {
  constexpr std::uint8_t kLong = 0x80;
  constexpr std::size_t kMostLengthBytes = 4;
  if (rest.size() < 2) return std::nullopt;
  std::size_t head = 2, length = rest[1];
  if ((rest[1] & kLong) != 0) {
    const std::size_t count = rest[1] & ~kLong;
    if (count == 0 || count > kMostLengthBytes || rest.size() < 2 + count) return std::nullopt;
    length = 0;
    for (const std::uint8_t byte : rest.subspan(2, count)) length = length << 8 | byte;
    head += count;
  }
  if (rest.size() - head < length) return std::nullopt;
  const Element element{rest[0], rest.subspan(head, length), rest.first(head + length)};
  rest = rest.subspan(head + length);
  return element;
}

// RFC 5280, section 4.1: version (optional), serial number, signature, issuer, validity, subject,
// subjectPublicKeyInfo.
std::optional<Bytes> public_key_info(Bytes der) {
  constexpr std::uint8_t kSequence = 0x30, kVersion = 0xa0;
  constexpr int kBefore = 5;
  const auto certificate = take(der);
  if (!certificate || certificate->tag != kSequence) return std::nullopt;
  Bytes inside = certificate->content;
  const auto signed_part = take(inside);
  if (!signed_part || signed_part->tag != kSequence) return std::nullopt;
  Bytes rest = signed_part->content;
  auto element = take(rest);
  if (element && element->tag == kVersion) element = take(rest);
  for (int i = 0; i < kBefore && element; ++i) element = take(rest);
  if (!element || element->tag != kSequence) return std::nullopt;
  return element->whole;
}

}  // namespace

std::string certificate_key(Bytes der) {
  const auto info = public_key_info(der);
  if (!info) return {};
  std::array<unsigned char, crypto_hash_sha256_BYTES> hash{};
  crypto_hash_sha256(hash.data(), info->data(), info->size());
  std::string base64(sodium_base64_encoded_len(hash.size(), kBase64), '\0');
  sodium_bin2base64(base64.data(), base64.size(), hash.data(), hash.size(), kBase64);
  base64.pop_back();  // a zero
  return "sha256//" + base64;
}

std::string certificate_key_of_pem(std::string_view pem) {
  constexpr std::string_view kBegin = "-----BEGIN CERTIFICATE-----", kEnd = "-----END CERTIFICATE";
  const std::size_t begin = pem.find(kBegin);
  if (begin == std::string_view::npos) return {};
  pem.remove_prefix(begin + kBegin.size());
  pem = pem.substr(0, pem.find(kEnd));
  if (pem.empty()) return {};
  std::vector<std::uint8_t> der(pem.size());
  std::size_t bytes = 0;
  if (sodium_base642bin(der.data(), der.size(), pem.data(), pem.size(), "\r\n ", &bytes, nullptr,
                        kBase64) != 0)
    return {};
  return certificate_key(Bytes(der).first(bytes));
}

void check_pinned_key(const std::string& text) {
  static const std::regex kKey("(sha256//[A-Za-z0-9+/]{43}=)?");
  if (!std::regex_match(text, kKey))
    throw std::invalid_argument("must be sha256// and the 44 characters of the key's hash");
}

}  // namespace ols::device
