#include "console/procedures.h"

#include <gtest/gtest.h>

namespace ols::console {
namespace {

ReceivedProcedure asking(std::int64_t question, const std::string& jpeg = "JPEG") {
  return {"alfa", {{"step", "spire"}}, question, {"confirm", "point", "skip"}, jpeg};
}

TEST(Procedures, APictureHasANumberThatIsNewOnlyWithIt) {
  Procedures procedures;
  const Json first = procedures.receive(asking(1));
  EXPECT_EQ(first.at("step"), "spire");
  EXPECT_EQ(first.at("picture"), 1);
  EXPECT_EQ(procedures.receive(asking(1)).at("picture"), 1) << "said again";
  EXPECT_EQ(procedures.receive(asking(2, "OTHER")).at("picture"), 2);
  ASSERT_TRUE(procedures.picture("alfa"));
  EXPECT_EQ(*procedures.picture("alfa"), "OTHER");
  EXPECT_EQ(procedures.receive(asking(0, "")).at("picture"), 0);
  EXPECT_FALSE(procedures.picture("alfa"));
  EXPECT_FALSE(procedures.picture("bravo"));
}

TEST(Procedures, AnAnswerIsJudgedByTheQuestionThatStands) {
  Procedures procedures;
  EXPECT_NE(procedures.answer({"alfa", 1, "confirm", {}, {}}), "") << "none is heard";
  procedures.receive(asking(7));
  EXPECT_NE(procedures.answer({"alfa", 6, "confirm", {}, {}}), "") << "an old question";
  EXPECT_NE(procedures.answer({"alfa", 7, "accept", {}, {}}), "") << "not one of its answers";
  EXPECT_NE(procedures.answer({"alfa", 7, "point", {}, {}}), "") << "without a pixel";
  EXPECT_TRUE(procedures.take().empty());
  EXPECT_EQ(procedures.answer({"alfa", 7, "point", std::array{3.0, 4.0}, {}}), "");
  EXPECT_EQ(procedures.answer({"alfa", 0, "abort", {}, {}}), "") << "at any time";
  const auto answers = procedures.take();
  ASSERT_EQ(answers.size(), 2U);
  EXPECT_EQ(answers[0].pixel_px, (std::array{3.0, 4.0}));
  EXPECT_EQ(answers[1].choice, "abort");
  EXPECT_TRUE(procedures.take().empty());
  procedures.receive(asking(0));
  EXPECT_NE(procedures.answer({"alfa", 0, "confirm", {}, {}}), "") << "no question stands";
}

TEST(Procedures, AStationThatIsForgottenHasNone) {
  Procedures procedures;
  procedures.receive(asking(1));
  procedures.keep_only([](const std::string& id) { return id != "alfa"; });
  EXPECT_FALSE(procedures.picture("alfa"));
  EXPECT_NE(procedures.answer({"alfa", 1, "confirm", {}, {}}), "");
}

TEST(Procedures, OneThatHasEndedTakesNoAnswer) {
  Procedures procedures;
  auto ended = asking(0);
  ended.is_at_work = false;
  procedures.receive(ended);
  EXPECT_EQ(procedures.answer({"alfa", 0, "abort", {}, {}}), "refused: the procedure has ended");
  EXPECT_TRUE(procedures.take().empty());
}

TEST(Procedures, AFloodOfAnswersIsBounded) {
  Procedures procedures;
  procedures.receive(asking(1));
  for (int i = 0; i < 64; ++i) EXPECT_EQ(procedures.answer({"alfa", 1, "skip", {}, {}}), "");
  EXPECT_NE(procedures.answer({"alfa", 1, "skip", {}, {}}), "");
}

}  // namespace
}  // namespace ols::console
