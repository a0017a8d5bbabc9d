#include "tools/calibrate/observation_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>
#include <streambuf>

#include "tests/unit/error_text.h"

namespace ols::calibration {
namespace {

const std::string kLevel =
    R"({"kind": "inclinometer", "x_deg": 0.1, "y_deg": 0.2, "sd_deg": 0.001})"
    "\n";

std::string refusal(const std::string& text) {
  std::istringstream file(text);
  return error_text<std::runtime_error>([&] { read_observations(file, "site.jsonl", {"alfa"}); });
}

// A disk that fails after the first block.
class FailingDisk : public std::streambuf {
 public:
  explicit FailingDisk(std::string text) : text_(std::move(text)) {
    setg(text_.data(), text_.data(), text_.data() + text_.size());
  }

 private:
  int_type underflow() override { throw std::runtime_error("input/output error"); }

  std::string text_;
};

TEST(ObservationFile, AKeyThatAppearsTwiceIsNamed) {
  EXPECT_EQ(refusal(kLevel), "");
  EXPECT_EQ(refusal(kLevel + R"({"kind": "inclinometer", "x_deg": 0.1, "x_deg": 9, "y_deg": 0.2})"),
            "site.jsonl:2: x_deg: appears twice");
}

TEST(ObservationFile, WhatItQuotesCannotDriveATerminal) {
  const std::string why = refusal(R"({"kind": "\u001b[2Jstar"})");
  EXPECT_NE(why.find("is not known"), std::string::npos) << why;
  EXPECT_EQ(why.find('\x1b'), std::string::npos);
}

TEST(ObservationFile, ALargeNumberOfAScenePointStaysItself) {
  std::istringstream file(
      R"({"kind": "scene", "reference": 18446744073709551615, "pan_counts": 0, "tilt_counts": 0,)"
      R"( "x_px": 100, "y_px": 50, "sd_px": 0.1, "approach_pan": 1})");
  const auto observations = read_observations(file, "site.jsonl", {"alfa"});
  ASSERT_EQ(observations.size(), 1U);
  EXPECT_EQ(observations[0].reference, "18446744073709551615");
  EXPECT_FALSE(observations[0].sides_stated) << "of the tilt";
}

TEST(ObservationFile, AReadErrorIsNotTheEndOfTheFile) {
  FailingDisk disk(kLevel + kLevel);
  std::istream file(&disk);
  EXPECT_THAT([&] { read_observations(file, "site.jsonl", {"alfa"}); },
              testing::ThrowsMessage<std::runtime_error>("site.jsonl: cannot be read to its end"));
}

TEST(ObservationFile, WhatATargetNeedsIsNamed) {
  const std::string place =
      R"("reference": "a", "pan_counts": 0, "tilt_counts": 0, "x_px": 100, "y_px": 50, "sd_px": 0.1)";
  EXPECT_EQ(refusal(R"({"kind": "level_line", )" + place + "}\n"),
            "site.jsonl:1: x2_px: is missing");
  EXPECT_EQ(refusal(R"({"kind": "level_line", "x2_px": 104, "y2_px": 50, )" + place + "}\n"),
            "site.jsonl:1: x2_px: is nearer than 10 px to the first point of the line");
  EXPECT_EQ(refusal(R"({"kind": "ruler", "distance_m": 20, )" + place + "}\n"),
            "site.jsonl:1: height_m: is missing");
  EXPECT_EQ(refusal(R"({"kind": "cross", "offset_m": 0.1, )" + place + "}\n"),
            "site.jsonl:1: distance_m: is missing");
}

}  // namespace
}  // namespace ols::calibration
