#include "edge/ptu/reference_doubt.h"

#include <gtest/gtest.h>

namespace ols::ptu {
namespace {

TEST(PtuReferenceDoubt, EachStateHasItsWordAndIsReadBackFromIt) {
  struct Case {
    std::optional<PtuReferenceDoubt> doubt;
    const char* word;
  };
  std::vector<std::string> words;
  for (const auto& [doubt, word] : {Case{std::nullopt, "none"},
                                    {PtuReferenceDoubt{false, false}, "reference"},
                                    {PtuReferenceDoubt{true, false}, "homing"},
                                    {PtuReferenceDoubt{false, true}, "gears"},
                                    {PtuReferenceDoubt{true, true}, "homing-gears"}}) {
    EXPECT_EQ(to_word(doubt), word);
    EXPECT_EQ(doubt_from_word(word), doubt);
    words.emplace_back(word);
  }
  EXPECT_EQ(words, doubt_words());
}

TEST(PtuReferenceDoubt, AnUnknownWordIsTheGravestDoubt) {
  for (const char* word : {"", "None", "none ", "gears-homing"}) {
    EXPECT_EQ(doubt_from_word(word), (PtuReferenceDoubt{true, true})) << word;
  }
}

TEST(PtuReferenceDoubt, EachCauseSaysWhatToDo) {
  for (const PtuDoubtCause cause :
       {PtuDoubtCause::kPowerCycle, PtuDoubtCause::kLimitHit, PtuDoubtCause::kHomingInterrupted,
        PtuDoubtCause::kBeforeStart}) {
    EXPECT_NE(std::string(describe(cause)).find("home it"), std::string::npos);
  }
}

}  // namespace
}  // namespace ols::ptu
