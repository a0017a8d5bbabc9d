#include "edge/camera/picture.h"

#include <array>
#include <opencv2/imgproc.hpp>

#include "conditions/printed.h"

namespace ols::camera {

namespace {

struct FormatRow {
  std::string_view name;
  PixelFormat format;
  int channels;
  int to_gray;  // OpenCV's conversion; it demosaics and weights in one step
};

// The newer of OpenCV's names give a Bayer pattern by its first rows, here GRBG.
constexpr std::array<FormatRow, 7> kFormats{{
    {"Mono8", PixelFormat::kMono8, 1, -1},
    {"BayerGR8", PixelFormat::kBayerGR8, 1, cv::COLOR_BayerGRBG2GRAY},
    {"BayerRG8", PixelFormat::kBayerRG8, 1, cv::COLOR_BayerRGGB2GRAY},
    {"BayerGB8", PixelFormat::kBayerGB8, 1, cv::COLOR_BayerGBRG2GRAY},
    {"BayerBG8", PixelFormat::kBayerBG8, 1, cv::COLOR_BayerBGGR2GRAY},
    {"RGB8", PixelFormat::kRGB8, 3, cv::COLOR_RGB2GRAY},
    {"BGR8", PixelFormat::kBGR8, 3, cv::COLOR_BGR2GRAY},
}};

const FormatRow* row_of(std::uint32_t code) {
  for (const FormatRow& row : kFormats)
    if (static_cast<std::uint32_t>(row.format) == code) return &row;
  return nullptr;
}

// On the camera's memory. cv::Mat takes no const pointer; nothing writes through it.
cv::Mat view_of(const RawPicture& raw) {
  return {raw.height_px, raw.width_px, CV_8UC(row_of(raw.format)->channels),
          const_cast<std::uint8_t*>(raw.data)};
}

}  // namespace

std::optional<PixelFormat> pixel_format(std::string_view genicam_name) {
  for (const FormatRow& row : kFormats)
    if (row.name == genicam_name) return row.format;
  return std::nullopt;
}

std::string pixel_format_name(std::uint32_t code) {
  if (const FormatRow* row = row_of(code)) return std::string(row->name);
  return printed("0x%08x", code);
}

const char* to_string(PictureRefusal refusal) {
  switch (refusal) {
    case PictureRefusal::kNone:
      return "none";
    case PictureRefusal::kWrongSize:
      return "wrong size";
    case PictureRefusal::kWrongFormat:
      return "wrong pixel format";
    case PictureRefusal::kTooShort:
      return "fewer bytes than the size needs";
  }
  return "unknown";
}

PictureRefusal check(const RawPicture& raw, const PictureFormat& expected) {
  if (raw.format != static_cast<std::uint32_t>(expected.format))
    return PictureRefusal::kWrongFormat;
  if (raw.width_px != expected.width_px || raw.height_px != expected.height_px)
    return PictureRefusal::kWrongSize;
  const std::size_t needed = static_cast<std::size_t>(expected.width_px) *
                             static_cast<std::size_t>(expected.height_px) *
                             static_cast<std::size_t>(row_of(raw.format)->channels);
  if (raw.data == nullptr || raw.bytes < needed) return PictureRefusal::kTooShort;
  return PictureRefusal::kNone;
}

cv::Mat to_gray(const RawPicture& raw) {
  const FormatRow& row = *row_of(raw.format);
  if (row.to_gray < 0) return view_of(raw).clone();
  cv::Mat gray;
  cv::cvtColor(view_of(raw), gray, row.to_gray);
  return gray;
}

cv::Mat raw_beside_gray(const RawPicture& raw) {
  return row_of(raw.format)->to_gray < 0 ? cv::Mat() : view_of(raw).clone();
}

}  // namespace ols::camera
