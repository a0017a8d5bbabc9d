#include "tools/calibrate/procedure_runner.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <opencv2/imgcodecs.hpp>

#include "base/clocks.h"
#include "ols_msg/frame_request_t.hpp"
#include "tests/unit/calibrate/bus_station.h"
#include "tests/unit/logger/temporary_folder.h"

namespace ols::calibration {
namespace {

using Command = ols_msg::ptu_command_t;
using Status = ols_msg::station_status_t;

// One picture that never comes.
class OneShot : public Stage {
 public:
  std::optional<Order> next() override {
    Order order;
    order.shot.may_detour = false;
    return order;
  }
  void taken(const Taken&) override {}
  void not_taken(const std::string&) override {}
  void answered(const Answer&) override {}
  std::vector<Observation> observations() const override { return {}; }
  double progress() const override { return 0.0; }
};

// A picture, then a live question that says how many have come since.
class Live : public Stage {
 public:
  std::optional<Order> next() override {
    if (done_) return std::nullopt;
    Order order;
    order.shot.may_detour = false;
    if (!shot_) return order;
    order.kind = Order::Kind::kAsk;
    order.question.is_live = true;
    order.question.text = "seen " + std::to_string(seen_);
    order.question.choices = {"confirm"};
    return order;
  }
  void taken(const Taken&) override { shot_ = true; }
  void seen(const Taken& picture) override { seen_ += picture.gray.cols == 4 ? 1 : 0; }
  void not_taken(const std::string&) override { done_ = true; }
  void answered(const Answer& answer) override { done_ = answer.choice == "confirm"; }
  std::vector<Observation> observations() const override { return {}; }
  double progress() const override { return 0.0; }

 private:
  bool shot_ = false, done_ = false;
  int seen_ = 0;
};

ols_msg::frame_part_t answer_to(const ols_msg::frame_request_t& request) {
  static std::int64_t sequence = 0;
  ols_msg::frame_part_t part{};
  part.utime = ++sequence;
  part.schema_version = ols_msg::frame_part_t::SCHEMA_VERSION;
  part.station = "alfa";
  part.sequence = sequence;
  part.request_boot_id = request.boot_id;
  part.request_sequence = request.sequence;
  part.encoding = request.encoding;
  part.approach_pan = part.approach_tilt = 1;
  part.pan_count_rad = part.tilt_count_rad = 1e-4;
  part.parts = 1;
  cv::imencode(".png", cv::Mat(3, 4, CV_8U, cv::Scalar(100)), part.data);
  part.bytes = static_cast<std::int32_t>(part.data.size());
  return part;
}

ols_msg::procedure_answer_t answer_of(std::int64_t question, const char* choice) {
  static std::int64_t sequence = 0;
  ols_msg::procedure_answer_t answer{};
  answer.utime = clock_utime_us();
  answer.schema_version = ols_msg::procedure_answer_t::SCHEMA_VERSION;
  answer.boot_id = 7;
  answer.sequence = ++sequence;
  answer.station = "alfa";
  answer.lease_s = 5.0;
  answer.question = question;
  answer.choice = choice;
  return answer;
}

class ProcedureRunnerTest : public testing::Test {
 protected:
  ProcedureRunnerTest() : person_(script()), runner_("field", link_, person_, nullptr) {
    std::vector<std::unique_ptr<Stage>> stages;
    stages.push_back(std::make_unique<OneShot>());
    procedure_.emplace(std::move(stages), FieldProcedure::Redo());
  }

  std::string script() const {
    std::string path = folder_.path() + "/script";
    std::ofstream(path) << "skip\n";
    return path;
  }
  void run() {
    runner_.run(*procedure_, [] { return AdjustedResult{}; });
  }
  void handle() {
    while (station_.bus.handle(0) > 0) {
    }
  }

  logger::TemporaryFolder folder_;
  test::BusStation station_;
  StationLink link_{station_.bus, "alfa"};
  Person person_;
  ProcedureRunner runner_;
  std::optional<FieldProcedure> procedure_;
};

// The stop came while something was computed and no message was handled.
TEST_F(ProcedureRunnerTest, AStopThatWaitsInTheQueueIsHeardBeforeTheUnitIsMoved) {
  station_.say(Status::STATE_MANUAL);
  handle();
  station_.say(Status::STATE_STOPPED);
  EXPECT_THROW(run(), StationStopped);
  handle();
  EXPECT_TRUE(station_.commands.empty());
}

TEST_F(ProcedureRunnerTest, TheUnitIsPointedUntilAStopIsHeardOf) {
  station_.say(Status::STATE_MANUAL);
  station_.on_command = [this] { station_.say(Status::STATE_STOPPED); };
  EXPECT_THROW(run(), StationStopped);
  handle();
  EXPECT_EQ(station_.commands, std::vector<std::int8_t>{Command::COMMAND_POINT});
}

// The question keeps its number, so that the answer to an older picture of it counts.
TEST_F(ProcedureRunnerTest, ALiveQuestionChangesWithEachPictureUntilItIsAnswered) {
  std::vector<std::unique_ptr<Stage>> stages;
  stages.push_back(std::make_unique<Live>());
  FieldProcedure procedure(std::move(stages), FieldProcedure::Redo());
  Person nobody("");
  ProcedureRunner runner("rectify", link_, nobody, nullptr);
  LcmBus& bus = station_.bus;
  bus.subscribe(station_channel(kFrameRequestChannel, "alfa"), [&](const BusMessage& message) {
    ols_msg::frame_request_t request;
    request.decode(message.payload.data(), 0, static_cast<int>(message.payload.size()));
    station_.say(Status::STATE_MANUAL);
    bus.publish(station_channel(kFrameChannel, "alfa"), answer_to(request));
  });
  std::vector<std::string> texts;
  std::int64_t question = 0;
  bus.subscribe(station_channel(kProcedureChannel, "alfa"), [&](const BusMessage& message) {
    ols_msg::procedure_t said;
    said.decode(message.payload.data(), 0, static_cast<int>(message.payload.size()));
    if (said.state != ols_msg::procedure_t::STATE_ASKING) return;
    const auto answer = [&](const char* choice) {
      bus.publish(station_channel(kProcedureAnswerChannel, "alfa"),
                  answer_of(said.question, choice));
    };
    if (said.text == "nothing") return answer("keep");
    if (said.text == "seen 0") question = said.question;
    EXPECT_EQ(said.question, question);
    texts.push_back(said.text);
    if (said.text == "seen 2") answer("confirm");
  });
  station_.say(Status::STATE_MANUAL);
  handle();
  runner.run(procedure, [] { return AdjustedResult{true, false, "nothing", ""}; });
  EXPECT_THAT(texts, testing::IsSupersetOf({"seen 0", "seen 1", "seen 2"}));
}

}  // namespace
}  // namespace ols::calibration
