#include "tools/key/invitation.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "tests/unit/base/trust/site_fixture.h"

namespace ols::key {
namespace {

const trust::Site kSite;

TEST(Invitation, IsReadAsItWasWritten) {
  const Invitation invitation{kSite.secret, kSite.root.public_key()};
  const std::string text = to_text(invitation);
  EXPECT_EQ(text.size(), 128U);
  const Invitation again = invitation_from(text);
  EXPECT_EQ(again.site, invitation.site);
  EXPECT_EQ(again.root, invitation.root);
}

TEST(Invitation, AnythingElseIsRefused) {
  const std::string good = to_text({kSite.secret, kSite.root.public_key()});
  std::string no_digit = good;
  no_digit.back() = 'g';
  for (const std::string& bad : {std::string(), good.substr(1), good + "0", no_digit}) {
    EXPECT_THROW(invitation_from(bad), std::invalid_argument) << bad;
  }
}

}  // namespace
}  // namespace ols::key
