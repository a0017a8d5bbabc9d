#include "edge/tracker/paper_tracker.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/toml_config.h"
#include "edge/tracker/tracker.h"
#include "tests/unit/edge/tracker/synthetic.h"

namespace ols {
namespace {

using testing::Backdrop;
using testing::distance;
using testing::SyntheticScene;

const cv::Point2d kStart(300.0, 220.0);

TrackerInput frame_at(int frame, const cv::Mat& gray) {
  return {gray, 10.0 + frame / 15.0, std::nullopt};
}

TrackerConfig paper_mode() {
  TrackerConfig config;
  config.mode = TrackerMode::kPaper;
  return config;
}

// Eq. (5) by hand: two pixels' share of it.
TEST(PaperObjective, IsEquationFive) {
  Patch target{}, candidate{};
  MaskPatch target_mask{}, candidate_mask{};
  const double identical = paper_objective(target, target_mask, candidate, candidate_mask);
  EXPECT_DOUBLE_EQ(identical, kPatchArea);
  candidate[7] = 51.0F;  // |It - Ic| = 0.2
  EXPECT_NEAR(paper_objective(target, target_mask, candidate, candidate_mask),
              kPatchArea - 1.0 + 0.64, 1e-9);
  target_mask[7] = 255;
  candidate_mask[7] = 102;  // min(Mt, Mc) = 0.4
  EXPECT_NEAR(paper_objective(target, target_mask, candidate, candidate_mask),
              kPatchArea - 1.0 + std::exp(0.4) * 0.64, 1e-9);
}

TEST(PaperTracker, FollowsATargetBeforeAMovingBackground) {
  SyntheticScene scene(Backdrop::kTextured, 1);
  Tracker tracker(paper_mode(), 3);
  ASSERT_FALSE(tracker.initialise(frame_at(0, scene.picture({400, 300}, kStart)),
                                  SyntheticScene::box_around(kStart)));
  for (int k = 1; k < 25; ++k) {
    const cv::Point2d truth(300.0 + 2.5 * k, 220.0 + 1.5 * k);
    const auto result =
        tracker.track(frame_at(k, scene.picture({400.0 + 11.0 * k, 300.0 + 3.0 * k}, truth)));
    ASSERT_TRUE(result.output.has_value());
    EXPECT_EQ(result.output->ego_motion, EgoMotion::kImage) << k;
    EXPECT_LT(distance(result.output->pixel, truth), 8.0) << k;
    EXPECT_GE(result.output->belief, 0.0);
    EXPECT_LE(result.output->belief, 1.0);
  }
}

TEST(PaperTracker, ForcesParticlesOntoTheFrameDifferenceBeforeBlankSky) {
  const cv::Point2d leapt(480.0, 330.0);
  for (const double share : {0.2, 0.0}) {
    SyntheticScene scene(Backdrop::kSky, 3);
    TrackerConfig config = paper_mode();
    config.difference_fraction = share;
    Tracker tracker(config, 3);
    ASSERT_FALSE(tracker.initialise(frame_at(0, scene.picture({400, 300}, kStart)),
                                    SyntheticScene::box_around(kStart)));
    const auto result = tracker.track(frame_at(1, scene.picture({400, 300}, leapt)));
    EXPECT_EQ(result.output->ego_motion, EgoMotion::kNone);
    EXPECT_EQ(distance(result.output->pixel, leapt) < 5.0, share > 0.0);
  }
}

TEST(PaperTracker, IsChosenByTheConfiguration) {
  ConfigFile file("[tracker]\nmode = \"paper\"\n[tracker.paper]\nsize_sd_px = 0.5\n", "t.toml");
  const TrackerConfig config = read_tracker_config(file.root().table("tracker"));
  file.finish();
  EXPECT_EQ(config.mode, TrackerMode::kPaper);
  EXPECT_EQ(config.paper.size_sd_px, 0.5);
  ConfigFile wrong("[tracker]\nmode = \"fast\"\n", "t.toml");
  EXPECT_THROW(read_tracker_config(wrong.root().table("tracker")), ConfigError);
}

// A clock that goes on by one at each look: every stage that is run takes a second.
TEST(StageTimes, ChargeEachStageByTheClockHandedIn) {
  for (const TrackerMode mode : {TrackerMode::kPaper, TrackerMode::kFull}) {
    SyntheticScene scene(Backdrop::kTextured, 1);
    TrackerConfig config;
    config.mode = mode;
    Tracker tracker(config, 3);
    ASSERT_FALSE(tracker.initialise(frame_at(0, scene.picture({400, 300}, kStart)),
                                    SyntheticScene::box_around(kStart)));
    tracker.track(frame_at(1, scene.picture({400, 300}, kStart)));
    EXPECT_EQ(tracker.stage_times().of(Stage::kWeighting), 0.0);  // no clock, no times
    double now = 0.0;
    tracker.set_stage_clock([&now] { return now += 1.0; });
    tracker.track(frame_at(2, scene.picture({400, 300}, kStart)));
    for (const Stage stage :
         {Stage::kReduction, Stage::kEgoMotion, Stage::kPrediction, Stage::kWeighting}) {
      EXPECT_GE(tracker.stage_times().of(stage), 1.0) << static_cast<int>(stage);
    }
  }
}

}  // namespace
}  // namespace ols
