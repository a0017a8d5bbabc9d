#include "tools/setup/dialogue.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>
#include <stdexcept>

#include "tests/unit/setup/answers_fixture.h"
#include "tools/setup/answers.h"

namespace ols::setup {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::string answer(const std::string& typed, const Values& known = {}) {
  std::istringstream in(typed);
  std::ostringstream out;
  return ask_all(in, out, known, not_fitting);
}

const std::string kTyped = "station\neth0\n\n" +
                           key::to_text({kSite.secret, kSite.root.public_key()}) +
                           "\nalfa\n49.2\n16.6\n310\n45\n\n\n13333.3\n13333.3\n";

TEST(Dialogue, WhatIsTypedIsWhatAFileWouldSay) {
  const Answers answers = read_answers(answer(kTyped), "answers");
  EXPECT_EQ(answers.station, "alfa");
  EXPECT_EQ(answers.interface, "eth0");
  EXPECT_EQ(*find(answers.values, "station.calibration.sd.heading_deg"), "0.5");
  const Answers centre =
      read_answers(answer("centre\neth0\n10.0.0.2, 10.0.0.3 fd00::2\nairfield\n\n"), "answers");
  EXPECT_EQ(centre.site, "airfield");
  EXPECT_EQ(centre.root, "/media/root.key");
  EXPECT_THAT(answers.neighbours, IsEmpty());
  EXPECT_THAT(centre.neighbours, ElementsAre("10.0.0.2", "10.0.0.3", "fd00::2"));
}

TEST(Dialogue, AWrongAnswerIsAskedAgain) {
  std::string typed = kTyped;
  typed.replace(typed.find("49.2"), 4, "north\n1e400\n49.2");
  typed.replace(0, 7, "ship\nstation");
  EXPECT_EQ(*find(flat(answer(typed)), "station.pose.latitude_deg"), "49.2");
}

TEST(Dialogue, AnEmptyLineTakesTheAnswerOfBeforeAndWhatOnlyAFileSaysStays) {
  Values known = flat(answer(kTyped));
  known.emplace_back("station.tracker_seed", "7");
  const std::string again = answer(std::string(13, '\n'), known);
  EXPECT_EQ(flat(again), flat(as_toml(known)));
}

TEST(Dialogue, AnAnswerOfBeforeIsShownAndTakenAsItWasTyped) {
  const std::string path = "/media/Gr\u00fcn \"1\" \\ 2";
  std::istringstream in("\n\n\n\n\n");
  std::ostringstream out;
  const Values known = flat(answer("centre\neth0\n10.0.0.2\nairfield\n" + path + "\n"));
  EXPECT_EQ(flat(ask_all(in, out, known, not_fitting)), known);
  EXPECT_THAT(out.str(), HasSubstr("[" + path + "]"));
  EXPECT_EQ(text_in(*find(known, "root")), path);
}

TEST(Dialogue, AListOfBeforeIsShownAndCanBeMadeEmpty) {
  const Values known = flat(answer("centre\neth0\n10.0.0.2 10.0.0.3\nairfield\n\n"));
  std::istringstream in("\n\nnone\n\n\n");
  std::ostringstream out;
  const Values now = flat(ask_all(in, out, known, not_fitting));
  EXPECT_THAT(out.str(), HasSubstr("[10.0.0.2 10.0.0.3]"));
  EXPECT_EQ(texts_in(*find(now, "neighbours")), std::vector<std::string>{});
}

TEST(Dialogue, ATextThatIsNeededIsAskedForAgain) {
  std::istringstream in("\n \n/dev/ttyUSB0\n");
  std::ostringstream out;
  EXPECT_EQ(ask_text(in, out, "Which line?"), "/dev/ttyUSB0");
}

TEST(Dialogue, TheEndOfTheInputIsAnError) {
  EXPECT_THROW(answer("station\n"), std::runtime_error);
  EXPECT_THROW(answer("\n"), std::runtime_error) << "a role is needed";
}

TEST(Dialogue, OneOfSeveralIsPicked) {
  std::istringstream in("0\nx\n3\n2\n");
  std::ostringstream out;
  EXPECT_EQ(ask_which(in, out, "Which camera?", {"one", "two"}), "two");
  EXPECT_THAT(out.str(), HasSubstr("a number from 1 to 2"));
}

TEST(Dialogue, ANumberIsOneOfTheFileItGoesTo) {
  const Question question{"station.pose.heading_deg", "", Form::kNumber};
  for (const char* good : {"45", "-0.5", "12.25"}) EXPECT_EQ(not_fitting(question, good), "");
  for (const char* bad : {"045", ".5", "5.", "-07", "north"})
    EXPECT_NE(not_fitting(question, bad), "") << bad;
}

}  // namespace
}  // namespace ols::setup
