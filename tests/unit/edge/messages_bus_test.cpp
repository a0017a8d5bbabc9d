#include "edge/messages_bus.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

namespace ols {
namespace {

constexpr double kNow_s = 1000.0;
constexpr std::int64_t kNow_us = 1'700'000'000'000'000;

struct CountingTracker final : TargetTracker {
  explicit CountingTracker(std::vector<double>& designated) : boxes(designated) {}
  std::optional<TrackerError> initialise(const TrackerInput&, const cv::Rect2d& box) override {
    boxes.push_back(box.x);
    return std::nullopt;
  }
  TrackerResult track(const TrackerInput&) override { return {}; }
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
    bus = std::make_unique<StationBus>(settings, 1, *station,
                                       [](const RecordCommand&) { return std::string(); });
    bus->set_time({kNow_s, kNow_us}, {});
    Frame frame;
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
    std::vector<char> bytes(static_cast<std::size_t>(message.getEncodedSize()));
    message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
    bus->take(channel, bytes.data(), static_cast<int>(bytes.size()));
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

  StationSettings settings;
  std::vector<double> boxes;
  std::unique_ptr<Station> station;
  std::unique_ptr<StationBus> bus;
  std::int64_t sequence = 0;
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

TEST_F(StationBusTest, AStopAfterADesignationComesAfterIt) {
  designate(3);
  command(Ptu::COMMAND_STOP);
  bus->end_turn();
  EXPECT_EQ(boxes.size(), 1U);
  EXPECT_EQ(station->state(), StationState::kStopped);
}

TEST_F(StationBusTest, OtherCommandsBetweenDesignationsMakeNoMoreOfThem) {
  for (int i = 1; i <= 50; ++i) {
    designate(i);
    command(Ptu::COMMAND_STOP);
  }
  designate(1);
  bus->end_turn();
  EXPECT_EQ(boxes, (std::vector<double>{1.0, 1.0}));
  EXPECT_EQ(bus->counters().at("designations_superseded"), 49.0);
}

TEST_F(StationBusTest, ARefusedDesignationIsTold) {
  station->emergency_stop(true, kNow_s);
  designate(3);
  bus->end_turn();
  EXPECT_EQ(bus->last_refusal(), "DESIGNATE refused: emergency");
  EXPECT_EQ(bus->refusals(), 1U);
}

}  // namespace
}  // namespace ols
