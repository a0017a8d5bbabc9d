#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "edge/video/video_server.h"
#include "tests/unit/base/config/section_text.h"

namespace ols::video {
namespace {

const test::SectionText<VideoConfig> kSection{"video", video_section};

TEST(VideoConfig, OnlyThisComputerMayLookUnlessItSaysMore) {
  const VideoConfig config = kSection.read("address = '10.0.0.11:7790'");
  EXPECT_EQ(config.address, "10.0.0.11:7790");
  EXPECT_EQ(config.allow, VideoConfig{}.allow);
  EXPECT_EQ(kSection.read("address = '10.0.0.11:7790'\nallow = ['10.0.0.0/24']").allow,
            std::vector<std::string>{"10.0.0.0/24"});
}

TEST(VideoConfig, ErrorsNameTheKey) {
  EXPECT_THAT(kSection.error_of("allow = ['10.0.0.0/24']"), testing::HasSubstr("address"));
  EXPECT_THAT(kSection.error_of("address = '0.0.0.0:7790'"), testing::HasSubstr("address: "));
  EXPECT_THAT(kSection.error_of("address = '10.0.0.11:7790'\nallow = ['10.0.0.1']"),
              testing::HasSubstr("allow: \"10.0.0.1\" is not a network"));
}

}  // namespace
}  // namespace ols::video
