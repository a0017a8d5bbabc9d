#include "tools/calibrate/procedure_runner.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <opencv2/imgcodecs.hpp>

#include "base/process/clocks.h"
#include "geometry/angles.h"
#include "ols_msg/frame_request_t.hpp"
#include "tests/unit/calibrate/bus_station.h"
#include "tests/unit/temporary_folder.h"

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

// A picture, then a question, live or not, that says how many have come since.
class Live : public Stage {
 public:
  explicit Live(bool is_live = true) : is_live_(is_live) {}
  std::optional<Order> next() override {
    if (done_) return std::nullopt;
    Order order;
    order.shot.may_detour = false;
    if (!shot_) return order;
    order.kind = Order::Kind::kAsk;
    order.question.is_live = is_live_;
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
  bool is_live_;
  bool shot_ = false, done_ = false;
  int seen_ = 0;
};

ols_msg::frame_part_t answer_to(const ols_msg::frame_request_t& request, int width_px = 4) {
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
  cv::imencode(".png", cv::Mat(3, width_px, CV_8U, cv::Scalar(100)), part.data);
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

  TemporaryFolder folder_;
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

// A picture, then the live question, of a station that says its state whenever it is asked for a
// picture or hears of a question.
class LiveQuestionTest : public ProcedureRunnerTest {
 protected:
  explicit LiveQuestionTest(bool is_live = true) {
    std::vector<std::unique_ptr<Stage>> stages;
    stages.push_back(std::make_unique<Live>(is_live));
    live_.emplace(std::move(stages), FieldProcedure::Redo());
    LcmBus& bus = station_.bus;
    bus.subscribe(station_channel(kFrameRequestChannel, "alfa"), [this](const BusMessage& message) {
      ols_msg::frame_request_t request;
      request.decode(message.payload.data(), 0, static_cast<int>(message.payload.size()));
      station_.say(Status::STATE_MANUAL);
      station_.bus.publish(station_channel(kFrameChannel, "alfa"),
                           answer_to(request, width_px(++pictures_)));
    });
    bus.subscribe(station_channel(kProcedureChannel, "alfa"), [this](const BusMessage& message) {
      ols_msg::procedure_t said;
      said.decode(message.payload.data(), 0, static_cast<int>(message.payload.size()));
      if (said.state != ols_msg::procedure_t::STATE_ASKING) return;
      station_.say(Status::STATE_MANUAL);
      question_ = said.question;
      if (said.text == "nothing") return answer("keep");
      asked(said);
    });
  }

  virtual int width_px(int) { return 4; }  // of each picture, from 1
  // The live question, as it is now; one that goes on for too long is answered.
  virtual void asked(const ols_msg::procedure_t&) {
    if (++asked_ > 8) answer("confirm");
  }
  void answer(const char* choice) {
    station_.bus.publish(station_channel(kProcedureAnswerChannel, "alfa"),
                         answer_of(question_, choice));
  }
  void run_live() {
    station_.say(Status::STATE_MANUAL);
    handle();
    live_runner_.run(*live_, [] { return AdjustedResult{true, false, "nothing", ""}; });
  }

  Person nobody_{""};
  ProcedureRunner live_runner_{"rectify", link_, nobody_, nullptr};
  std::optional<FieldProcedure> live_;
  std::int64_t question_ = 0;
  int pictures_ = 0, asked_ = 0;
};

class OtherPicturesTest : public LiveQuestionTest {
  int width_px(int number) override { return number < 3 ? 4 : 2; }
};

TEST_F(OtherPicturesTest, ACameraThatCameBackWithOtherPicturesEndsIt) {
  EXPECT_THAT([&] { run_live(); }, testing::ThrowsMessage<std::runtime_error>(testing::HasSubstr(
                                       "pictures of 2 x 3 px now, before of 4 x 3")));
}

class SunTest : public LiveQuestionTest {
 protected:
  SunTest() : LiveQuestionTest(false) {}
  void asked(const ols_msg::procedure_t& said) override {
    is_asking_ = true;
    LiveQuestionTest::asked(said);
  }
  bool is_asking_ = false;
};

// The sun comes while a person thinks; the first command is lost.
TEST_F(SunTest, AQuestionThatWaitsDoesNotLookAtTheSun) {
  live_runner_.keep_away([this](const PanTilt& at) {
    return is_asking_ && std::abs(at.pan_rad) < 0.1 ? "the sun stands there" : "";
  });
  int turns = 0;
  station_.bus.subscribe(
      station_channel(kPtuChannel, "alfa"), [this, &turns](const BusMessage& message) {
        Command command;
        command.decode(message.payload.data(), 0, static_cast<int>(message.payload.size()));
        if (!is_asking_ || command.pan_rad == 0.0) return;
        EXPECT_NEAR(command.pan_rad, radians(15.0), 1e-9);
        if (++turns < 2) return;
        station_.pan_rad = command.pan_rad;
        station_.say(Status::STATE_MANUAL);
        answer("confirm");
      });
  run_live();
  EXPECT_EQ(turns, 2);
}

class ThreePicturesTest : public LiveQuestionTest {
 protected:
  void asked(const ols_msg::procedure_t& said) override {
    if (said.text == "seen 0") first_ = said.question;
    EXPECT_EQ(said.question, first_);
    texts_.push_back(said.text);
    if (said.text == "seen 2") answer("confirm");
  }
  std::vector<std::string> texts_;
  std::int64_t first_ = 0;
};

// The question keeps its number, so that the answer to an older picture of it counts.
TEST_F(ThreePicturesTest, ALiveQuestionChangesWithEachPictureUntilItIsAnswered) {
  run_live();
  EXPECT_THAT(texts_, testing::IsSupersetOf({"seen 0", "seen 1", "seen 2"}));
}

}  // namespace
}  // namespace ols::calibration
