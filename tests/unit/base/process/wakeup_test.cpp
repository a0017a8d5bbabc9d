#include "base/process/wakeup.h"

#include <gtest/gtest.h>
#include <poll.h>
#include <sys/resource.h>

#include <system_error>

namespace ols {
namespace {

bool is_set(const Wakeup& wakeup) {
  pollfd entry{wakeup.descriptor(), POLLIN, 0};
  return ::poll(&entry, 1, 0) == 1;
}

TEST(Wakeup, StaysSetUntilCleared) {
  Wakeup wakeup;
  EXPECT_FALSE(is_set(wakeup));
  wakeup.set();
  wakeup.set();
  EXPECT_TRUE(is_set(wakeup));
  EXPECT_TRUE(is_set(wakeup));
  wakeup.clear();
  EXPECT_FALSE(is_set(wakeup));
  wakeup.clear();  // does not wait
}

TEST(Wakeup, ThrowsWithoutADescriptor) {
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_NOFILE, &before), 0);
  const rlimit none{0, before.rlim_max};
  ASSERT_EQ(::setrlimit(RLIMIT_NOFILE, &none), 0);
  EXPECT_THROW(Wakeup{}, std::system_error);
  EXPECT_EQ(::setrlimit(RLIMIT_NOFILE, &before), 0);
}

}  // namespace
}  // namespace ols
