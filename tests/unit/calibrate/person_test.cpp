#include "tools/calibrate/person.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

#include "geometry/angles.h"
#include "tests/unit/temporary_folder.h"

namespace ols::calibration {
namespace {

TEST(Person, AnswersAreLines) {
  EXPECT_EQ(answer_of("confirm").choice, "confirm");
  for (const char* word : {"again", "filter_on", "filter_off", "sight", "done"}) {
    EXPECT_EQ(answer_of(word).choice, word);
  }
  const Answer point = answer_of("point 640.25 480");
  EXPECT_EQ(point.choice, "point");
  EXPECT_EQ(*point.pixel, Eigen::Vector2d(640.25, 480.0));
  const Answer turn = answer_of("turn 2.5 -1");
  EXPECT_NEAR(turn.turn.pan_rad, radians(2.5), 1e-12);
  EXPECT_NEAR(turn.turn.tilt_rad, radians(-1.0), 1e-12);
}

TEST(Person, WhatIsNoAnswerIsNamed) {
  for (const char* line :
       {"", "yes", "point", "point 3", "point nan 4", "turn 1", "turn 4000 0", "confirm 3"}) {
    EXPECT_THROW(answer_of(line), std::invalid_argument) << line;
  }
}

TEST(Person, AScriptAnswersInOrderThenNobodyDoes) {
  const TemporaryFolder folder;
  const std::string path = folder.path() + "/script";
  std::ofstream(path) << "# the first is the spire\nconfirm\n\nskip  # not to be seen\n";
  Person person(path);
  EXPECT_FALSE(person.is_silent());
  EXPECT_EQ(person.answer()->choice, "confirm");
  EXPECT_EQ(person.answer()->choice, "skip");
  EXPECT_FALSE(person.answer());
  EXPECT_TRUE(person.is_silent());
}

// Standard input as a pipe, for the time of a test.
class TypedInput {
 public:
  TypedInput() : kept_(::dup(STDIN_FILENO)) {
    EXPECT_EQ(::pipe(ends_), 0);
    ::dup2(ends_[0], STDIN_FILENO);
  }
  ~TypedInput() {
    ::dup2(kept_, STDIN_FILENO);
    for (const int end : {ends_[0], ends_[1], kept_}) ::close(end);
  }
  TypedInput(const TypedInput&) = delete;
  TypedInput& operator=(const TypedInput&) = delete;
  void type(const std::string& text) const {
    EXPECT_EQ(::write(ends_[1], text.data(), text.size()), static_cast<ssize_t>(text.size()));
  }

 private:
  int kept_;
  int ends_[2]{};
};

TEST(Person, AKeyPressedTwiceDoesNotAnswerTheNextQuestionUnseen) {
  const TypedInput keyboard;
  Person person("");
  person.ask({});
  keyboard.type("confirm\nconfirm\n");
  EXPECT_EQ(person.answer()->choice, "confirm");
  keyboard.type("confirm\n");
  person.ask({});
  EXPECT_FALSE(person.answer());
  keyboard.type("skip\n");
  EXPECT_EQ(person.answer()->choice, "skip");
}

TEST(Person, AnAbortTypedBeforeTheQuestionStands) {
  const TypedInput keyboard;
  Person person("");
  keyboard.type("confirm\nabort\nconfirm\n");
  person.ask({});
  EXPECT_EQ(person.answer()->choice, "abort");
}

TEST(Person, ABadScriptIsNamedWithItsLine) {
  const TemporaryFolder folder;
  const std::string path = folder.path() + "/script";
  std::ofstream(path) << "confirm\nperhaps\n";
  EXPECT_THAT([&] { Person person(path); }, testing::ThrowsMessage<std::runtime_error>(
                                                testing::HasSubstr("script:2: 'perhaps'")));
  EXPECT_THROW(Person("/nonexistent/script"), std::runtime_error);
}

}  // namespace
}  // namespace ols::calibration
