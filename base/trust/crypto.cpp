#include "base/trust/crypto.h"

#include <sodium.h>

#include <algorithm>
#include <stdexcept>

namespace ols::trust {
namespace {

// Safe to call again, from any thread.
void require_library() {
  if (sodium_init() < 0) throw std::runtime_error("libsodium does not start");
}

int digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  return c >= 'a' && c <= 'f' ? c - 'a' + 10 : -1;
}

std::string proquint(unsigned value) {
  constexpr std::string_view kConsonants = "bdfghjklmnprstvz", kVowels = "aiou";
  std::string word;
  word += kConsonants[value >> 12U & 15U];
  word += kVowels[value >> 10U & 3U];
  word += kConsonants[value >> 6U & 15U];
  word += kVowels[value >> 4U & 3U];
  word += kConsonants[value & 15U];
  return word;
}

}  // namespace

SigningKey::SigningKey(const Seed& seed) {
  require_library();
  crypto_sign_ed25519_seed_keypair(public_.data(), secret_.data(), seed.data());
}

Signature SigningKey::sign(Bytes text) const {
  Signature signature{};
  crypto_sign_ed25519_detached(signature.data(), nullptr, text.data(), text.size(), secret_.data());
  return signature;
}

bool is_signed_by(const PublicKey& key, Bytes text, const Signature& signature) {
  require_library();
  return crypto_sign_ed25519_verify_detached(signature.data(), text.data(), text.size(),
                                             key.data()) == 0;
}

SiteTag site_tag(const SiteKey& key, Bytes text) {
  // The library gives 16 bytes at least.
  std::array<std::uint8_t, crypto_generichash_blake2b_BYTES_MIN> hash{};
  crypto_generichash_blake2b(hash.data(), hash.size(), text.data(), text.size(), key.data(),
                             key.size());
  SiteTag tag{};
  std::copy_n(hash.begin(), tag.size(), tag.begin());
  return tag;
}

KeyId key_id(const PublicKey& key) {
  std::array<std::uint8_t, 32> hash{};
  crypto_generichash_blake2b(hash.data(), hash.size(), key.data(), key.size(), nullptr, 0);
  KeyId id{};
  std::copy_n(hash.begin(), id.size(), id.begin());
  return id;
}

std::array<std::uint8_t, 32> draw_secret() {
  require_library();
  std::array<std::uint8_t, 32> secret{};
  randombytes_buf(secret.data(), secret.size());
  return secret;
}

std::string to_hex(Bytes bytes) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string text;
  for (const std::uint8_t byte : bytes) {
    text += kDigits[byte >> 4U];
    text += kDigits[byte & 15U];
  }
  return text;
}

template <std::size_t Size>
std::optional<std::array<std::uint8_t, Size>> from_hex(std::string_view text) {
  std::array<std::uint8_t, Size> bytes{};
  if (text.size() != 2 * Size) return std::nullopt;
  for (std::size_t i = 0; i < Size; ++i) {
    const int high = digit(text[2 * i]), low = digit(text[2 * i + 1]);
    if (high < 0 || low < 0) return std::nullopt;
    bytes[i] = static_cast<std::uint8_t>(high * 16 + low);
  }
  return bytes;
}

template std::optional<std::array<std::uint8_t, 32>> from_hex<32>(std::string_view);
template std::optional<std::array<std::uint8_t, 64>> from_hex<64>(std::string_view);

std::string spoken(const PublicKey& key) {
  std::array<std::uint8_t, 32> hash{};
  crypto_generichash_blake2b(hash.data(), hash.size(), key.data(), key.size(), nullptr, 0);
  std::string words;
  for (std::size_t i = 0; i < 12; i += 2) {
    if (i > 0) words += ' ';
    words += proquint(static_cast<unsigned>(hash[i]) << 8U | hash[i + 1]);
  }
  return words;
}

}  // namespace ols::trust
