#include "base/trust/signed_text.h"

#include <gtest/gtest.h>

#include "base/config/toml_config.h"
#include "tests/unit/base/trust/site_fixture.h"

namespace ols::trust {
namespace {

const Site kSite;

TEST(SignedText, IsItsRootsForItsKindOnly) {
  const std::string text = sign_text("a = 1\n", "kind-v1", kSite.root);
  const SignedText parts = split_signed(text, "f");
  EXPECT_EQ(parts.body, "a = 1\n");
  EXPECT_NO_THROW(require_signed(parts, "kind-v1", kSite.root.public_key(), "f"));
  EXPECT_THROW(require_signed(parts, "other-v1", kSite.root.public_key(), "f"), ConfigError);
  EXPECT_THROW(require_signed(parts, "kind-v1", kSite.stranger.public_key(), "f"), ConfigError);
}

TEST(SignedText, TheLastSignatureIsThatOfAllBeforeIt) {
  const std::string once = sign_text("a = 1\n", "kind-v1", kSite.root);
  const std::string twice = sign_text(once, "kind-v1", kSite.stranger);
  EXPECT_EQ(split_signed(twice, "f").body, once);
  EXPECT_THROW(require_signed(split_signed(twice, "f"), "kind-v1", kSite.root.public_key(), "f"),
               ConfigError);
}

TEST(SignedText, WithoutASignatureItIsNone) {
  for (const char* text : {"", "a = 1\n", "x # signature 00\n", "# signature 12\n"}) {
    EXPECT_THROW(split_signed(text, "f"), ConfigError) << text;
  }
}

}  // namespace
}  // namespace ols::trust
