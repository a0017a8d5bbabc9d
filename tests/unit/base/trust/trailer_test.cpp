#include "base/trust/trailer.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/unit/base/trust/site_fixture.h"

namespace ols::trust {
namespace {

const Site kSite;

TEST(Trailer, IsBehindThePayloadAndReadBack) {
  const auto content = payload(7, 8, 9);
  const auto message = with_trailer(kSite.alfa, kSite.secret, "OLS_PTU_a", content, -5);
  ASSERT_EQ(message.size(), content.size() + kTrailerBytes);
  const auto split = split_trailer(message);
  ASSERT_TRUE(split);
  EXPECT_TRUE(std::ranges::equal(split->payload, content));
  EXPECT_EQ(split->trailer.key, key_id(kSite.alfa.public_key()));
  EXPECT_EQ(split->trailer.audience, -5);
  auto text = signed_text("OLS_PTU_a", content, split->trailer.key, -5);
  EXPECT_TRUE(is_signed_by(kSite.alfa.public_key(), text, split->trailer.signature));
  text.insert(text.end(), split->trailer.signature.begin(), split->trailer.signature.end());
  EXPECT_EQ(site_tag(kSite.secret, text), split->trailer.tag);
}

// The format is fixed: what is recorded today must be verified in ten years.
TEST(Trailer, HasItsFieldsWhereTheFormatSays) {
  const auto message = with_trailer(kSite.alfa, kSite.secret, "C", {}, 0x0102030405060708);
  ASSERT_EQ(message.size(), kTrailerBytes);
  const KeyId id = key_id(kSite.alfa.public_key());
  EXPECT_TRUE(std::equal(id.begin(), id.end(), message.begin()));
  for (std::uint8_t i = 0; i < 8; ++i) EXPECT_EQ(message[8U + i], i + 1);
  const std::vector<std::uint8_t> end(message.end() - 8, message.end());
  EXPECT_EQ(end, (std::vector<std::uint8_t>{1, 0, 0, 0, 'O', 'L', 'S', 'T'}));
  const std::string text = "OLS-bus-v1" + std::string(4, '\0') + "C" +
                           std::string(id.begin(), id.end()) + "\1\2\3\4\5\6\7\10";
  const auto bytes = signed_text("C", {}, id, 0x0102030405060708);
  EXPECT_EQ(std::string(bytes.begin(), bytes.end()), text);
}

TEST(Trailer, AnythingElseIsPayload) {
  auto message = with_trailer(kSite.alfa, kSite.secret, "C", payload(1, 2, 3), 0);
  EXPECT_EQ(without_trailer(message).size(), message.size() - kTrailerBytes);
  for (std::size_t back = 1; back <= 8; ++back) {
    auto other = message;
    other[other.size() - back] ^= 0x80U;
    EXPECT_FALSE(split_trailer(other)) << back;
    EXPECT_EQ(without_trailer(other).size(), other.size());
  }
  EXPECT_FALSE(split_trailer({}));
  message.erase(message.begin(), message.end() - kTrailerBytes + 1);
  EXPECT_FALSE(split_trailer(message)) << "a byte too short";
}

TEST(Trailer, NothingShiftsBetweenChannelAndPayload) {
  const KeyId id{};
  const std::vector<std::uint8_t> long_one{'B', 'C'}, short_one{'C'};
  EXPECT_NE(signed_text("A", long_one, id, 0), signed_text("AB", short_one, id, 0));
}

}  // namespace
}  // namespace ols::trust
