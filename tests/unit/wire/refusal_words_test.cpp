#include "wire/refusal_words.h"

#include <gtest/gtest.h>

namespace ols::wire {
namespace {

TEST(RefusalWords, ARefusalIsASentenceAndWhatTheStationAdds) {
  EXPECT_EQ(refusal_in_words({.reason = "just_stopped"}),
            "refused: it was stopped less than a second ago; try again");
  const Outcome full = refusal_in_words({.reason = "recorder", .detail = "disk full"});
  EXPECT_EQ(full, "refused: the recorder does not record: disk full");
  EXPECT_EQ(full.id, "order_refused");
  EXPECT_EQ(full.parameters,
            (Outcome::Parameters{{"reason", "recorder"}, {"detail", "disk full"}}));
  EXPECT_EQ(refusal_in_words({.reason = "of_the_future"}), "refused: of_the_future");
}

}  // namespace
}  // namespace ols::wire
