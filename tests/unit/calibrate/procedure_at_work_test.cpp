// A procedure from its first picture to its end, with its folder: sides, the sun, stops,
// resumption.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>

#include "calibration/procedure/sun_stage.h"
#include "geometry/angles.h"
#include "tests/unit/calibrate/bus_station.h"
#include "tests/unit/calibration/scene.h"
#include "tests/unit/temporary_folder.h"
#include "tools/calibrate/procedure_end.h"
#include "tools/calibrate/procedure_runner.h"

namespace ols::calibration {
namespace {

using Status = ols_msg::station_status_t;

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

  TemporaryFolder folder_;
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
  EXPECT_THAT([&] { fail(StationStopped("the station was stopped"), *session_, store_); },
              testing::ThrowsMessage<std::runtime_error>(
                  testing::HasSubstr("the old calibration stays in use")));
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
  EXPECT_FALSE(link_.release()) << "a stop; the next one is a process of its own";
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

// What happened before sunset is told as it happened: then the sun could be looked at.
TEST_F(ProcedureAtWork, ASunThatHasSetMeanwhileIsGoneOnWithout) {
  constexpr std::int64_t kMorning_us = 1'773'991'800'000'000, kHour_us = 3'600'000'000;
  StationModel model = test::hill();
  model.geometry.chain.heading_rad = radians(130.0);
  FrameFile black;
  black.taken.utime_us = kMorning_us;
  cv::imencode(".png", cv::Mat(960, 1280, CV_8U, cv::Scalar(2)), black.file);
  for (int i = 0; i < 2; ++i) session_->add(black, false);
  const auto note = [this](JournalEntry one) {
    one.ordered_utime_us = kMorning_us;
    session_->note(one);
  };
  note({JournalEntry::Kind::kAnswered, "sun", 0, "", {"filter_on", {}, {}, kMorning_us}});
  note({JournalEntry::Kind::kTaken, "sun: a picture beside it, to prove the filter", 1, "", {}});
  note({JournalEntry::Kind::kTaken, "sun, picture 1 of 8", 2, "", {}});
  begin(session_->folder());
  session_->resume();
  const auto night = [this] {
    return session_->replayed_utime_us().value_or(kMorning_us + 12 * kHour_us);
  };
  std::vector<std::unique_ptr<Stage>> stages;
  stages.push_back(std::make_unique<SunStage>(model, std::make_shared<SunKeepOut>(model, night),
                                              [](const PanTilt&) { return true; }));
  procedure_.emplace(std::move(stages), FieldProcedure::Redo());
  EXPECT_EQ(run("filter_off\nkeep\n"), Outcome::kKeptOld);
  EXPECT_TRUE(station_.ways.empty());
}

TEST_F(ProcedureAtWork, AJournalOfAnotherProcedureIsRefused) {
  session_->note({JournalEntry::Kind::kNotTaken, "elsewhere", 0, "", {}});
  begin(session_->folder());
  session_->resume();
  EXPECT_THAT([&] { run("confirm\naccept\n"); },
              testing::ThrowsMessage<std::runtime_error>(testing::HasSubstr("'elsewhere'")));
  EXPECT_TRUE(station_.ways.empty());
}

}  // namespace
}  // namespace ols::calibration
