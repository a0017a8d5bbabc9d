#include "edge/tracker/background_change.h"

#include <gtest/gtest.h>

#include "tests/unit/edge/tracker/synthetic.h"

namespace ols::tracker {
namespace {

using testing::Backdrop;
using testing::SyntheticScene;

const cv::Point2d kCamera(400.0, 300.0);

class BackgroundChange : public ::testing::Test {
 protected:
  // The background alone, from an image that is off by this many pixels.
  ReferenceFrames::Reference without_target(double misaligned_px) {
    ReferenceFrames::Reference reference;
    reference.gray = scene_.picture(kCamera + cv::Point2d(misaligned_px, 0.0), std::nullopt);
    return reference;
  }

  SyntheticScene scene_{Backdrop::kTextured, 1};
  const cv::Point2d at_{300.0, 220.0};
  const cv::Rect2d box_ = SyntheticScene::box_around(at_);
};

TEST_F(BackgroundChange, AnObjectDiffersMoreThanItsSurroundings) {
  EXPECT_GT(background_change(scene_.picture(kCamera, at_), without_target(0.0), box_), 1.5);
}

TEST_F(BackgroundChange, TheBackgroundDoesNotHoweverBadlyItIsAligned) {
  for (const double off_px : {0.0, 1.0, 4.0}) {
    const double change =
        background_change(scene_.picture(kCamera, std::nullopt), without_target(off_px), box_);
    EXPECT_LT(std::abs(change), 0.6) << off_px;
  }
}

TEST_F(BackgroundChange, ItsReferenceIsAlignedByTheMotionOfTheCamera) {
  ReferenceFrames::Reference turned = without_target(30.0);
  turned.to_present = testing::shift_homography(30.0, 0.0);
  EXPECT_GT(background_change(scene_.picture(kCamera, at_), turned, box_), 1.5);
}

}  // namespace
}  // namespace ols::tracker
