#include "cue/text_time.h"

#include <gtest/gtest.h>

namespace ols::cues {
namespace {

TEST(TextTime, IsTheInstantThatItNames) {
  EXPECT_EQ(utime_of_iso("1970-01-01T00:00:00Z"), 0);
  EXPECT_EQ(utime_of_iso("2026-11-23T10:15:30.250Z"), 1'795'428'930'250'000);  // date -u +%s
  EXPECT_EQ(utime_of_iso("2024-02-29T23:59:59.999999Z"), 1'709'251'199'999'999);
}

TEST(TextTime, AnythingElseIsNone) {
  for (const char* text :
       {"", "2026-11-23", "2026-11-23T10:15:30", "2026-13-23T10:15:30Z", "2026-11-23T24:15:30Z",
        "2026-11-23T10:15:30Zx", "2026-11-23T10:15:nanZ", "1969-11-23T10:15:30Z",
        "2026-11-23T10:15:-1Z", "2026-11-23T10:15:infZ"}) {
    EXPECT_FALSE(utime_of_iso(text)) << text;
  }
}

}  // namespace
}  // namespace ols::cues
