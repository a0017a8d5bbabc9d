#include "tools/calibrate/procedure_runner.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <opencv2/imgcodecs.hpp>

#include "base/clocks.h"
#include "ols_msg/frame_request_t.hpp"
#include "tests/unit/calibrate/bus_station.h"
#include "tests/unit/logger/temporary_folder.h"
#include "tools/calibrate/procedure_end.h"

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

// Pictures without a detour, as of a sweep, and a question at the end; remembers what it was told.
class Walk : public Stage {
 public:
  explicit Walk(std::vector<PanTilt> places) : places_(std::move(places)) {}
  std::optional<Order> next() override {
    Order order;
    if (at_ < places_.size()) {
      order.step = "place " + std::to_string(at_);
      order.shot.angles = places_[at_];
      order.shot.may_detour = false;
      return order;
    }
    if (answered_) return std::nullopt;
    order.kind = Order::Kind::kAsk;
    order.step = "question";
    order.question.choices = {"confirm"};
    return order;
  }
  void taken(const Taken& picture) override {
    pictures.push_back(picture);
    ++at_;
  }
  void not_taken(const std::string& why) override {
    missing.push_back(why);
    ++at_;
  }
  void answered(const Answer& answer) override {
    answered_ = answer.choice == "confirm";
    answer_ = answer;
  }
  void resumed() override { ++resumptions; }
  std::vector<Observation> observations() const override {
    std::vector<Observation> all;
    for (const Taken& one : pictures) {
      all.push_back(observation_of(Kind::kLandmark, one, {1.0, 2.0}, 0.3, "spire"));
    }
    return all;
  }
  double progress() const override { return 0.0; }

  std::vector<Taken> pictures;
  std::vector<std::string> missing;
  int resumptions = 0;
  Answer answer_;

 private:
  std::vector<PanTilt> places_;
  std::size_t at_ = 0;
  bool answered_ = false;
};

class ProcedureAtWork : public testing::Test {
 protected:
  ProcedureAtWork() {
    make_old_one();
    begin(store_.begin("field", 1'780'000'000'000'000));
  }
  // What is in use before.
  void make_old_one() {
    const auto running = store_.begin("field", 1'770'000'000'000'000);
    std::ofstream(running / "instrument.toml") << "old";
    std::ofstream(running / "setup.toml") << "old";
    store_.keep(running, "11");
    store_.use("11", {1, "accepted", "", "field", ""});
  }
  void begin(std::filesystem::path folder) {
    session_.emplace(std::move(folder), "alfa");
    std::vector<std::unique_ptr<Stage>> stages;
    auto walk = std::make_unique<Walk>(std::vector<PanTilt>{{0.1, 0.0}, {0.2, 0.05}, {0.3, 0.1}});
    walk_ = walk.get();
    stages.push_back(std::move(walk));
    procedure_.emplace(std::move(stages), FieldProcedure::Redo());
  }
  std::string script(const std::string& answers) const {
    std::string path = folder_ / "script";
    std::ofstream(path) << answers;
    return path;
  }
  Outcome run(const std::string& answers, const ProcedureRunner::KeepAway& keep_away = nullptr) {
    Person person(script(answers));
    ProcedureRunner runner("field", link_, person, &*session_);
    if (keep_away) runner.keep_away(keep_away);
    station_.say(station_.state);
    return runner.run(*procedure_, [] { return AdjustedResult{false, true, "good", ""}; });
  }
  std::size_t commands() {
    while (station_.bus.handle(0) > 0) {
    }
    return station_.commands.size();
  }
  static std::string text_of(const std::filesystem::path& path) {
    std::ifstream file(path);
    return {std::istreambuf_iterator<char>(file), {}};
  }

  logger::TemporaryFolder folder_;
  CalibrationStore store_{folder_ / "store"};
  test::MovingStation station_;
  StationLink link_{station_.bus, "alfa"};
  std::optional<ProcedureSession> session_;
  std::optional<FieldProcedure> procedure_;
  Walk* walk_ = nullptr;
};

TEST_F(ProcedureAtWork, AnAxisWhoseSideIsNotKnownRunsUpFirst) {
  EXPECT_EQ(run("confirm\naccept\n"), Outcome::kAccepted);
  ASSERT_EQ(walk_->pictures.size(), 3U);
  for (const Taken& one : walk_->pictures) {
    EXPECT_EQ(one.reading.pan.approach, 1);
    EXPECT_EQ(one.reading.tilt.approach, 1);
  }
  // The first place from beside it, which is more than any backlash; the others straight.
  ASSERT_EQ(station_.ways.size(), 4U);
  EXPECT_NEAR(station_.ways[1].first, 0.007, 1e-9);
  EXPECT_NEAR(station_.ways[1].second, 0.007, 1e-9);
}

TEST_F(ProcedureAtWork, ASideThatTheStationForgetsIsRunUpForOnceMore) {
  int requests = 0;
  // It homes before the second place's picture.
  station_.on_request = [&] {
    ++requests;
    station_.knows_sides = requests != 3;
  };
  EXPECT_EQ(run("confirm\naccept\n"), Outcome::kAccepted);
  ASSERT_EQ(walk_->pictures.size(), 3U);
  EXPECT_TRUE(walk_->missing.empty());
  EXPECT_EQ(requests, 6);  // run-up, place; place, run-up, place; place
  EXPECT_EQ(walk_->pictures[1].reading.pan.approach, 1);
}

TEST_F(ProcedureAtWork, APictureWithoutAKnownSideIsRefusedAndNeverGuessed) {
  station_.knows_sides = false;
  EXPECT_EQ(run("confirm\naccept\n"), Outcome::kAccepted);
  EXPECT_TRUE(walk_->pictures.empty());
  ASSERT_EQ(walk_->missing.size(), 3U);
  EXPECT_NE(walk_->missing[0].find("from which side"), std::string::npos);
}

TEST_F(ProcedureAtWork, WhereTheSunStandsTheUnitIsNotSent) {
  run("confirm\naccept\n",
      [](const PanTilt& at) { return at.pan_rad == 0.2 ? "the sun stands there" : ""; });
  EXPECT_EQ(walk_->missing, std::vector<std::string>{"the sun stands there"});
  EXPECT_EQ(walk_->pictures.size(), 2U);
  double pan_rad = 0.0;
  for (const auto& way : station_.ways) {
    pan_rad += way.first;
    EXPECT_GT(std::abs(pan_rad - 0.2), 0.05);
  }
}

// The stop button in the middle of `field`.
TEST_F(ProcedureAtWork, AStopEndsItWithWhatItHasAndTheOldCalibrationStands) {
  std::size_t before = 0;
  station_.on_request = [this, &before] {
    if (station_.pictures < 3) return;  // run-up and two places
    station_.state = Status::STATE_STOPPED;
    if (before == 0) before = station_.commands.size();
  };
  EXPECT_THROW(run("confirm\naccept\n"), StationStopped);
  EXPECT_EQ(commands(), before) << "nothing moves afterwards, nothing ends the stop";
  EXPECT_FALSE(link_.release());
  EXPECT_EQ(commands(), before);
  try {
    fail(StationStopped("the station was stopped"), *session_, store_);
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("the old calibration stands"), std::string::npos);
  }
  EXPECT_EQ(store_.current(), "11");
  ASSERT_EQ(store_.interrupted().size(), 1U);
  const auto kept = store_.interrupted()[0];
  const auto lines = [](const std::string& text) { return std::ranges::count(text, '\n'); };
  EXPECT_EQ(lines(text_of(kept / "frames.jsonl")), 2);
  EXPECT_EQ(lines(text_of(kept / "observations.jsonl")), 2);
  EXPECT_TRUE(std::filesystem::exists(kept / "frames" / "000002.png"));
}

TEST_F(ProcedureAtWork, AnInterruptedOneGoesOnWhereItWas) {
  station_.on_request = [this] {
    if (station_.pictures >= 3) station_.state = Status::STATE_STOPPED;
  };
  EXPECT_THROW(run("confirm\naccept\n"), StationStopped);
  const auto kept = store_.interrupt(session_->folder());
  // A loss of power has cut a line, too.
  std::ofstream(kept / "journal.jsonl", std::ios::app) << "{\"step\": \"pl";
  station_.state = Status::STATE_MANUAL;
  station_.on_request = nullptr;
  station_.ways.clear();
  begin(store_.resume(kept));
  session_->resume();
  EXPECT_EQ(run("confirm\naccept\n"), Outcome::kAccepted);
  ASSERT_EQ(walk_->pictures.size(), 3U);
  EXPECT_EQ(walk_->resumptions, 1);
  EXPECT_EQ(walk_->pictures[0].reading.pan.approach, 1);
  EXPECT_NEAR(walk_->pictures[1].angles.pan_rad, 0.2, 1e-9);
  EXPECT_EQ(walk_->pictures[1].gray.at<unsigned char>(0, 0), 3);
  EXPECT_EQ(walk_->pictures[2].pose, 3) << "a number of its own";
  ASSERT_EQ(station_.ways.size(), 2U) << "what there is is not driven to again";
  EXPECT_NEAR(station_.ways[1].first, 0.007, 1e-9) << "from a known side";

  // Once more, from the whole journal: nothing is left to be done but the person's word.
  begin(store_.resume(store_.interrupt(session_->folder())));
  session_->resume();
  station_.ways.clear();
  EXPECT_EQ(run("keep\n"), Outcome::kKeptOld);
  EXPECT_TRUE(station_.ways.empty());
  EXPECT_EQ(walk_->answer_.choice, "confirm");
  EXPECT_EQ(walk_->resumptions, 2);
}

TEST_F(ProcedureAtWork, AJournalOfAnotherProcedureIsRefused) {
  session_->note({JournalEntry::Kind::kNotTaken, "elsewhere", 0, "", {}});
  begin(session_->folder());
  session_->resume();
  try {
    run("confirm\naccept\n");
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("'elsewhere'"), std::string::npos);
  }
  EXPECT_TRUE(station_.ways.empty());
}

}  // namespace
}  // namespace ols::calibration
