#include "edge/ptu/steady_state.h"

#include <gtest/gtest.h>

#include <functional>

#include "tests/unit/edge/ptu/unit_replies.h"

namespace ols::ptu {
namespace {

using Kind = PtuSteadyState::Trouble::Kind;

// A ready unit that stands at zero and answers every command of a request at once.
class SteadyState : public testing::Test {
 protected:
  static PtuConfig config() {
    PtuConfig made;
    made.environment_interval_s = 0.0;
    return made;
  }
  PtuReply answer(const std::string& command, double time_s) const {
    const bool position = command == "PP" || command == "TP";
    PtuReply made = position ? reply("0") : reply();
    if (command == "C") made = reply("i");
    if (command == "PA") made = reply("18000");
    if (change) change(command, made);
    made.began_s = made.ended_s = time_s;
    return made;
  }
  // Goes on by milliseconds; the requests that were sent.
  std::string run(double duration_s, bool emergency = false) {
    std::string sent;
    for (const double end_s = time_s_ + duration_s; time_s_ < end_s && !unit_.trouble();) {
      time_s_ += 1e-3;
      if (goal) unit_.set_goal(mount::Goal{time_s_, *goal, {}, time_s_ + 0.5});
      const std::string request = unit_.step(emergency, time_s_);
      sent += request;
      if (request.empty() || silent) continue;
      unit_.bytes_came(time_s_);
      double at_s = time_s_;
      for (std::size_t from = 1, to; from < request.size(); from = to + 1) {
        to = request.find(' ', from);
        at_s += 1e-4;
        unit_.take(answer(request.substr(from, to - from), at_s), at_s, 0.0);
      }
    }
    return sent;
  }
  static bool moves(const std::string& sent) {
    return sent.find_first_of("0123456789") != std::string::npos;
  }

  std::function<void(const std::string& command, PtuReply&)> change;
  std::optional<PanTilt> goal;
  bool silent = false;
  PtuConfig config_ = config();
  PtuCounters counters_;
  double time_s_ = 10.0;
  PtuSteadyState unit_{config_, d46_facts(), 1e-5, time_s_, counters_};
};

TEST_F(SteadyState, PollsTheUnitAndSendsItToItsGoal) {
  EXPECT_FALSE(moves(run(0.2)));
  EXPECT_GE(unit_.take_samples().size(), 6u);
  EXPECT_TRUE(unit_.standing());
  goal = PanTilt{0.2, 0.0};
  const std::string sent = run(0.1);
  EXPECT_NE(sent.find("PS"), std::string::npos);
  EXPECT_EQ(counters_.timeouts + counters_.garbled + counters_.refused_positions, 0u);
}

// Of a cycle that is late all its lines come after it was given up.
TEST_F(SteadyState, ShortDisturbancesOfItsLineAreNoErrorUntilThereAreMany) {
  const auto disturb = [this] {
    silent = true;
    run(0.3);
    for (int i = 0; i < 20; ++i) unit_.take(reply(), time_s_, 0.0);
    silent = false;
    run(2.0);
  };
  run(0.1);
  for (int i = 0; i < 9; ++i) disturb();
  EXPECT_EQ(unit_.last_error(), "");
  EXPECT_GE(counters_.timeouts, 9U) << "they are counted all the same";
  disturb();
  EXPECT_EQ(unit_.last_error(), "replies are late, missing or garbled");
  EXPECT_FALSE(unit_.trouble());
}

TEST_F(SteadyState, MovesNothingBeforeItKnowsWhereTheUnitIs) {
  goal = PanTilt{0.2, 0.0};
  change = [](const std::string&, PtuReply& r) { r.echoed = true; };
  EXPECT_FALSE(moves(run(0.4)));
}

TEST_F(SteadyState, MovesNothingInAnEmergency) {
  run(0.1);
  goal = PanTilt{0.2, 0.0};
  EXPECT_FALSE(moves(run(0.5, true)));
}

TEST_F(SteadyState, HaltsAUnitThatIsNotSeenToStandInAnEmergency) {
  EXPECT_NE(run(0.003, true).find("H "), std::string::npos);
}

TEST_F(SteadyState, MovesNothingWhileTheUnitMayTakeSpeedsForVelocities) {
  run(0.1);
  goal = PanTilt{0.2, 0.0};
  change = [](const std::string& command, PtuReply& r) {
    if (command == "C") r = reply("v");
    r.echoed = command == "PP";
  };
  run(0.028);  // the cycle in which the echo shows
  EXPECT_EQ(counters_.echoes, 1u);
  goal = PanTilt{-0.2, 0.1};  // another one: there would be something new to send
  EXPECT_FALSE(moves(run(1.0)));
  ASSERT_TRUE(unit_.trouble());
  EXPECT_EQ(unit_.trouble()->kind, Kind::kRestarted);
}

TEST_F(SteadyState, GivesUpASilentUnit) {
  run(0.1);
  silent = true;
  run(1.0);
  ASSERT_TRUE(unit_.trouble());
  EXPECT_EQ(unit_.trouble()->kind, Kind::kNoReply);
  EXPECT_EQ(unit_.step(false, time_s_ + 1.0), "");
}

TEST_F(SteadyState, GivesUpAUnitWhosePositionsContradictEachOther) {
  run(0.1);
  int asked = 0;
  change = [&](const std::string& command, PtuReply& r) {
    if (command == "PP" && ++asked % 2 == 0) r = reply("5000");
  };
  run(1.5);
  ASSERT_TRUE(unit_.trouble());
  EXPECT_EQ(unit_.trouble()->kind, Kind::kNotItself);
  EXPECT_GT(counters_.refused_positions, 3u);
}

TEST_F(SteadyState, GivesUpAUnitThatRefusesItsBoundsSeveralTimes) {
  run(0.1);
  goal = PanTilt{0.2, 0.0};
  change = [](const std::string& command, PtuReply& r) {
    if (command.size() > 2 && command.starts_with("PP")) {
      r = refusal("Maximum allowable Pan position is 100");
    }
  };
  run(1.0);
  ASSERT_TRUE(unit_.trouble());
  EXPECT_EQ(unit_.trouble()->kind, Kind::kNotItself);
  EXPECT_EQ(counters_.errors, 3u);
}

TEST_F(SteadyState, NoticesAUnitThatMustBeHomed) {
  run(0.1);
  goal = PanTilt{0.2, 0.0};
  change = [](const std::string& command, PtuReply& r) {
    if (command.starts_with("PS")) r = refusal("Axis Error");
  };
  run(0.1);
  ASSERT_TRUE(unit_.trouble());
  EXPECT_EQ(unit_.trouble()->kind, Kind::kNotReferenced);
}

TEST_F(SteadyState, NoticesAUnitThatHomes) {
  PtuReply homed = reply();
  homed.limit_hits = PtuSteadyState::kHomingHits;
  unit_.take(homed, time_s_, 0.0);
  ASSERT_TRUE(unit_.trouble());
  EXPECT_EQ(unit_.trouble()->kind, Kind::kRestarted);
}

TEST_F(SteadyState, CountsAReplyThatItDidNotExpect) {
  unit_.take(reply("1"), time_s_, 0.0);
  EXPECT_EQ(counters_.garbled, 1u);
  EXPECT_FALSE(unit_.trouble());
}

TEST_F(SteadyState, AsksForTheEnvironmentAtItsInterval) {
  config_.environment_interval_s = 0.2;
  change = [](const std::string& command, PtuReply& r) {
    if (command == "O") r = reply("Input 30 VDC @ 86 degF");
  };
  const std::string sent = run(0.5);
  EXPECT_EQ(std::count(sent.begin(), sent.end(), 'O'), 3);
  ASSERT_TRUE(unit_.environment());
  EXPECT_EQ(unit_.environment()->supply_V, 30.0);
}

}  // namespace
}  // namespace ols::ptu
