#include "edge/tracker/target_tracker.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

namespace ols::tracker {
namespace {

TEST(TrackerError, HasATextOfItsOwn) {
  std::set<std::string> texts;
  for (int error = 0; error <= static_cast<int>(TrackerError::kBox); ++error) {
    texts.insert(to_string(static_cast<TrackerError>(error)));
  }
  EXPECT_EQ(texts.size(), 7U);
  EXPECT_EQ(texts.count("unknown"), 0U);
}

}  // namespace
}  // namespace ols::tracker
