#include "tools/setup/site_time.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/base/trust/site_fixture.h"

namespace ols::setup {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

const trust::Site kSite;

TEST(SiteTime, EachNeighbourIsAskedWithTheSitesKey) {
  const std::string text = chrony_file({"10.0.0.2", "10.0.0.3"});
  EXPECT_THAT(text, HasSubstr("\nserver 10.0.0.2 iburst minpoll 4 maxpoll 6 key 7316\n"));
  EXPECT_THAT(text, HasSubstr("\nserver 10.0.0.3 "));
  EXPECT_THAT(text, HasSubstr("\nlocal stratum 10 orphan\n"));
  EXPECT_THAT(chrony_file({}), Not(HasSubstr("server ")));
}

// A pulse without its second is no time.
TEST(SiteTime, TheReceiversPulseIsNumberedByItsSentences) {
  const std::string text = receiver_chrony_file();
  EXPECT_THAT(text, HasSubstr("\nrefclock SHM 0 refid NMEA "));
  EXPECT_THAT(text, HasSubstr("\nrefclock SHM 1 refid PPS precision 1e-6 lock NMEA prefer\n"));
}

TEST(SiteTime, AllMembersOfASiteHaveOneKeyAndOthersAnother) {
  const std::string keys = with_time_key("", kSite.secret);
  EXPECT_THAT(keys, StartsWith("7316 SHA256 HEX:"));
  EXPECT_EQ(keys.size(), std::string("7316 SHA256 HEX:\n").size() + 64);
  EXPECT_EQ(keys, with_time_key("", kSite.secret));
  EXPECT_NE(keys, with_time_key("", trust::seed_of(8)));
  EXPECT_THAT(keys, Not(HasSubstr(trust::to_hex(kSite.secret).substr(0, 16))));
}

TEST(SiteTime, OtherKeysStayAndAnOldOneIsReplaced) {
  const std::string before = "# mine\n1 MD5 HEX:00\n7316 SHA256 HEX:00\n";
  const std::string after = with_time_key(before, kSite.secret);
  EXPECT_THAT(after, StartsWith("# mine\n1 MD5 HEX:00\n7316 SHA256 HEX:"));
  EXPECT_THAT(after, Not(HasSubstr("HEX:00\n7316 SHA256 HEX:00")));
  EXPECT_EQ(with_time_key(after, kSite.secret), after);
}

}  // namespace
}  // namespace ols::setup
