#include "edge/ptu/start_sequence.h"

#include <gtest/gtest.h>

#include <map>

#include "tests/unit/edge/ptu/unit_replies.h"

namespace ols::ptu {
namespace {

// Answers like a D46 until the sequence asks for `command`, or until it is done.
class Dialogue {
 public:
  explicit Dialogue(const PtuStartOptions& options = {}) : sequence(options) {}

  std::string asked() const { return sequence.request().bytes(); }
  PtuReply answer() const {
    const auto known = answers.find(asked());
    return known == answers.end() ? reply() : reply(known->second);
  }
  bool until(const std::string& command) {
    while (!sequence.done() && asked() != command) {
      sent += asked();
      if (!sequence.take(answer())) return false;
    }
    return !sequence.done();
  }

  std::map<std::string, std::string> answers{
      {"C ", "i"},       {"V ", "v2.14.0"}, {"PR ", "11.5714"}, {"TR ", "11.5714"},
      {"PN ", "-49467"}, {"PX ", "49467"},  {"TN ", "-14622"},  {"TX ", "9644"},
      {"PL ", "57"},     {"PU ", "18700"},  {"TL ", "57"},      {"TU ", "18700"},
      {"PA ", "17825"},  {"TA ", "17825"}};
  PtuStartSequence sequence;
  std::string sent;
};

TEST(PtuStartSequence, HaltsTheUnitBeforeAnythingElseIsSet) {
  Dialogue d;
  d.until("CI ");
  EXPECT_EQ(d.sent, "ED FT H ");
}

TEST(PtuStartSequence, EndsWithWhatTheUnitStates) {
  Dialogue d;
  d.until("");
  ASSERT_TRUE(d.sequence.done());
  const PtuFacts& facts = d.sequence.facts();
  EXPECT_NEAR(facts.pan.resolution_rad, radians(11.5714 / 3600.0), 1e-15);
  EXPECT_EQ(facts.pan.min, -49467);
  EXPECT_EQ(facts.tilt.max, 9644);
  EXPECT_EQ(facts.tilt.upper_speed, 18700);
  EXPECT_EQ(facts.pan.acceleration, 17825);
  EXPECT_EQ(facts.firmware, "v2.14.0");
}

TEST(PtuStartSequence, AsksUntilTwoAnswersInARowAgree) {
  Dialogue d;
  ASSERT_TRUE(d.until("PX "));
  for (const char* answer : {"49467", "4946", "49467"}) {
    EXPECT_TRUE(d.sequence.take(reply(answer)));
    EXPECT_EQ(d.asked(), "PX ");
  }
  EXPECT_TRUE(d.sequence.take(reply("49467")));
  EXPECT_NE(d.asked(), "PX ");
  EXPECT_EQ(d.sequence.facts().pan.max, 49467);
}

TEST(PtuStartSequence, GivesUpWhenAnswersNeverAgree) {
  Dialogue d;
  ASSERT_TRUE(d.until("PX "));
  int asked = 1;
  while (d.sequence.take(reply(std::to_string(asked))) && asked < 50) ++asked;
  EXPECT_EQ(asked, 8);
}

TEST(PtuStartSequence, RefusesAUnitThatMustBeHomed) {
  Dialogue d;
  d.answers["PX "] = "-49467";  // no travel between its ends
  EXPECT_FALSE(d.until(""));
  EXPECT_TRUE(d.sequence.not_referenced());
  Dialogue other;
  ASSERT_TRUE(other.until("PN "));
  const PtuReply error = refusal("Axis Error");
  EXPECT_FALSE(other.sequence.take(error) && other.sequence.take(error));
  EXPECT_TRUE(other.sequence.not_referenced());
}

TEST(PtuStartSequence, ChangesTheBaudRateWhenAskedTo) {
  PtuStartOptions options;
  options.change_baud_to = 38400;
  Dialogue d(options);
  ASSERT_TRUE(d.until("@(38400,0,F) "));
  EXPECT_TRUE(d.sequence.take(reply()));
  EXPECT_TRUE(d.sequence.changed_baud());
  d.sequence.take(reply());
  EXPECT_FALSE(d.sequence.changed_baud());
}

TEST(PtuStartSequence, SetsAnAccelerationOnlyWhenItDiffers) {
  Dialogue same;
  same.until("");
  EXPECT_EQ(same.sent.find("PA17825"), std::string::npos);
  Dialogue other;
  other.answers["PA "] = "2000";
  other.until("");
  EXPECT_NE(other.sent.find("PA17825 "), std::string::npos);
}

TEST(PtuStartSequence, WaitsLongerForASlowCommand) {
  Dialogue d;
  EXPECT_EQ(d.sequence.timeout_s(0.5), 0.5);
  ASSERT_TRUE(d.until("A "));
  EXPECT_TRUE(d.sequence.slow());
  EXPECT_EQ(d.sequence.timeout_s(0.5), 10.0);
}

}  // namespace
}  // namespace ols::ptu
