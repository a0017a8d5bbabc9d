// Checks the raw image of a camera and converts it to gray, for the tracker. Pure.
#pragma once

#include <cstddef>
#include <cstdint>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <string_view>

namespace ols::camera {

// The supported pixel formats, with their codes in GenICam's PFNC.
enum class PixelFormat : std::uint32_t {
  kMono8 = 0x01080001,
  kBayerGR8 = 0x01080008,
  kBayerRG8 = 0x01080009,
  kBayerGB8 = 0x0108000A,
  kBayerBG8 = 0x0108000B,
  kRGB8 = 0x02180014,
  kBGR8 = 0x02180015,
};
// The format for a GenICam name such as "Mono8", "BayerRG8" or "RGB8"; nullopt if it is not
// supported.
std::optional<PixelFormat> pixel_format(std::string_view genicam_name);
// The GenICam name for a PFNC code; for an unsupported code, the code in hexadecimal.
std::string pixel_format_name(std::uint32_t code);

struct RawPicture {
  const std::uint8_t* data = nullptr;
  std::size_t bytes = 0;
  int width_px = 0;
  int height_px = 0;
  std::uint32_t format = 0;  // PFNC code
};

struct PictureFormat {
  int width_px = 0;
  int height_px = 0;
  PixelFormat format = PixelFormat::kMono8;
};

enum class PictureRefusal { kNone, kWrongSize, kWrongFormat, kTooShort };
const char* to_string(PictureRefusal refusal);

PictureRefusal check(const RawPicture& raw, const PictureFormat& expected);

// Returns the gray image as a copy, because the camera's buffer is reused. `raw` must have passed
// check().
cv::Mat to_gray(const RawPicture& raw);

// Returns a copy of the raw image: a Bayer mosaic, or three channels in the camera's order. Returns
// an empty image for Mono8, because the gray image is then the raw image.
cv::Mat raw_beside_gray(const RawPicture& raw);

}  // namespace ols::camera
