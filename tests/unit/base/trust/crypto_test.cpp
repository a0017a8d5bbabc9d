#include "base/trust/crypto.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace ols::trust {
namespace {

// RFC 8032, section 7.1, test 2.
TEST(Crypto, SignsAsTheStandardDoes) {
  const auto seed =
      from_hex<32>("4ccd089b28ff96da9db6c346ec114e0f5b8a319f35aba624da8cf6ed4fb8a6fb");
  const SigningKey key(*seed);
  EXPECT_EQ(to_hex(key.public_key()),
            "3d4017c3e843895a92b70aa74d1b7ebc9c982ccf2ec4968cc0cd55f12af4660c");
  const std::vector<std::uint8_t> text{0x72};
  const Signature signature = key.sign(text);
  EXPECT_EQ(to_hex(signature),
            "92a009a9f0d4cab8720e820b5f642540a2b27b5416503f8fb3762223ebdb69da"
            "085ac1e43e15996e458f3613d0f11d8c387b2eaeb4302aeeb00d291612bb0c00");
  EXPECT_TRUE(is_signed_by(key.public_key(), text, signature));
  EXPECT_FALSE(is_signed_by(key.public_key(), std::vector<std::uint8_t>{0x73}, signature));
}

TEST(Crypto, ATagDependsOnKeyAndText) {
  SiteKey key{};
  const std::vector<std::uint8_t> text{1, 2, 3};
  const SiteTag tag = site_tag(key, text);
  EXPECT_EQ(site_tag(key, text), tag);
  EXPECT_NE(site_tag(key, std::vector<std::uint8_t>{1, 2, 4}), tag);
  key[31] = 1;
  EXPECT_NE(site_tag(key, text), tag);
}

TEST(Crypto, HexIsReadBackAndNothingElseIs) {
  const auto secret = draw_secret();
  EXPECT_EQ(from_hex<32>(to_hex(secret)), secret);
  EXPECT_NE(draw_secret(), secret);
  EXPECT_FALSE(from_hex<32>(to_hex(secret) + "0"));
  EXPECT_FALSE(from_hex<32>(std::string(63, '0') + "g"));
  EXPECT_FALSE(from_hex<64>(to_hex(secret)));
}

TEST(Crypto, SixWordsStandForAKey) {
  PublicKey key{};
  const std::string words = spoken(key);
  EXPECT_EQ(words.size(), 35U);
  EXPECT_EQ(std::ranges::count(words, ' '), 5);
  key[0] = 1;
  EXPECT_NE(spoken(key), words);
  EXPECT_NE(key_id(key), key_id(PublicKey{}));
}

}  // namespace
}  // namespace ols::trust
