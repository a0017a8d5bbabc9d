#include "edge/detector/dim_finder.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <set>
#include <vector>

namespace ols::detector {
namespace {

constexpr double kInterval_s = 0.1;
constexpr double kNoise = 2.0;    // [grey levels]
constexpr double kBell_px = 0.9;  // of a point
const cv::Size kSize(320, 256);

// A point that moves evenly. `signal`: after a matched filter, in one image.
struct Mover {
  Eigen::Vector2d from, velocity_px;
  double signal;

  Eigen::Vector2d at(int image) const { return from + image * velocity_px; }
};

void draw(cv::Mat& picture, const Eigen::Vector2d& at, double signal) {
  const double light = signal * kNoise * 2.0 * std::sqrt(std::numbers::pi) * kBell_px;
  const double peak = light / (2.0 * std::numbers::pi * kBell_px * kBell_px);
  for (int y = 0; y < picture.rows; ++y) {
    if (std::abs(y - at.y()) > 6.0) continue;
    for (int x = 0; x < picture.cols; ++x) {
      const double apart2 = (Eigen::Vector2d(x, y) - at).squaredNorm();
      if (apart2 > 36.0) continue;
      picture.at<float>(y, x) +=
          static_cast<float>(peak * std::exp(-0.5 * apart2 / (kBell_px * kBell_px)));
    }
  }
}

// Draws the scene of an image, by its number.
using Scene = std::function<void(int, cv::Mat&)>;

class Look {
 public:
  explicit Look(unsigned seed) : random_(seed) {}

  std::vector<Detection> at(int image, const Scene& scene, const Eigen::Vector2d& shift_px) {
    cv::Mat picture(kSize, CV_32F, cv::Scalar(120.3)), noise(kSize, CV_32F), gray;
    scene(image, picture);
    random_.fill(noise, cv::RNG::NORMAL, 0.0, kNoise);
    cv::add(picture, noise, picture);
    picture.convertTo(gray, CV_8U);
    Eigen::Matrix3d motion = Eigen::Matrix3d::Identity();
    motion.topRightCorner<2, 1>() = shift_px;
    return finder_.find(gray, image * kInterval_s, motion);
  }

 private:
  cv::RNG random_;
  DimFinder finder_{DimConfig{}};
};

// Number of detections in `images` images of a scene.
std::size_t count(const Scene& scene, int images, unsigned seed = 5) {
  Look look(seed);
  std::size_t found = 0;
  for (int i = 0; i < images; ++i) found += look.at(i, scene, {0.0, 0.0}).size();
  return found;
}

struct Seen {
  int image;
  Detection detection;
};

// What was found of a point; `shift_px`: of the scene, per image.
std::vector<Seen> seen(const Mover& mover, int images, unsigned seed,
                       const Eigen::Vector2d& shift_px = {0.0, 0.0}) {
  constexpr double kNear_px = 6.0;
  Look look(seed);
  std::vector<Seen> found;
  const Scene scene = [&](int image, cv::Mat& picture) {
    draw(picture, mover.at(image) + image * shift_px, mover.signal);
  };
  for (int i = 0; i < images; ++i) {
    for (const Detection& detection : look.at(i, scene, shift_px)) {
      if ((detection.pixel - mover.at(i) - i * shift_px).norm() < kNear_px)
        found.push_back({i, detection});
    }
  }
  return found;
}

const std::vector<Mover>& movers() {
  static const std::vector<Mover> all{{{60.0, 60.0}, {1.7, 0.8}, 3.0},
                                      {{250.0, 200.0}, {-2.4, -1.1}, 3.0},
                                      {{60.0, 220.0}, {1.3, -1.9}, 3.0},
                                      {{160.0, 40.0}, {-0.2, 2.2}, 3.0},
                                      {{40.0, 120.0}, {3.1, 0.3}, 3.0}};
  return all;
}

TEST(DimFinder, FindsPointsOfThreeStandardDeviationsAndStaysOnThem) {
  for (const double sign : {1.0, -1.0}) {
    std::size_t measured = 0;
    for (std::size_t i = 0; i < movers().size(); ++i) {
      Mover mover = movers()[i];
      mover.signal *= sign;
      const auto found = seen(mover, 72, static_cast<unsigned>(i + 1));
      measured += found.size();
      for (const Seen& one : found) EXPECT_EQ(one.detection.brighter, sign > 0.0);
    }
    // Of at most eight: the first after sixteen images, then one in eight.
    EXPECT_GE(measured, 5 * movers().size());
  }
}

TEST(DimFinder, StatesItsErrors) {
  double squares = 0.0, speed_squares = 0.0;
  int count = 0;
  for (std::size_t i = 0; i < movers().size(); ++i) {
    const Mover& mover = movers()[i];
    for (const Seen& one : seen(mover, 72, static_cast<unsigned>(i + 11))) {
      squares += (one.detection.pixel - mover.at(one.image)).squaredNorm();
      ASSERT_TRUE(one.detection.path);
      speed_squares +=
          (kInterval_s * one.detection.path->velocity_px_s - mover.velocity_px).squaredNorm();
      ++count;
    }
  }
  ASSERT_GT(count, 20);
  const double rms_px = std::sqrt(squares / (2.0 * count));  // of one axis
  const double sd_px = Detection{.evidence = Evidence::kStack}.sd_px();
  EXPECT_LT(rms_px, 1.1 * sd_px);
  EXPECT_GT(rms_px, 0.5 * sd_px);
  EXPECT_LT(std::sqrt(speed_squares / (2.0 * count)), 0.2);  // [px per image]
}

TEST(DimFinder, MeasuresAPointOnceInEightImages) {
  const auto found = seen(movers()[0], 90, 1);
  ASSERT_GE(found.size(), 5U);
  std::set<long> ids;
  for (std::size_t i = 0; i < found.size(); ++i) {
    ids.insert(found[i].detection.path->id);
    if (i > 0) EXPECT_GE(found[i].image - found[i - 1].image, 8);
  }
  EXPECT_EQ(ids.size(), 1U);
}

TEST(DimFinder, FollowsRelativeToTheSceneWhileTheCameraTurns) {
  Mover mover = movers()[0];
  mover.velocity_px = {1.5, 1.0};
  const auto found = seen(mover, 64, 1, {-2.6, 1.2});
  ASSERT_GE(found.size(), 3U);
  const Eigen::Vector2d velocity = kInterval_s * found.back().detection.path->velocity_px_s;
  EXPECT_LT((velocity - mover.velocity_px).norm(), 0.4);
}

TEST(DimFinder, FindsHardlyAnythingInNoise) {
  EXPECT_LE(count([](int, cv::Mat&) {}, 300), 6U);
}

TEST(DimFinder, StarsAndDefectsOfTheSensorAreNoMovers) {
  const auto found = count(
      [](int, cv::Mat& picture) {
        for (int y = 20; y < kSize.height; y += 40) {
          for (int x = 20; x < kSize.width; x += 40) picture.at<float>(y, x) += 12.0F;
        }
      },
      150);
  EXPECT_LE(found, 1U);
}

TEST(DimFinder, MovingTextureIsNotSearched) {
  cv::Mat texture(kSize.height, 2 * kSize.width, CV_32F);
  cv::RNG(9).fill(texture, cv::RNG::NORMAL, 0.0, 20.0);
  cv::GaussianBlur(texture, texture, cv::Size(0, 0), 2.0);
  const auto found = count(
      [&](int image, cv::Mat& picture) {
        cv::add(picture, texture(cv::Rect({image, 0}, kSize)), picture);
      },
      120);
  EXPECT_EQ(found, 0U);
}

TEST(DimFinder, BeginsAnewAfterAPause) {
  const Mover mover = movers()[0];
  cv::RNG random(1);
  DimFinder finder{DimConfig{}};
  std::vector<int> images;
  for (int i = 0; i < 80; ++i) {
    cv::Mat picture(kSize, CV_32F), gray;
    random.fill(picture, cv::RNG::NORMAL, 120.3, kNoise);
    draw(picture, mover.at(i), 2.0 * mover.signal);
    picture.convertTo(gray, CV_8U);
    const double pause_s = i < 40 ? 0.0 : 2.0;
    if (!finder.find(gray, i * kInterval_s + pause_s, std::nullopt).empty()) images.push_back(i);
  }
  ASSERT_FALSE(images.empty());
  EXPECT_LT(images.front(), 40);
  EXPECT_GT(images.back(), 40 + 14);
  for (const int image : images) EXPECT_TRUE(image < 40 || image >= 40 + 15) << image;
}

TEST(DimFinder, SearchesTheSkyThatFollowsTheGround) {
  constexpr int kGround = 40;
  cv::Mat texture(kSize, CV_32F);
  cv::RNG(9).fill(texture, cv::RNG::NORMAL, 0.0, 20.0);
  Look look(2);
  const Mover mover = movers()[0];
  std::size_t found = 0;
  for (int i = 0; i < kGround + 120; ++i) {
    const Scene scene = [&](int image, cv::Mat& picture) {
      if (image < kGround) {
        cv::add(picture, texture, picture);
      } else {
        draw(picture, mover.at(image - kGround), 5.0);
      }
    };
    found += look.at(i, scene, {0.0, 0.0}).size();
  }
  EXPECT_GE(found, 2U);
}

TEST(DimFinder, AFlashInOneImageIsNoPoint) {
  const auto found = count(
      [](int image, cv::Mat& picture) {
        if (image % 20 == 10) draw(picture, {100.0, 100.0}, 60.0);
      },
      120);
  EXPECT_LE(found, 1U);
}

}  // namespace
}  // namespace ols::detector
