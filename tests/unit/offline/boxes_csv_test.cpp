#include "tools/offline/boxes_csv.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

namespace ols::offline {
namespace {

std::string row(const BoxRow& box) {
  std::ostringstream out;
  write_box(out, box);
  return out.str();
}

TEST(BoxesCsv, ABoxIsItsCornerAndSize) {
  EXPECT_EQ(row({7, cv::Rect2d(1.0, 2.5, 20.0, 10.125), 0.875, "tracking"}),
            "7,1.000,2.500,20.000,10.125,0.8750,tracking\n");
}

TEST(BoxesCsv, ALostTargetHasEmptyFieldsAndAsManyColumns) {
  std::ostringstream header;
  write_boxes_header(header);
  const std::string lost = row({8, std::nullopt, 0.125, "lost"});
  EXPECT_EQ(lost, "8,,,,,0.1250,lost\n");
  EXPECT_EQ(std::ranges::count(lost, ','), std::ranges::count(header.str(), ','));
}

// A number longer than expected must not cut the line.
TEST(BoxesCsv, ExtremeNumbersKeepTheLineWhole) {
  const std::string far =
      row({2'000'000'000, cv::Rect2d(-1e12, 1e12, 1e12, 1e12), 1.0, "coasting"});
  EXPECT_TRUE(far.ends_with(",1.0000,coasting\n")) << far;
}

}  // namespace
}  // namespace ols::offline
