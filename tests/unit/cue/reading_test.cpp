#include "cue/reading.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

namespace ols::cues {
namespace {

TEST(Reading, EachRefusalHasANameOfItsOwn) {
  std::set<std::string> names;
  for (int i = 0; i < static_cast<int>(Refusal::kCount); ++i) {
    names.insert(to_string(static_cast<Refusal>(i)));
  }
  EXPECT_EQ(names.size(), static_cast<std::size_t>(Refusal::kCount));
  EXPECT_FALSE(names.contains("unknown"));
}

}  // namespace
}  // namespace ols::cues
