// The camera with GStreamer's test pictures in the place of a device, which no test machine has.
#include "edge/camera/v4l2/v4l2_camera.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/process/clocks.h"
#include "edge/camera/v4l2/v4l2_controls.h"
#include "tests/unit/error_text.h"
#include "tests/unit/eventually.h"

namespace ols::camera {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

V4l2Config config_of(const std::string& element, V4l2Format format) {
  V4l2Config config;
  config.device = "/dev/null";
  config.element = element;
  config.format = format;
  config.width_px = 320;
  config.height_px = 240;
  config.frame_rate_hz = 25.0;
  config.delay_s = 0.5;
  return config;
}

bool says(const V4l2Camera& camera, const std::string& words) {
  return eventually([&] { return camera.report().last_error.find(words) != std::string::npos; });
}

TEST(V4l2Camera, GivesPicturesWithTheirDriversTime) {
  for (const auto& [element, format] :
       {std::pair{"videotestsrc is-live=true pattern=ball", V4l2Format::kRaw},
        std::pair{"videotestsrc is-live=true pattern=ball ! jpegenc", V4l2Format::kMjpeg}}) {
    V4l2Camera camera(config_of(element, format));
    std::optional<Frame> frame;
    std::uint64_t first = 0;
    ASSERT_TRUE(eventually([&] {
      if (auto next = camera.next(0.1)) {
        frame = std::move(next);
        if (first == 0) first = frame->number;
      }
      return frame && frame->number > first + 10;
    })) << camera.report().text;
    EXPECT_EQ(frame->gray.size(), cv::Size(320, 240));
    const double age_s = clock_monotonic_s() - frame->mid_exposure_s;
    EXPECT_GT(age_s, 0.5);
    EXPECT_LT(age_s, 5.5);
  }
}

TEST(V4l2Camera, SaysWhyItHasNoPictures) {
  V4l2Config absent = config_of("v4l2src", V4l2Format::kRaw);
  absent.device = "/dev/no_such_camera";
  const V4l2Camera missing(absent);
  EXPECT_TRUE(says(missing, "no_such_camera"));
  const V4l2Camera other(config_of("audiotestsrc is-live=true", V4l2Format::kRaw));
  EXPECT_TRUE(says(other, "no video"));
  V4l2Config still = config_of("videotestsrc is-live=true pattern=white", V4l2Format::kRaw);
  still.frozen_s = 0.5;
  const V4l2Camera frozen(still);
  EXPECT_TRUE(says(frozen, "same picture"));
}

// Values of controls are the driver's matter; nothing else may reach its text.
TEST(V4l2Config, ControlsAreNamesWithNumbers) {
  const auto error = [](const std::string& controls) {
    return error_text<ConfigError>([&] {
      V4l2Config config;
      ConfigFile file("device = '/dev/video0'\ncontrols = '" + controls + "'", "station.toml");
      config::read(v4l2_section(config), file.root());
    });
  };
  EXPECT_THAT(error("exposure_auto=1,gain=-3"), testing::IsEmpty());
  for (const char* bad : {"gain", "gain=1;x=2", "gain=1 ! filesink", "gain=1,"})
    EXPECT_THAT(error(bad), HasSubstr("controls")) << bad;
}

// GStreamer ignores a control that the camera does not have.
TEST(V4l2Controls, AMistypedOneIsNamed) {
  EXPECT_EQ(v4l2_control_name("Exposure Time, Absolute"), "exposure_time_absolute");
  EXPECT_EQ(v4l2_control_name("(Gain) "), "gain");
  const std::vector<V4l2Control> camera{{"gain", 0, 255}, {"focus_auto", 0, 1}};
  const auto error = [&](const std::string& controls) {
    return error_text<CameraUnfit>([&] { check_v4l2_controls(controls, camera); });
  };
  EXPECT_EQ(error("focus_auto=0,gain=255"), "");
  EXPECT_THAT(error("gain=3,focus_atuo=0"),
              AllOf(HasSubstr("focus_atuo"), HasSubstr("controls"), HasSubstr("focus_auto")));
  EXPECT_THAT(error("gain=256"), AllOf(HasSubstr("gain"), HasSubstr("256 (0...255)")));
}

}  // namespace
}  // namespace ols::camera
