#include "tools/logger/log_names.h"

#include <gtest/gtest.h>

#include "tests/unit/temporary_folder.h"

namespace ols::logger {
namespace {

constexpr std::int64_t kUtime_us = 1'767'225'600'000'000;  // 2026-01-01

TEST(LogNames, AreOfTheirTimeAndNumbered) {
  const TemporaryFolder folder;
  LogNames names(folder.path(), "site");
  EXPECT_EQ(names.next(kUtime_us), folder / "site-20260101T000000Z.lcmlog.00");
  EXPECT_EQ(names.next(kUtime_us + 1), folder / "site-20260101T000000Z.lcmlog.01");
  EXPECT_EQ(names.next(kUtime_us + 1'000'000), folder / "site-20260101T000001Z.lcmlog.00");
}

TEST(LogNames, NoneIsTakenThatIsThere) {
  const TemporaryFolder folder;
  folder.put("site-20260101T000000Z.lcmlog.00", 1, 0);
  EXPECT_EQ(LogNames(folder.path(), "site").next(kUtime_us),
            folder / "site-20260101T000000Z.lcmlog.01");
}

}  // namespace
}  // namespace ols::logger
