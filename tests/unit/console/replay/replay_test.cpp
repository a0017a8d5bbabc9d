#include "console/replay/replay.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "tests/unit/base/bus/log_file.h"

namespace ols::console {
namespace {

// Two minutes: a target that goes north by a degree a minute, the paper's estimate of it half a
// degree away, an alarm from 30 s to 31 s, a stop at 60 s.
std::string two_minutes() {
  std::string log;
  for (std::int64_t tenth = 0; tenth <= 1200; ++tenth) {
    const std::int64_t utime_us = kStart_us + 100'000 * tenth;
    const bool has_alarm = tenth >= 300 && tenth < 310;
    if (tenth % 5 == 0) {
      log += logged_status(utime_us, tenth > 600 ? 1.0 : 0.0, has_alarm ? "ptu: hot" : "");
    }
    const double latitude_deg = static_cast<double>(tenth) / 600.0;
    log += logged_target(utime_us, latitude_deg);
    log += logged_target(utime_us, latitude_deg + 0.5, false, "OLS_TARGET_PAPER");
    if (tenth == 600) log += logged_stop(utime_us) + logged_reply(utime_us);
  }
  return log + logged_target(kStart_us + 120'050'000, 2.0, true);
}

class ReplayTest : public testing::Test {
 protected:
  void say(const std::string& text) { console_.take(viewer_, text, {0.0, 0}); }
  void seek(double s) {
    say(R"({"do":"replay","number":1,"at_us":)" +
        std::to_string(kStart_us + static_cast<std::int64_t>(s * 1e6)) + R"(,"playing":false})");
  }
  // Turns of ten milliseconds.
  void turn(Replay& replay, int times) {
    for (int i = 0; i < times; ++i) replay.turn(now_s_ += 0.01);
  }
  Json state() const { return console_.state({now_s_, 1}); }
  double latitude_deg() const { return state().at("targets").at(0).at("latitude_deg"); }

  Console console_{60.0};
  std::uint64_t viewer_ = console_.open("ana", Role::kOperator);
  double now_s_ = 100.0;
};

TEST_F(ReplayTest, PlaysAtTheTimesOfTheLog) {
  const LogFile log(two_minutes());
  Replay replay(log.path(), {}, console_);
  turn(replay, 1000);
  EXPECT_NEAR(latitude_deg(), 10.0 / 60.0, 0.003);
  EXPECT_EQ(state().at("time_us"), state().at("replay").at("at_us"));
  EXPECT_EQ(state().at("replay").at("read"), 1.0);
  say(R"({"do":"replay","number":1,"speed":10})");
  turn(replay, 500);
  EXPECT_NEAR(latitude_deg(), 1.0, 0.003);
  say(R"({"do":"replay","number":1,"playing":false})");
  turn(replay, 500);
  EXPECT_NEAR(latitude_deg(), 1.0, 0.003);
}

TEST_F(ReplayTest, AJumpShowsWhatPlayingUpToThereShows) {
  const LogFile log(two_minutes());
  Replay replay(log.path(), {}, console_);
  turn(replay, 10);
  Json of_jump, of_play;
  for (const double s : {90.0, 10.0, 11.0, 47.0, 119.0, 0.0, 65.05}) {
    seek(s);
    turn(replay, 5);
    EXPECT_NEAR(s == 0.0 ? 0.0 : latitude_deg(), s / 60.0, 0.002) << s;
  }
  of_jump = state();
  seek(0.0);
  turn(replay, 5);
  say(R"({"do":"replay","number":1,"playing":true})");
  while (state().at("time_us") < kStart_us + 65'050'000) turn(replay, 1);
  of_play = state();
  EXPECT_EQ(of_jump.at("targets").at(0).at("latitude_deg"),
            of_play.at("targets").at(0).at("latitude_deg"));
  EXPECT_EQ(of_jump.at("stations"), of_play.at("stations"));
  EXPECT_EQ(of_jump.at("events"), of_play.at("events"));
}

TEST_F(ReplayTest, AJumpShowsWhereThePicturesDisagreedThen) {
  std::string bytes;
  for (std::int64_t s = 0; s < 60; ++s) {
    bytes += logged_status(kStart_us + 1'000'000 * s);
    if (s == 5 || s == 40) {
      bytes +=
          logged_skyline(kStart_us + 1'000'000 * s, s == 5 ? std::int16_t{1} : std::int16_t{2});
    }
  }
  const LogFile log(bytes);
  Replay replay(log.path(), {}, console_);
  turn(replay, 10);
  const auto azimuth_deg = [this] {
    return console_.seen_skyline("alfa").at("differing").at(0).at(0).get<double>();
  };
  for (const double s : {50.0, 20.0, 41.0}) {
    seek(s);
    turn(replay, 5);
    EXPECT_NEAR(azimuth_deg(), s < 40.0 ? 0.075 : 0.125, 1e-9) << s;
  }
  seek(2.0);
  turn(replay, 5);
  EXPECT_TRUE(console_.seen_skyline("alfa").at("differing").empty());
}

TEST_F(ReplayTest, TheTimelineHasAlarmsCommandsAndTargets) {
  const LogFile log(two_minutes());
  Replay replay(log.path(), {}, console_);
  turn(replay, 10);
  std::string kinds;
  for (const Json& mark : console_.timeline().at("marks")) {
    kinds += mark.at("kind").get<std::string>() + " ";
    if (mark.at("kind") == "command") {
      EXPECT_EQ(mark.at("outcome"), "done");
    }
  }
  EXPECT_EQ(kinds, "birth alarm alarm_over command end ");
}

TEST_F(ReplayTest, NoCommandGoesOut) {
  const LogFile log(two_minutes());
  Replay replay(log.path(), {}, console_);
  turn(replay, 10);
  say(R"({"do":"command","number":5,"station":"alfa","command":"stop"})");
  say(R"({"do":"stop_all","number":6})");
  say(R"({"do":"take","number":7,"station":"alfa"})");
  int refusals = 0;
  while (const auto next = console_.next(viewer_, {now_s_, 0})) {
    const Json message = Json::parse(next->bytes);
    if (message.at("kind") != "answer") continue;
    EXPECT_FALSE(message.at("accepted"));
    EXPECT_EQ(message.at("why"), "this is a replay: commands are not sent");
    ++refusals;
  }
  EXPECT_EQ(refusals, 3);
  EXPECT_TRUE(console_.turn({now_s_, 0}).empty());
}

TEST_F(ReplayTest, EndsAtTheEndAndCanBeginAgain) {
  const LogFile log(two_minutes());
  Replay replay(log.path(), {}, console_);
  say(R"({"do":"replay","number":1,"speed":100})");
  turn(replay, 300);
  EXPECT_FALSE(state().at("replay").at("playing"));
  EXPECT_EQ(state().at("time_us"), kStart_us + 120'050'000);
  EXPECT_TRUE(state().at("targets").empty());
  seek(1.0);
  turn(replay, 5);
  EXPECT_NEAR(latitude_deg(), 1.0 / 60.0, 0.002);
}

TEST_F(ReplayTest, EachViewerIsSentTheWholeStateOfAJump) {
  const LogFile log(two_minutes());
  Replay replay(log.path(), {}, console_);
  turn(replay, 10);
  while (console_.next(viewer_, {now_s_, 0})) {
  }
  seek(40.0);
  turn(replay, 3);
  const auto next = console_.next(viewer_, {now_s_, 0});
  ASSERT_TRUE(next);
  const Json message = Json::parse(next->bytes);
  EXPECT_EQ(message.at("kind"), "snapshot");
  EXPECT_FALSE(message.at("replay").at("playing"));
}

TEST_F(ReplayTest, DamageIsSaidAndTheRestShown) {
  const std::string whole = two_minutes();
  const LogFile log("garbage" + whole.substr(0, whole.size() - 3));
  Replay replay(log.path(), {}, console_);
  turn(replay, 10);
  const std::string problem = state().at("replay").at("problem");
  EXPECT_NE(problem.find("bytes of the log are damaged, the first is byte 0; "), std::string::npos);
  EXPECT_NE(problem.find("the end is cut off"), std::string::npos);
  EXPECT_EQ(state().at("stations").size(), 1U);
}

TEST_F(ReplayTest, AFileThatIsNoLogIsNamed) {
  const LogFile log("this is a letter, not a log");
  try {
    Replay replay(log.path(), {}, console_);
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_TRUE(std::string(error.what()).starts_with(log.path()));
  }
}

}  // namespace
}  // namespace ols::console
