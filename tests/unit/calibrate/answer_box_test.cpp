#include "tools/calibrate/answer_box.h"

#include <gtest/gtest.h>

#include <limits>

#include "geometry/angles.h"

namespace ols::calibration {
namespace {

constexpr std::int64_t kNow_us = 1'780'000'000'000'000, kSecond_us = 1'000'000;

ols_msg::procedure_answer_t message(const std::string& choice, std::int64_t sequence,
                                    std::int64_t question = 7) {
  ols_msg::procedure_answer_t answer{};
  answer.utime = kNow_us;
  answer.boot_id = 3;
  answer.sequence = sequence;
  answer.lease_s = 2.0;
  answer.question = question;
  answer.choice = choice;
  return answer;
}

class AnswerBoxTest : public testing::Test {
 protected:
  AnswerBoxTest() { box.ask(7); }
  AnswerBox box;
};

TEST_F(AnswerBoxTest, TheFirstAnswerToTheStandingQuestionIsTakenOnce) {
  box.hear(message("skip", 1, 6), kNow_us);
  box.hear(message("confirm", 2), kNow_us);
  box.hear(message("skip", 3), kNow_us);
  EXPECT_EQ(box.take(7)->choice, "confirm");
  EXPECT_FALSE(box.take(7));
}

TEST_F(AnswerBoxTest, AnAbortGetsThroughAFloodOfStrayAnswers) {
  for (int i = 0; i < 100; ++i) box.hear(message("confirm", i, 6), kNow_us);
  box.hear(message("abort", 200, 0), kNow_us);
  EXPECT_TRUE(box.take_abort());
  EXPECT_FALSE(box.take_abort());
}

TEST_F(AnswerBoxTest, AnswersToAQuestionThatDoesNotStandAreDropped) {
  box.hear(message("confirm", 1), kNow_us);
  box.ask(8);
  EXPECT_FALSE(box.take(8));
  box.ask(0);
  box.hear(message("confirm", 2, 0), kNow_us);
  EXPECT_FALSE(box.take(0));
}

TEST_F(AnswerBoxTest, EachNumberOfASenderIsTakenOnce) {
  box.hear(message("confirm", 1), kNow_us);
  EXPECT_TRUE(box.take(7));
  box.hear(message("confirm", 1), kNow_us);
  EXPECT_FALSE(box.take(7));
  box.hear(message("confirm", 2), kNow_us);
  EXPECT_TRUE(box.take(7));
}

TEST_F(AnswerBoxTest, OldOnesAreRefusedWhateverTheirLease) {
  auto old = message("confirm", 1);
  old.lease_s = 1e9;
  box.hear(old, kNow_us + 11 * kSecond_us);
  EXPECT_FALSE(box.take(7));
  old.lease_s = std::numeric_limits<double>::quiet_NaN();
  box.hear(old, kNow_us);
  EXPECT_FALSE(box.take(7));
}

TEST_F(AnswerBoxTest, NumbersOutOfRangeAreRefused) {
  for (const double turn_deg : {1e9, std::nan(""), std::numeric_limits<double>::infinity()}) {
    auto turn = message("turn", 1);
    turn.turn_deg[1] = turn_deg;
    box.hear(turn, kNow_us);
    EXPECT_FALSE(box.take(7)) << turn_deg;
  }
  auto point = message("point", 2);
  point.has_pixel = 1;
  point.pixel_px[0] = 1e300;
  box.hear(point, kNow_us);
  EXPECT_FALSE(box.take(7));
  auto turn = message("turn", 3);
  turn.turn_deg[0] = 2.0;
  box.hear(turn, kNow_us);
  EXPECT_NEAR(box.take(7)->turn.pan_rad, radians(2.0), 1e-12);
}

}  // namespace
}  // namespace ols::calibration
