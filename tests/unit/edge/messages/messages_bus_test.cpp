#include "edge/messages/messages_bus.h"

#include <gtest/gtest.h>

#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "conditions/refusal.h"
#include "tests/unit/on_the_bus.h"

namespace ols::station {
namespace {

constexpr double kNow_s = 1000.0;
constexpr std::int64_t kNow_us = 1'700'000'000'000'000;

struct CountingTracker final : tracker::TargetTracker {
  explicit CountingTracker(std::vector<double>& designated) : boxes(designated) {}
  std::optional<tracker::TrackerError> initialise(const tracker::TrackerInput&,
                                                  const cv::Rect2d& box) override {
    boxes.push_back(box.x);
    return std::nullopt;
  }
  tracker::TrackerResult track(const tracker::TrackerInput&) override { return {}; }
  void search_near(const Eigen::Vector2d&, double) override {}
  void set_aside() override {}
  void take_back() override {}
  std::vector<double>& boxes;
};

class StationBusTest : public testing::Test {
 protected:
  StationBusTest() {
    settings.id = std::string("a");
    station = std::make_unique<Station>(settings.station, std::make_unique<CountingTracker>(boxes));
    station->set_reference(mount::Reference::kTrusted);
    turn = std::make_unique<CommandTurn>(*station);
    bus = std::make_unique<StationBus>(
        settings, 1, *station, *turn, [](const recorder::RecordCommand&) { return std::string(); });
    bus->set_time({kNow_s, kNow_us}, {});
    camera::Frame frame;
    frame.gray = cv::Mat::zeros(48, 64, CV_8UC1);
    frame.mid_exposure_s = kNow_s - 0.1;
    station->on_frame(frame, kNow_s);
  }

  template <class Message>
  void send(const std::string& channel, Message message) {
    message.schema_version = Message::SCHEMA_VERSION;
    message.station = "a";
    message.utime = kNow_us;
    message.boot_id = 3;
    message.sequence = ++sequence;
    message.lease_s = 1.0;
    publish(channel, message);
  }
  template <class Message>
  void publish(const std::string& channel, const Message& message) {
    bus->take({channel, encoded(message), kNow_us, {}, addressed});
  }
  void designate(double x_px) {
    ols_msg::designate_t message{};
    message.x_px = x_px;
    message.y_px = 5.0;
    message.width_px = message.height_px = 10.0;
    send("OLS_DESIGNATE_a", message);
  }
  void command(std::int8_t what) {
    ols_msg::ptu_command_t message{};
    message.command = what;
    send("OLS_PTU_a", message);
  }

  // What was answered since the last call: sequence of the order and reason ("": carried out).
  std::vector<std::pair<std::int64_t, std::string>> answered() {
    std::vector<std::pair<std::int64_t, std::string>> said;
    for (const Answer& answer : bus->take_answers()) {
      EXPECT_TRUE(answer.command.boot_id == 3 || answer.command.boot_id == 9);
      said.emplace_back(answer.command.sequence, answer.reason);
    }
    return said;
  }

  StationSettings settings;
  std::vector<double> boxes;
  std::unique_ptr<Station> station;
  std::unique_ptr<CommandTurn> turn;
  std::unique_ptr<StationBus> bus;
  std::int64_t sequence = 0;
  bool addressed = true;  // whether messages name the station's boot
};

using Ptu = ols_msg::ptu_command_t;

TEST_F(StationBusTest, OfABurstOfDesignationsOnlyTheNewestIsCarriedOut) {
  for (int i = 1; i <= 200; ++i) designate(i % 40);
  EXPECT_TRUE(boxes.empty()) << "none before the turn's end";
  bus->end_turn();
  EXPECT_EQ(boxes, (std::vector<double>{0.0}));
  EXPECT_EQ(bus->counters().at("designations_superseded"), 199.0);
  bus->end_turn();
  EXPECT_EQ(boxes.size(), 1U) << "and only once";
}

TEST_F(StationBusTest, WhatHidesTheTargetIsTakenOnceAndNotAnswered) {
  designate(3);
  bus->end_turn();
  answered();
  ols_msg::occlusion_t message{};
  message.holds_s = 4.0;
  message.exit_utime = kNow_us + 3'000'000;
  message.exit_covariance_rad2[0] = message.exit_covariance_rad2[2] = 1e-6;
  for (const std::int64_t age_us : {5'000'000, 0}) {  // a stale one first
    message.schema_version = ols_msg::occlusion_t::SCHEMA_VERSION;
    message.station = "a";
    message.utime = kNow_us - age_us;
    message.boot_id = 3;
    message.sequence = ++sequence;
    message.lease_s = 0.5;
    publish("OLS_OCCLUSION_a", message);
    station->step(kNow_s + 0.8);
    EXPECT_EQ(station->state(), age_us > 0 ? StationState::kLost : StationState::kHidden);
  }
  EXPECT_NEAR(station->snapshot().hidden_until_s.value_or(0.0), kNow_s + 3.0, 1e-6);
  EXPECT_TRUE(answered().empty());
}

TEST_F(StationBusTest, AStopDoesNotWaitForADesignationToBeFollowed) {
  designate(3);
  command(Ptu::COMMAND_STOP);
  bus->end_turn();
  EXPECT_TRUE(boxes.empty());
  EXPECT_EQ(station->state(), StationState::kStopped);
}

TEST_F(StationBusTest, OtherCommandsBetweenDesignationsMakeNoMoreOfThem) {
  for (int i = 1; i <= 50; ++i) {
    designate(i);
    command(Ptu::COMMAND_RELEASE);
  }
  designate(1);
  bus->end_turn();
  EXPECT_EQ(boxes, (std::vector<double>{1.0, 1.0}));
  EXPECT_EQ(bus->counters().at("designations_superseded"), 49.0);
}

// Whatever else it says: none of it makes a stop less meant.
TEST_F(StationBusTest, AStopIsNeverRefused) {
  Ptu foreign{};
  foreign.command = Ptu::COMMAND_STOP;
  foreign.schema_version = 99;
  foreign.station = "nobody";
  foreign.utime = -5;
  foreign.sequence = std::numeric_limits<std::int64_t>::min();
  foreign.lease_s = std::numeric_limits<double>::quiet_NaN();
  for (int i = 0; i < 3; ++i) {  // and again
    const double later_s = i * (Station::kStopHold_s + 0.1);
    bus->set_time({kNow_s + later_s, kNow_us}, {});
    command(Ptu::COMMAND_RELEASE);
    ASSERT_EQ(station->state(), StationState::kIdle);
    publish("OLS_PTU_a", foreign);
    bus->end_turn();
    EXPECT_EQ(station->state(), StationState::kStopped);
  }
  EXPECT_EQ(bus->refusals(), 0U);
}

using Said = std::vector<std::pair<std::int64_t, std::string>>;

TEST_F(StationBusTest, EachOrderIsAnsweredInTheTurnInWhichItIsDecided) {
  designate(3);
  EXPECT_TRUE(answered().empty()) << "not decided yet";
  designate(4);
  command(Ptu::COMMAND_POINT);
  EXPECT_EQ(answered(), (Said{{1, "overtaken"}, {2, ""}, {3, ""}}));
  command(99);
  command(Ptu::COMMAND_REARM);
  EXPECT_EQ(answered(), (Said{{4, "unknown_command"}, {5, "rearm_needs_a_hand"}}));
  designate(5);
  command(Ptu::COMMAND_STOP);
  command(Ptu::COMMAND_STOP);
  EXPECT_TRUE(answered().empty());
  bus->end_turn();
  EXPECT_EQ(answered(), (Said{{6, "stopped"}, {8, ""}})) << "of repeated stops the last";
  bus->end_turn();
  EXPECT_TRUE(answered().empty());
}

TEST_F(StationBusTest, TheAnswerToAStopSaysThatTheStationStands) {
  command(Ptu::COMMAND_STOP);
  bus->end_turn();
  const auto answers = bus->take_answers();
  ASSERT_EQ(answers.size(), 1U);
  EXPECT_EQ(answers[0].state, StationState::kStopped);
}

TEST_F(StationBusTest, AFloodOfRefusedOrdersIsNotAnsweredAsFast) {
  for (int i = 0; i < 2000; ++i) command(99);
  const std::size_t refusals = answered().size();
  EXPECT_GT(refusals, 10U);
  EXPECT_LT(refusals, 100U);
  command(Ptu::COMMAND_RELEASE);
  EXPECT_EQ(answered().size(), 1U) << "what is carried out always is";
}

// Where signatures are required: only a stop may do without the station's boot.
TEST_F(StationBusTest, ACommandThatNamesNoBootIsRefusedUnlessItIsAFreshStop) {
  addressed = false;
  designate(3);
  command(Ptu::COMMAND_POINT);
  command(Ptu::COMMAND_RELEASE);
  bus->end_turn();
  EXPECT_EQ(answered(), (Said{{1, "other_boot"}, {2, "other_boot"}, {3, "other_boot"}}))
      << "from the answer its sender learns the boot";
  EXPECT_EQ(bus->counters().at("messages_refused_other_boot"), 3.0);
  EXPECT_TRUE(boxes.empty());
  Ptu old{};
  old.command = Ptu::COMMAND_STOP;
  old.lease_s = 1.0;
  for (const std::int64_t age_us : {2'000'000, -2'000'000}) {
    old.utime = kNow_us - age_us;
    publish("OLS_PTU_a", old);
  }
  old.utime = kNow_us;
  for (const double lease_s : {0.0, -1.0, 1e6, std::numeric_limits<double>::quiet_NaN()}) {
    old.lease_s = lease_s;
    publish("OLS_PTU_a", old);
  }
  bus->end_turn();
  EXPECT_NE(station->state(), StationState::kStopped);
  EXPECT_EQ(bus->counters().at("messages_refused_other_boot"), 9.0);
  command(Ptu::COMMAND_STOP);
  bus->end_turn();
  EXPECT_EQ(station->state(), StationState::kStopped);
}

TEST_F(StationBusTest, NothingThatCrossesAStopOnTheWireUndoesIt) {
  command(Ptu::COMMAND_STOP);
  command(Ptu::COMMAND_RELEASE);
  designate(3);
  bus->end_turn();
  for (const std::int8_t what : {Ptu::COMMAND_RELEASE, Ptu::COMMAND_POINT, Ptu::COMMAND_HOME}) {
    command(what);
    designate(4);
    bus->end_turn();
    EXPECT_EQ(station->state(), StationState::kStopped) << int{what};
  }
  EXPECT_EQ(bus->last_refusal(), refused_in_words("DESIGNATE", "just_stopped"));
  bus->set_time({kNow_s + Station::kStopHold_s + 0.01, kNow_us}, {});
  command(Ptu::COMMAND_RELEASE);
  EXPECT_NE(station->state(), StationState::kStopped);
}

TEST_F(StationBusTest, ReleaseWithAForeignSchemaOrStationIsRefused) {
  command(Ptu::COMMAND_STOP);
  bus->end_turn();
  Ptu message{};
  message.command = Ptu::COMMAND_RELEASE;
  message.utime = kNow_us;
  message.lease_s = 1.0;
  message.schema_version = 99;
  message.station = "a";
  publish("OLS_PTU_a", message);
  message.schema_version = Ptu::SCHEMA_VERSION;
  message.station = "b";
  publish("OLS_PTU_a", message);
  EXPECT_EQ(station->state(), StationState::kStopped);
  EXPECT_EQ(bus->refusals(), 2U);
}

TEST_F(StationBusTest, CommandsThatKeepBeingRefusedAreAnAlarm) {
  auto message = made<Ptu>();
  message.station = "a";
  message.command = Ptu::COMMAND_RELEASE;
  message.utime = kNow_us;
  message.boot_id = 9;
  message.lease_s = 1.0;
  for (int i = 0; i < 13; ++i) publish("OLS_PTU_a", message);  // the first is let through
  ASSERT_EQ(bus->alarms().size(), 1U);
  EXPECT_EQ(bus->alarms().front(),
            "commands: 12 PTU commands refused in 10 s: this command was taken before");
  bus->set_time({kNow_s + 11.0, kNow_us + 11'000'000}, {});
  EXPECT_TRUE(bus->alarms().empty());
}

// What a forger or a bad link does to a joystick, refused and counted before the station sees it.
TEST_F(StationBusTest, StaleReplayedAndOverlongRatesAreRefused) {
  Ptu message{};
  message.command = Ptu::COMMAND_RATE;
  message.schema_version = Ptu::SCHEMA_VERSION;
  message.station = "a";
  message.utime = kNow_us;
  message.boot_id = 9;
  message.lease_s = 0.3;
  message.pan_rate_rad_s = 0.1;
  publish("OLS_PTU_a", message);
  EXPECT_EQ(station->state(), StationState::kManual);
  publish("OLS_PTU_a", message);
  message.utime = kNow_us - 900'000;
  message.sequence = 2;
  publish("OLS_PTU_a", message);
  EXPECT_EQ(bus->counters().at("messages_refused_replayed"), 1.0);
  EXPECT_EQ(bus->counters().at("messages_refused_stale"), 1.0);
  EXPECT_EQ(answered(), (Said{{0, ""}, {0, "replayed"}, {2, "stale"}}));
  message.utime = kNow_us;
  message.lease_s = 2.0;
  publish("OLS_PTU_a", message);
  EXPECT_EQ(bus->last_refusal(), refused_in_words("PTU", "out_of_range"));
}

TEST_F(StationBusTest, ARearmOverTheBusNeedsTheSitesLeave) {
  station->emergency_stop(true, kNow_s);
  station->emergency_stop(false, kNow_s);
  command(Ptu::COMMAND_REARM);
  EXPECT_EQ(station->state(), StationState::kEmergency);
  EXPECT_EQ(bus->last_refusal(), "PTU refused: it can be re-armed at the station only");
}

TEST_F(StationBusTest, ARefusedDesignationIsTold) {
  station->emergency_stop(true, kNow_s);
  designate(3);
  bus->end_turn();
  EXPECT_EQ(bus->last_refusal(), refused_in_words("DESIGNATE", "emergency"));
  EXPECT_EQ(bus->refusals(), 1U);
}

}  // namespace
}  // namespace ols::station
