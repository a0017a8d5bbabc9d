#include "edge/camera/v4l2/v4l2_config.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <regex>
#include <stdexcept>

namespace ols::camera {
namespace {

void check_controls(const std::string& text) {
  static const std::regex kControls(R"(([a-z][a-z0-9_]*=-?[0-9]+(,[a-z][a-z0-9_]*=-?[0-9]+)*)?)");
  if (!std::regex_match(text, kControls))
    throw std::invalid_argument("must be NAME=NUMBER,NAME=NUMBER,... (v4l2-ctl -l lists them)");
}

void check(ConfigTable& table, const V4l2Config& c) {
  if (c.pixel_format != "Mono8" && c.pixel_format != "BGR8")
    throw table.error("pixel_format", "a V4L2 camera has Mono8 or BGR8");
}

// Cameras offer a few rates, and state them rounded.
std::string rates_about(double rate_hz) {
  const auto thousandths = [](double hz) {
    return std::to_string(std::llround(1e3 * hz)) + "/1000";
  };
  return "[" + thousandths(0.98 * rate_hz) + "," + thousandths(1.02 * rate_hz) + "]";
}

}  // namespace

config::Section v4l2_section(V4l2Config& c) {
  using config::number;
  std::vector<config::Row> rows{
      config::text("device", c.device, "The camera: a path in /dev/v4l/by-id stays the same.")
          .required(),
      config::word("format", c.format, {{"raw", V4l2Format::kRaw}, {"mjpeg", V4l2Format::kMjpeg}},
                   "What the camera sends: raw pictures, or Motion JPEG where USB is too slow."),
      config::text("controls", c.controls,
                   "Set when it is opened: NAME=NUMBER,...; exposure and gain must not change by "
                   "themselves.",
                   check_controls)};
  std::ranges::move(picture_rows(c), std::back_inserter(rows));
  std::vector<config::Row> more{
      number("delay_s", c.delay_s, {-1.0, 1.0}, "s",
             "From mid-exposure to the stamp of the camera's driver."),
      number("delay_sd_s", c.delay_sd_s, {1e-5, 1.0}, "s", "1-sigma of delay_s."),
      number("row_readout_s", c.row_readout_s, {0.0, 0.5}, "s",
             "Rolling shutter: from the exposure of the first row to that of the last; 0: all rows "
             "at once."),
      number("frozen_s", c.frozen_s, {0.0, 3600.0}, "s",
             "A picture that stays the same to the last bit for so long is not used, and the "
             "camera is opened anew; 0: never.")};
  std::ranges::move(more, std::back_inserter(rows));
  return {"camera", "", rows, {}, [&c](ConfigTable& table) { check(table, c); }};
}

std::string v4l2_pipeline(const V4l2Config& c) {
  const std::string type = c.format == V4l2Format::kMjpeg ? "image/jpeg" : "video/x-raw";
  const std::string decoder = c.format == V4l2Format::kMjpeg ? " ! jpegdec" : "";
  return c.element + " name=source ! " + type + ",width=" + std::to_string(c.width_px) +
         ",height=" + std::to_string(c.height_px) + ",framerate=" + rates_about(c.frame_rate_hz) +
         decoder + " ! videoconvert n-threads=1 ! appsink name=sink";
}

}  // namespace ols::camera
