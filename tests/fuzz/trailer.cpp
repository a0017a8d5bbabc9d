// What arrives with a trailer, or with what pretends to be one: never believed unless a member has
// signed it. The input is a message as received, after a byte for its channel; of every other one
// the trailer names a member and has the right site tag, as a thief's would.
#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "base/trust/messages_trust.h"
#include "base/trust/verifier.h"
#include "tests/fuzz/fuzz_input.h"

namespace {

namespace trust = ols::trust;

constexpr std::int64_t kNow_us = 1'700'000'000'000'000;
constexpr std::array kChannels = {
    "OLS_BEARING_alfa", "OLS_STATUS_alfa", "OLS_PTU_alfa",  "OLS_SLEW_alfa",
    "OLS_TARGET",       "OLS_TRUST",       "OLS_SIM_TRUTH", "CHAT"};

trust::TrustList site(const trust::SigningKey& key) {
  trust::TrustList list;
  list.site = "fuzz";
  list.number = 1;
  list.members = {{"alfa", trust::Role::kStation, key.public_key()}};
  return list;
}

// As one who has the site's secret, but no key.
std::vector<std::uint8_t> forged(const trust::SigningKey& key, std::string_view channel,
                                 std::string_view bytes) {
  const std::vector<std::uint8_t> payload(bytes.begin(), bytes.end());
  auto message = trust::with_trailer(key, {}, channel, payload, 7);
  const auto split = trust::split_trailer(message);
  auto signature = split->trailer.signature;
  signature[0] ^= 1U;
  auto text = trust::signed_text(channel, payload, split->trailer.key, 7);
  text.insert(text.end(), signature.begin(), signature.end());
  const auto tag = trust::site_tag({}, text);
  const auto trailer = message.end() - trust::kTrailerBytes;
  std::ranges::copy(tag, trailer + 16);
  std::ranges::copy(signature, trailer + 24);
  return message;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const trust::SigningKey kKey(trust::Seed{1});
  static trust::Verifier verifier({.station = "alfa", .boot_id = 7}, trust::SiteKey{}, site(kKey));
  static double now_s = 0.0;
  now_s += 1.0;  // the rates are not what is tested
  ols::fuzz::Input input(data, size);
  const std::uint8_t choice = input.byte();
  const std::string channel = kChannels[choice / 2 % kChannels.size()];
  const std::string_view bytes = input.rest();
  const std::vector<std::uint8_t> message =
      choice % 2 == 0 ? std::vector<std::uint8_t>(bytes.begin(), bytes.end())
                      : forged(kKey, channel, bytes);
  const auto verdict = verifier.judge(channel, message, {kNow_us, now_s});
  ols::fuzz::require(verdict.distrust.has_value(), "nothing is believed that nobody signed");
  const auto payload = trust::without_trailer(message);
  ols::fuzz::require(
      payload.size() == message.size() || payload.size() + trust::kTrailerBytes == message.size(),
      "a trailer has one size");
  static_cast<void>(trust::list_from(payload));
  return 0;
}
