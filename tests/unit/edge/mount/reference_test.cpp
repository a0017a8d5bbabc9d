#include "edge/mount/reference.h"

#include <gtest/gtest.h>

namespace ols::mount {
namespace {

TEST(ReferenceDoubt, EachStateHasItsWordAndIsReadBackFromIt) {
  struct Case {
    std::optional<ReferenceDoubt> doubt;
    const char* word;
  };
  std::vector<std::string> words;
  for (const auto& [doubt, word] : {Case{std::nullopt, "none"},
                                    {ReferenceDoubt{false, false}, "reference"},
                                    {ReferenceDoubt{true, false}, "homing"},
                                    {ReferenceDoubt{false, true}, "gears"},
                                    {ReferenceDoubt{true, true}, "homing-gears"}}) {
    EXPECT_EQ(to_word(doubt), word);
    EXPECT_EQ(doubt_from_word(word), doubt);
    words.emplace_back(word);
  }
  EXPECT_EQ(words, doubt_words());
}

TEST(ReferenceDoubt, AnUnknownWordIsTheGravestDoubt) {
  for (const char* word : {"", "None", "none ", "gears-homing"}) {
    EXPECT_EQ(doubt_from_word(word), (ReferenceDoubt{true, true})) << word;
  }
}

}  // namespace
}  // namespace ols::mount
