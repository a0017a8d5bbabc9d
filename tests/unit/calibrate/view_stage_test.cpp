#include "tools/calibrate/view_stage.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <opencv2/imgcodecs.hpp>

#include "geometry/angles.h"
#include "tests/unit/moved_scene.h"
#include "tests/unit/temporary_folder.h"

namespace ols::calibration {
namespace {

constexpr double kSd_rad = 2.4e-5;

// A calibration with pictures at these pans, and the station later.
class ViewStageTest : public testing::Test {
 protected:
  explicit ViewStageTest(std::vector<double> pans_deg = {-120, -40, 40, 120})
      : pans_deg_(std::move(pans_deg)) {
    std::ofstream list(folder_.path() + "/frames.jsonl");
    for (std::size_t i = 0; i < pans_deg_.size(); ++i) {
      const std::string file = std::to_string(i) + ".png";
      cv::imwrite(folder_.path() + "/" + file, moved_scene(static_cast<int>(i), 0.0));
      list << line(file, radians(pans_deg_[i]), true) << '\n';
    }
  }
  std::string line(const std::string& file, double pan_rad, bool is_view) const {
    const UnitReading reading{{.approach = 1}, {.approach = -1}};
    return line_of({1, folder_.path() + "/" + file, 0, reading, {pan_rad, 0.0}, is_view},
                   folder_.path());
  }
  // Each view moved by so many pixels, in every round; how many pictures were wanted.
  int look(ViewStage& stage, const std::vector<double>& right_px) {
    int pictures = 0;
    while (const auto order = stage.next()) {
      ++pictures;
      EXPECT_EQ(order->shot.approach_tilt, -1);
      const auto at = std::ranges::min_element(pans_deg_, {}, [&](double pan_deg) {
        return std::abs(radians(pan_deg) - order->shot.angles.pan_rad);
      });
      const auto i = static_cast<std::size_t>(at - pans_deg_.begin());
      Taken picture;
      picture.angles = order->shot.angles;
      picture.gray = moved_scene(static_cast<int>(i), right_px[i]);
      stage.taken(picture);
    }
    return pictures;
  }
  ViewStage stage() { return {views_of(folder_.path()), StationModel{}, kSd_rad}; }

  TemporaryFolder folder_;
  std::vector<double> pans_deg_;
};

TEST_F(ViewStageTest, ATripodThatStandsIsLookedAtOnce) {
  ViewStage quiet = stage();
  EXPECT_EQ(look(quiet, {0.0, 0.0, 0.0, 0.0}), 4);
  EXPECT_TRUE(quiet.stands());
  EXPECT_NE(quiet.verdict().find("stands as when it was calibrated"), std::string::npos);
}

TEST_F(ViewStageTest, AKnockIsSaidAfterASecondRound) {
  ViewStage knocked = stage();
  EXPECT_EQ(look(knocked, {4.3, 4.3, 4.3, 4.3}), 8);
  EXPECT_TRUE(knocked.is_conclusive());
  EXPECT_FALSE(knocked.stands());
  EXPECT_EQ(knocked.verdict().find("RED: calibration: the tripod has moved"), 0U)
      << knocked.verdict();
}

TEST_F(ViewStageTest, OneViewThatDiffersIsTheScene) {
  ViewStage changed = stage();
  look(changed, {0.0, 6.0, 0.0, 0.0});
  EXPECT_TRUE(changed.stands());
  EXPECT_NE(changed.verdict().find("something moved there, not the tripod"), std::string::npos)
      << changed.verdict();
}

TEST_F(ViewStageTest, TwoViewsTellNothing) {
  ViewStage few = stage();
  int taken = 0;
  while (few.next()) {
    if (++taken <= 2) {
      few.not_taken("the unit did not arrive");
    } else {
      Taken picture;
      picture.angles = few.next()->shot.angles;
      picture.gray = moved_scene(99, 0.0);
      few.taken(picture);
    }
  }
  EXPECT_FALSE(few.is_conclusive());
  EXPECT_FALSE(few.stands());
  EXPECT_NE(few.verdict().find("No result"), std::string::npos);
}

class CrowdedPanorama : public ViewStageTest {
 protected:
  CrowdedPanorama() : ViewStageTest({0, 3, 6, 9, -90, 95, 100, 30}) {}
};

TEST_F(CrowdedPanorama, ViewsAreAsFarApartAsThereAre) {
  const auto views = views_of(folder_.path());
  std::vector<int> pans;
  for (const StoredPicture& one : views) {
    pans.push_back(static_cast<int>(std::lround(degrees(one.angles.pan_rad))));
  }
  EXPECT_EQ(pans, (std::vector<int>{0, 100, -90, 30}));
}

// The same folder has what `field` has seen at night and of the sun.
TEST_F(CrowdedPanorama, OnlySceneryIsAView) {
  std::ofstream list(folder_.path() + "/frames.jsonl", std::ios::app);
  for (const double pan_deg : {-150.0, 60.0, 150.0}) {
    list << line("star.png", radians(pan_deg), false) << '\n';
  }
  list.close();
  for (const StoredPicture& one : views_of(folder_.path())) {
    EXPECT_NE(one.file.filename(), "star.png") << degrees(one.angles.pan_rad);
  }
}

TEST(ViewsOf, ACalibrationByStarsAloneHasNone) {
  const TemporaryFolder folder;
  std::ofstream(folder.path() + "/frames.jsonl")
      << line_of({1, folder.path() + "/a.png", 0, {}, {}, false}, folder.path()) << '\n';
  EXPECT_THAT([&] { views_of(folder.path()); }, testing::ThrowsMessage<std::runtime_error>(
                                                    testing::HasSubstr("no pictures of scenery")));
}

TEST(ViewsOf, ADamagedListIsNamedWithItsLine) {
  const TemporaryFolder folder;
  std::ofstream(folder.path() + "/frames.jsonl") << "{\"file\": \"a.png\"}\n";
  EXPECT_THAT([&] { views_of(folder.path()); },
              testing::ThrowsMessage<std::runtime_error>(testing::HasSubstr("frames.jsonl:1:")));
}

}  // namespace
}  // namespace ols::calibration
