#include "base/trust/trust_words.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

#include "tests/unit/error_text.h"

namespace ols::trust {
namespace {

using testing::HasSubstr;

TEST(TrustWords, ANameIsShortAndOfPlainCharacters) {
  for (const char* good : {"a", "Alfa-2_b", "12345678901234567890123456789012"}) {
    EXPECT_NO_THROW(require_member_name(good)) << good;
  }
  for (const char* bad : {"", "a b", "a/b", "\xc3\xa4", "123456789012345678901234567890123"}) {
    EXPECT_THROW(require_member_name(bad), std::invalid_argument) << bad;
  }
}

TEST(TrustWords, AnErrorNamesFileLineAndKey) {
  ConfigFile file("name = \"a b\"\nseed = \"12\"\n", "alfa.key");
  const auto complaint = [&](auto read, const char* key) -> std::string {
    return error_text<ConfigError>([&] { read(file.root(), key); }, "none");
  };
  EXPECT_THAT(complaint(read_name, "name"), HasSubstr("alfa.key:1: name: must be 1 to 32"));
  EXPECT_THAT(complaint(read_hex, "seed"), HasSubstr("alfa.key:2: seed: must be 64"));
  EXPECT_THAT(complaint(read_hex, "absent"), HasSubstr("must be 64"));
}

TEST(TrustWords, HexadecimalDigitsAreBytes) {
  ConfigFile file("seed = \"" + std::string(62, '0') + "a1\"\n", "alfa.key");
  EXPECT_EQ(read_hex(file.root(), "seed")[31], 0xa1);
}

}  // namespace
}  // namespace ols::trust
