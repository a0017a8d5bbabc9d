#include "tools/calibrate/board_fit.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgcodecs.hpp>
#include <random>
#include <set>
#include <stdexcept>
#include <utility>

#include "tools/calibrate/board_detection.h"

namespace ols::calibration {
namespace {

const cv::Size kPicture(640, 480);

// Boards of 9 x 6 corners, tilted all around, with noise of a tenth of a pixel.
std::vector<BoardView> boards(std::uint32_t seed, int count = 12) {
  std::mt19937 random(seed);
  std::normal_distribution<float> noise(0.0F, 0.1F);
  const cv::Matx33d K(535.0, 0.0, 330.0, 0.0, 536.0, 236.0, 0.0, 0.0, 1.0);
  const cv::Vec<double, 5> distortion(-0.25, 0.05, 0.001, -0.0005, 0.02);
  std::vector<BoardView> views;
  for (int i = 0; i < count; ++i) {
    BoardView view;
    for (int k = 0; k < 54; ++k) {
      view.board.emplace_back(0.025F * static_cast<float>(k % 9),
                              0.025F * static_cast<float>(k / 9), 0.0F);
    }
    const cv::Vec3d turn(0.5 * std::sin(i), 0.5 * std::cos(1.7 * i), 0.2 * i);
    const cv::Vec3d shift(-0.1 + 0.01 * i, -0.06, 0.3 + 0.02 * i);
    cv::projectPoints(view.board, turn, shift, K, distortion, view.pixels);
    for (cv::Point2f& pixel : view.pixels) pixel += cv::Point2f(noise(random), noise(random));
    views.push_back(std::move(view));
  }
  return views;
}

// The told covariance is that of the errors: by the squares of 20 cameras, whitened.
TEST(BoardFit, ItsCovarianceIsThatOfItsErrors) {
  using Vector = Eigen::Matrix<double, 9, 1>;  // all but k4, which the model lacks
  const Vector truth{{535.0, 536.0 / 535.0, 330.0, 236.0, -0.25, 0.05, 0.001, -0.0005, 0.02}};
  constexpr int kCameras = 20;
  double squares = 0.0;
  for (int i = 0; i < kCameras; ++i) {
    const BoardCamera found = fit_boards(boards(100U + static_cast<std::uint32_t>(i)), kPicture);
    const Vector off = found.values.head<9>() - truth;
    squares += off.dot(found.covariance.topLeftCorner<9, 9>().inverse() * off);
    EXPECT_NEAR(found.rms_px, 0.14, 0.02);
    EXPECT_EQ(found.view_rms_px.size(), 12U);
  }
  // Chi-square with 180 degrees of freedom: within four deviations.
  EXPECT_NEAR(squares, 9.0 * kCameras, 4.0 * std::sqrt(2.0 * 9.0 * kCameras));
}

// The same of lenses of 120 degrees, with half the boards beside the middle.
class RadialBoardFit : public testing::TestWithParam<LensModel> {};

TEST_P(RadialBoardFit, ItsCovarianceIsThatOfItsErrors) {
  CameraIntrinsics truth;
  truth.model = GetParam();
  truth.width_px = kPicture.width, truth.height_px = kPicture.height;
  truth.fx_px = 300.0, truth.fy_px = 301.0, truth.cx_px = 330.0, truth.cy_px = 236.0;
  truth.k1 = -0.03, truth.k2 = 0.02, truth.k3 = -0.01, truth.k4 = 0.002;
  using Vector = Eigen::Matrix<double, 8, 1>;  // all but p1, p2
  const std::array of{0, 1, 2, 3, 4, 5, 8, 9};
  const Vector values{{300.0, 301.0 / 300.0, 330.0, 236.0, -0.03, 0.02, -0.01, 0.002}};
  constexpr int kCameras = 20;
  double squares = 0.0;
  for (std::uint32_t seed = 1; seed <= kCameras; ++seed) {
    std::mt19937 random(seed);
    std::normal_distribution<double> noise(0.0, 0.1);
    std::vector<BoardView> views;
    for (int i = 0; i < 12; ++i) {
      const Eigen::Vector3d turn(0.5 * std::sin(i), 0.5 * std::cos(1.7 * i), 0.2 * i);
      const Eigen::AngleAxisd R(turn.norm(), turn.normalized());
      const Eigen::Vector3d shift(-0.1 + 0.2 * std::sin(2.0 * i), -0.06 + 0.1 * std::cos(3.0 * i),
                                  0.2 + 0.01 * i);
      BoardView view;
      for (int k = 0; k < 54; ++k) {
        const Eigen::Vector3d p(0.025 * (k % 9), 0.025 * (k / 9), 0.0);
        const auto pixel = project(truth, R * p + shift);
        ASSERT_TRUE(pixel);
        view.board.emplace_back(p.x(), p.y(), p.z());
        view.pixels.emplace_back(pixel->x() + noise(random), pixel->y() + noise(random));
      }
      views.push_back(std::move(view));
    }
    const BoardCamera found = fit_boards(views, kPicture, GetParam());
    const Vector off = found.values(of) - values;
    const Eigen::Matrix<double, 8, 8> covariance = found.covariance(of, of);
    squares += off.dot(covariance.inverse() * off);
    EXPECT_NEAR(found.rms_px, 0.14, 0.02);
    EXPECT_EQ(found.view_rms_px.size(), 12U);
  }
  RecordProperty("chi_square_over_freedom", std::to_string(squares / (8.0 * kCameras)));
  EXPECT_NEAR(squares, 8.0 * kCameras, 4.0 * std::sqrt(2.0 * 8.0 * kCameras));
}
INSTANTIATE_TEST_SUITE_P(Models, RadialBoardFit,
                         testing::Values(LensModel::kFisheye, LensModel::kPolynomial));

// The pictures that OpenCV comes with, from a folder that not everybody has: both cameras beside
// what OpenCV 4.10 found (reference.json there, corners refined in a window of the same size).
class Chessboards : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    const char* shared = std::getenv("OLS_SHARED");
    folder_ = shared ? std::string(shared) + "/data/calibration/opencv_chessboard" : "";
    if (!std::filesystem::is_directory(folder_)) GTEST_SKIP() << "OLS_SHARED is not set";
    std::ifstream file(folder_ + "/reference.json");
    reference_ = nlohmann::json::parse(file).at("measured").at("cornerSubPix_5");
  }
  std::vector<BoardView> views(const std::string& camera) const {
    std::set<std::string> paths;
    for (const auto& entry : std::filesystem::directory_iterator(folder_)) {
      const bool is_of = entry.path().filename().string().starts_with(camera);
      if (is_of && entry.path().extension() == ".jpg") paths.insert(entry.path());
    }
    std::vector<BoardView> all;
    for (const std::string& path : paths) {
      all.push_back(find_board(cv::imread(path, cv::IMREAD_GRAYSCALE), kBoard));
    }
    return all;
  }
  static constexpr int kPairs = 13;
  const BoardShape kBoard{"chessboard", 9, 6, 0.025, 0.0};
  std::string folder_;
  nlohmann::json reference_;
};

// By OpenCV's own standard errors of the same corners, which are the reference's: its file has
// none.
TEST_P(Chessboards, AreWithinTheReferencesStandardErrors) {
  const auto all = views(GetParam());
  ASSERT_EQ(all.size(), static_cast<std::size_t>(kPairs));
  const BoardCamera found = fit_boards(all, kPicture);
  std::vector<std::vector<cv::Point3f>> boards;
  std::vector<std::vector<cv::Point2f>> pixels;
  for (const BoardView& one : all) {
    boards.push_back(one.board);
    pixels.push_back(one.pixels);
  }
  cv::Mat K, distortion, deviations, poses, errors;
  std::vector<cv::Mat> turns, shifts;
  cv::calibrateCamera(boards, pixels, kPicture, K, distortion, turns, shifts, deviations, poses,
                      errors);
  const auto there = reference_.at(GetParam() + "_free");
  const double fx = found.values[0];
  const std::array<std::pair<const char*, double>, 4> of{
      {{"fx", fx}, {"fy", fx * found.values[1]}, {"cx", found.values[2]}, {"cy", found.values[3]}}};
  for (std::size_t k = 0; k < of.size(); ++k) {
    const double sd_px = deviations.at<double>(static_cast<int>(k));
    const double off_px = of.at(k).second - there.at(of.at(k).first).get<double>();
    EXPECT_LT(std::abs(off_px), 0.1 * sd_px) << of.at(k).first;
    std::printf("%s %s: off by %+.3f px, standard error of the reference %.3f px\n",
                GetParam().c_str(), of.at(k).first, off_px, sd_px);
  }
  // What we tell is smaller: OpenCV 4.6 counts a corner as one observation, not as two.
  constexpr double kCorners = 54.0 * kPairs, kUnknowns = 9.0 + 6.0 * kPairs;
  const double as_opencv = std::sqrt((2.0 * kCorners - kUnknowns) / (kCorners - kUnknowns));
  EXPECT_NEAR(as_opencv * std::sqrt(found.covariance(0, 0)) / deviations.at<double>(0), 1.0, 0.01);
}
INSTANTIATE_TEST_SUITE_P(Both, Chessboards, testing::Values("left", "right"));

// The way from one camera to the other, by each pair of pictures; their scatter is its error.
class ChessboardPairs : public Chessboards {};
TEST_P(ChessboardPairs, TheirBaselineIsWithinItsStandardError) {
  const auto left = views("left"), right = views("right");
  ASSERT_EQ(left.size(), right.size());
  const auto pose = [](const BoardCamera& camera, const BoardView& view, cv::Mat& turn,
                       cv::Mat& shift) {
    const auto& v = camera.values;
    const cv::Matx33d K(v[0], 0.0, v[2], 0.0, v[0] * v[1], v[3], 0.0, 0.0, 1.0);
    cv::Mat vector;
    cv::solvePnP(view.board, view.pixels, K, cv::Vec<double, 5>(v[4], v[5], v[6], v[7], v[8]),
                 vector, shift);
    cv::Rodrigues(vector, turn);
  };
  const BoardCamera here = fit_boards(left, kPicture), there = fit_boards(right, kPicture);
  std::vector<double> baselines_m;
  for (std::size_t i = 0; i < left.size(); ++i) {
    cv::Mat left_turn, left_shift, right_turn, right_shift;
    pose(here, left[i], left_turn, left_shift);
    pose(there, right[i], right_turn, right_shift);
    baselines_m.push_back(cv::norm(right_shift - right_turn * left_turn.t() * left_shift));
  }
  double mean_m = 0.0, squares = 0.0;
  for (const double one : baselines_m) mean_m += one / kPairs;
  for (const double one : baselines_m) squares += std::pow(one - mean_m, 2);
  const double error_m = std::sqrt(squares / (kPairs * (kPairs - 1)));
  const double expected_m = reference_.at("stereo").at("baseline_m").get<double>();
  std::printf("baseline %.5f m +- %.5f, reference %.5f m\n", mean_m, error_m, expected_m);
  EXPECT_LT(error_m, 5e-4);
  EXPECT_LT(std::abs(mean_m - expected_m), 2.0 * error_m);
}
INSTANTIATE_TEST_SUITE_P(Both, ChessboardPairs, testing::Values("both"));

TEST(BoardFit, FewBoardsAreRefused) {
  EXPECT_THROW(fit_boards(boards(1, 4), kPicture), std::invalid_argument);
}

}  // namespace
}  // namespace ols::calibration
