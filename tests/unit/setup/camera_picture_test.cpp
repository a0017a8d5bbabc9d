#include "tools/setup/camera_picture.h"

#include <gtest/gtest.h>

namespace ols::setup {
namespace {

// As a terminal draws it: the gray of each half of a character.
cv::Mat drawn(const std::string& text) {
  std::vector<std::vector<int>> upper(1), lower(1);
  const std::string block = "\u2580";
  for (std::size_t at = 0; at < text.size();) {
    int top = 0, bottom = 0, length = 0;
    if (std::sscanf(text.c_str() + at, "\x1b[38;5;%d;48;5;%dm%n", &top, &bottom, &length) == 2) {
      upper.back().push_back((top - 232) * 255 / 23);
      lower.back().push_back((bottom - 232) * 255 / 23);
      EXPECT_EQ(text.substr(at + length, block.size()), block);
      at += length + block.size();
    } else {
      const std::string end = "\x1b[0m\n";
      EXPECT_EQ(text.substr(at, end.size()), end);
      at += end.size();
      upper.emplace_back();
      lower.emplace_back();
    }
  }
  const int rows = static_cast<int>(upper.size()) - 1, columns = static_cast<int>(upper[0].size());
  cv::Mat picture(2 * rows, columns, CV_8U);
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      picture.at<unsigned char>(2 * row, column) = upper[row][column];
      picture.at<unsigned char>(2 * row + 1, column) = lower[row][column];
    }
  }
  return picture;
}

TEST(CameraPicture, ATerminalShowsItsBrightnessWhereItIs) {
  cv::Mat gray(480, 640, CV_8U, cv::Scalar(40));
  gray(cv::Rect(320, 0, 320, 240)).setTo(255);  // top right
  gray(cv::Rect(0, 240, 320, 240)).setTo(0);    // bottom left
  const cv::Mat seen = drawn(half_blocks(gray, 80));
  EXPECT_EQ(seen.size(), cv::Size(80, 60));
  EXPECT_EQ(seen.at<unsigned char>(10, 60), 255);
  EXPECT_EQ(seen.at<unsigned char>(50, 20), 0);
  EXPECT_NEAR(seen.at<unsigned char>(10, 20), 40, 12);
  EXPECT_EQ(drawn(half_blocks(gray(cv::Rect(0, 0, 20, 1)), 80)).size(), cv::Size(20, 2));
}

}  // namespace
}  // namespace ols::setup
