#include "calibration/procedure/landmark_stage.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "geometry/angles.h"
#include "tripod.h"

namespace ols::calibration {
namespace {

using Eigen::Vector2d;

// Carries out the stage's orders; where a crosshair is missing or wrong, the person points, or
// turns the unit until the sign is in the picture.
struct Field {
  Field(Tripod& with, LandmarkStage& of, std::vector<Landmark> signs)
      : tripod(with), stage(of), landmarks(std::move(signs)) {}

  const Landmark& asked(const std::string& step) const {
    return *std::ranges::find_if(
        landmarks, [&](const Landmark& one) { return step.starts_with(one.name + ":"); });
  }
  void run() {
    for (int orders = 0; orders < 200; ++orders) {
      const auto order = stage.next();
      if (!order) return;
      if (order->kind == Order::Kind::kShoot) {
        shots.push_back(order->shot);
        stage.taken(tripod.shoot(order->shot));
      } else {
        ++questions;
        answer(*order);
      }
    }
    FAIL() << "it does not end";
  }
  void answer(const Order& order) {
    const Vector2d place = tripod.place(asked(order.step), shots.back().angles);
    const cv::Rect2d picture(10, 10, 620, 460);
    if (order.question.crosshair_px && (*order.question.crosshair_px - place).norm() < 1.0) {
      stage.answered({"confirm", {}, {}});
    } else if (picture.contains({place.x(), place.y()})) {
      ++pointed;
      stage.answered({"point", place + Vector2d(2.0, -1.5), {}});
    } else {
      ++turned;
      const auto there = aim_at(tripod.truth(), asked(order.step).ecef);
      stage.answered({"turn",
                      {},
                      {there->pan_rad - shots.back().angles.pan_rad + 0.01,
                       there->tilt_rad - shots.back().angles.tilt_rad}});
    }
  }

  Tripod& tripod;
  LandmarkStage& stage;
  std::vector<Landmark> landmarks;
  std::vector<Shot> shots;
  int questions = 0, pointed = 0, turned = 0;
};

TEST(LandmarkStage, EachIsSightedFromBothSidesAndTheRoundIsClosed) {
  Tripod tripod;
  LandmarkStage stage(tripod.model(), tripod.signs(4), 2);
  Field field(tripod, stage, tripod.signs(4));
  field.run();
  const auto all = stage.observations();
  ASSERT_EQ(all.size(), 9U);
  EXPECT_EQ(field.questions, 4);  // the second round is the unit's own
  int backwards = 0;
  for (const Observation& one : all) {
    const auto sign = std::ranges::find(field.landmarks, one.reference, &Landmark::name);
    const double counts = 2.0 * kPi / 112000.0;
    const PanTilt angles{one.reading.pan.counts * counts, one.reading.tilt.counts * counts};
    EXPECT_LT((one.pixel - tripod.place(*sign, angles)).norm(), 0.15) << one.reference;
    EXPECT_GE(one.sd_px, 0.05);
    EXPECT_LT(one.sd_px, 0.3);
    backwards += one.reading.pan.approach == -1 ? 1 : 0;
  }
  EXPECT_EQ(backwards, 4);
  ASSERT_TRUE(stage.closing_rad());
  EXPECT_LT(degrees(*stage.closing_rad()) * 3600.0, 5.0);
  EXPECT_EQ(stage.progress(), 1.0);
}

// By a compass that is off: the person turns the unit to the first, the unit finds the others.
TEST(LandmarkStage, TheFirstTellsTheHeadingForTheOthers) {
  Tripod tripod(radians(4.0));
  LandmarkStage stage(tripod.model(), tripod.signs(4), 1);
  Field field(tripod, stage, tripod.signs(4));
  field.run();
  EXPECT_EQ(stage.observations().size(), 5U);
  EXPECT_EQ(field.turned, 1);
  EXPECT_LE(field.pointed, 1);
  EXPECT_LT(std::abs(wrap_pi(stage.model().geometry.chain.heading_rad -
                             tripod.truth().chain.heading_rad)),
            radians(0.02));
}

TEST(LandmarkStage, OneIsSkippedAndWhatIsNoAnswerAsksAgain) {
  Tripod tripod;
  LandmarkStage stage(tripod.model(), tripod.signs(2), 2);
  stage.taken(tripod.shoot(stage.next()->shot));
  stage.answered({"point", {}, {}});  // without a pixel
  EXPECT_EQ(stage.next()->kind, Order::Kind::kAsk);
  EXPECT_NE(stage.next()->question.text.find("pixel"), std::string::npos);
  stage.answered({"point", Vector2d(-5.0, 2.0), {}});
  EXPECT_EQ(stage.next()->kind, Order::Kind::kAsk);
  stage.answered({"skip", {}, {}});
  Field field(tripod, stage, tripod.signs(2));
  field.run();
  EXPECT_EQ(stage.observations().size(), 3U);
  ASSERT_TRUE(stage.closing_rad()) << "at the first one that was sighted";
  EXPECT_LT(degrees(*stage.closing_rad()) * 3600.0, 5.0);
  EXPECT_EQ(stage.take_remarks().size(), 1U);
}

TEST(LandmarkStage, AFaceWithoutStructureIsTakenExactlyOrNotAtAll) {
  Tripod tripod;
  LandmarkStage stage(tripod.model(), tripod.signs(1), 1);
  Taken sky = tripod.shoot(stage.next()->shot);
  sky.gray.setTo(200);
  stage.taken(sky);
  EXPECT_FALSE(stage.next()->question.crosshair_px);
  stage.answered({"point", Vector2d(300.0, 200.0), {}});
  EXPECT_FALSE(stage.next()->question.crosshair_px);
  EXPECT_NE(stage.next()->question.text.find("nothing stands out"), std::string::npos);
  stage.answered({"exactly", Vector2d(300.0, 200.0), {}});
  ASSERT_TRUE(stage.next()->question.crosshair_px);
  stage.answered({"confirm", {}, {}});
  ASSERT_EQ(stage.observations().size(), 1U);
  EXPECT_EQ(stage.observations()[0].sd_px, 0.5);
}

TEST(LandmarkStage, OneMayBeSightedAgain) {
  Tripod tripod;
  LandmarkStage stage(tripod.model(), tripod.signs(2), 2);
  Field field(tripod, stage, tripod.signs(2));
  field.run();
  const std::size_t before = stage.observations().size();
  stage.redo(tripod.signs(2)[1].name);
  EXPECT_EQ(stage.observations().size(), before) << "they stand until there are new ones";
  field.run();
  EXPECT_EQ(stage.observations().size(), before);
  // A person who skips keeps what there was, and nothing is added to it.
  stage.redo(tripod.signs(2)[1].name);
  stage.taken(tripod.shoot(stage.next()->shot));
  stage.answered({"skip", {}, {}});
  EXPECT_FALSE(stage.next());
  EXPECT_EQ(stage.observations().size(), before);
  stage.redo("nobody");
  EXPECT_FALSE(stage.next());
}

TEST(LandmarkStage, APictureThatIsNotTakenIsNamed) {
  Tripod tripod;
  LandmarkStage stage(tripod.model(), tripod.signs(2), 1);
  stage.not_taken("the unit did not arrive");
  EXPECT_NE(stage.take_remarks().at(0).find("did not arrive"), std::string::npos);
  EXPECT_NE(stage.next()->step.find(tripod.signs(2)[1].name), std::string::npos);
}

// After the first the order is that of what helps most, and the person is told the figure; the
// round is closed at the first one all the same.
TEST(LandmarkStage, TheNextIsTheOneThatHelpsMost) {
  Tripod tripod;
  std::vector<std::size_t> offered;
  const Adviser last_first = [&offered](const StationModel&, const std::vector<Place>& left) {
    offered.push_back(left.size());
    std::vector<Foretold> ranked;
    for (auto one = left.rbegin(); one != left.rend(); ++one) ranked.push_back({one->name, 1e-4});
    ranked.pop_back();  // of one nothing can be foretold
    return ranked;
  };
  const auto signs = tripod.signs(4);
  LandmarkStage stage(tripod.model(), signs, 1, last_first);
  std::vector<std::string> steps;
  Field field(tripod, stage, signs);
  while (const auto order = stage.next()) {
    if (order->kind == Order::Kind::kAsk) {
      field.answer(*order);
      continue;
    }
    steps.push_back(order->step);
    field.shots.push_back(order->shot);
    stage.taken(tripod.shoot(order->shot));
  }
  ASSERT_EQ(steps.size(), 5U);
  EXPECT_EQ(steps[0], signs[0].name + ": driving there");
  EXPECT_EQ(steps[1].find(signs[3].name + ": driving there; " + signs[3].name +
                          " would leave 20.6″ (" + signs[2].name + " 20.6″)"),
            0U)
      << steps[1];
  EXPECT_EQ(steps[2].find(signs[1].name), 0U) << "the last of those that are left";
  EXPECT_EQ(steps[4].find(signs[0].name + ": back to the first"), 0U);
  EXPECT_EQ(offered, (std::vector<std::size_t>{3, 2, 1}));
}

}  // namespace
}  // namespace ols::calibration
