#include "console/replay/recorded_frames.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>

namespace ols::console {
namespace {

std::string png(char width, char height) {
  return std::string("\x89PNG\r\n\x1a\n\0\0\0\x0dIHDR\0\0\0", 19) + width +
         std::string("\0\0\0", 3) + height + "rest";
}

class RecordedFramesTest : public testing::Test {
 protected:
  RecordedFramesTest() { std::filesystem::remove_all(folder_); }
  ~RecordedFramesTest() override { std::filesystem::remove_all(folder_); }

  void event(const std::string& name, const std::string& rows) const {
    std::filesystem::create_directories(folder_ / name);
    std::ofstream(folder_ / name / "frames.csv")
        << "utime_us,number,file,mid_exposure_sd_s,pixel_format\n"
        << rows;
  }
  void file(const std::string& name, const std::string& bytes) const {
    std::ofstream(folder_ / name, std::ios::binary) << bytes;
  }

  std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() /
      ("ols_frames_" + std::to_string(reinterpret_cast<std::uintptr_t>(this)));
};

TEST_F(RecordedFramesTest, GivesTheFrameOfAnInstantOnce) {
  event("bird", "1000000,1,1000000.png,0.0001,Mono8\n1100000,2,1100000.png,0.0001,Mono8\n");
  file("bird/1000000.png", png(64, 48));
  file("bird/1100000.png", png(64, 48));
  RecordedFrames frames;
  frames.add("alfa", folder_.string());
  EXPECT_EQ(frames.events().at(0).at("name"), "bird");
  EXPECT_EQ(frames.events().at(0).at("frames"), 2);
  EXPECT_FALSE(frames.newest("alfa", 999'999)) << "before the first";
  const auto picture = frames.newest("alfa", 1'050'000);
  ASSERT_TRUE(picture);
  EXPECT_EQ(picture->header.at("utime_us"), 1'000'000);
  EXPECT_EQ(picture->header.at("full_px"), (Json{64, 48}));
  EXPECT_FALSE(frames.newest("alfa", 1'060'000)) << "the same";
  frames.give_again();
  EXPECT_TRUE(frames.newest("alfa", 1'060'000));
  EXPECT_TRUE(frames.newest("alfa", 1'100'000));
  EXPECT_FALSE(frames.newest("alfa", 1'100'001 + RecordedFrames::kOld_us)) << "too old";
  EXPECT_FALSE(frames.newest("bravo", 1'100'000));
}

TEST_F(RecordedFramesTest, SaysWhichRowIsDamagedAndReadsTheOthers) {
  event("bird", "x\n1000000,1,../secret.png,0,Mono8\n2000000,1,2000000.png,0,Mono8\n");
  file("bird/2000000.png", "no picture");
  RecordedFrames frames;
  frames.add("alfa", folder_.string());
  EXPECT_EQ(frames.events().at(0).at("frames"), 1);
  ASSERT_EQ(frames.problems().size(), 2U);
  EXPECT_TRUE(frames.problems().at(0).ends_with("frames.csv:2: is no row of a frame"));
  EXPECT_FALSE(frames.newest("alfa", 2'000'000));
  EXPECT_TRUE(frames.problems().at(2).ends_with("2000000.png: is no PNG"));
}

TEST_F(RecordedFramesTest, NamesAFolderWithoutEvents) {
  RecordedFrames frames;
  EXPECT_THROW(frames.add("alfa", folder_.string()), std::invalid_argument);
  std::filesystem::create_directories(folder_);
  EXPECT_THROW(frames.add("alfa", folder_.string()), std::invalid_argument);
}

TEST(PngSize, IsInTheHeader) {
  EXPECT_EQ(png_size(png(3, 2)), (std::pair{3, 2}));
  EXPECT_FALSE(png_size(png(0, 2)));
  EXPECT_FALSE(png_size("GIF89a and more than twenty-four bytes"));
  EXPECT_FALSE(png_size(""));
}

}  // namespace
}  // namespace ols::console
