#include "wire/refusal_words.h"

#include <gtest/gtest.h>

namespace ols::wire {
namespace {

TEST(RefusalWords, ARefusalIsASentenceAndWhatTheStationAdds) {
  EXPECT_EQ(refusal_in_words({.reason = "just_stopped"}),
            "refused: it was stopped less than a second ago; try again");
  EXPECT_EQ(refusal_in_words({.reason = "recorder", .detail = "disk full"}),
            "refused: the recorder does not record: disk full");
  EXPECT_EQ(refusal_in_words({.reason = "of_the_future"}), "refused: of_the_future");
}

TEST(RefusalWords, AStationsLastErrorIsASentence) {
  EXPECT_EQ(error_in_words("SLEW refused: precedence"),
            "slew refused: an operator has control, or has stopped it; release the station first");
  EXPECT_EQ(error_in_words("RECORD refused: disk full"), "RECORD refused: disk full");
  EXPECT_EQ(error_in_words("ptu: no reply"), "ptu: no reply");
}

}  // namespace
}  // namespace ols::wire
