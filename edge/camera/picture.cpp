#include "edge/camera/picture.h"

#include <opencv2/imgproc.hpp>

namespace ols {

std::optional<PixelFormat> pixel_format(std::string_view genicam_name) {
  if (genicam_name == "Mono8") return PixelFormat::kMono8;
  if (genicam_name == "BayerGR8") return PixelFormat::kBayerGR8;
  if (genicam_name == "BayerRG8") return PixelFormat::kBayerRG8;
  if (genicam_name == "BayerGB8") return PixelFormat::kBayerGB8;
  if (genicam_name == "BayerBG8") return PixelFormat::kBayerBG8;
  return std::nullopt;
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
  const std::size_t needed =
      static_cast<std::size_t>(expected.width_px) * static_cast<std::size_t>(expected.height_px);
  if (raw.data == nullptr || raw.bytes < needed) return PictureRefusal::kTooShort;
  return PictureRefusal::kNone;
}

cv::Mat to_gray(const RawPicture& raw) {
  // cv::Mat takes no pointer to const; nothing below writes through it.
  const cv::Mat picture(raw.height_px, raw.width_px, CV_8UC1, const_cast<std::uint8_t*>(raw.data));
  cv::Mat gray;
  switch (static_cast<PixelFormat>(raw.format)) {
    case PixelFormat::kMono8:
      gray = picture.clone();
      break;
    case PixelFormat::kBayerGR8:
      cv::cvtColor(picture, gray, cv::COLOR_BayerGRBG2GRAY);
      break;
    case PixelFormat::kBayerRG8:
      cv::cvtColor(picture, gray, cv::COLOR_BayerRGGB2GRAY);
      break;
    case PixelFormat::kBayerGB8:
      cv::cvtColor(picture, gray, cv::COLOR_BayerGBRG2GRAY);
      break;
    case PixelFormat::kBayerBG8:
      cv::cvtColor(picture, gray, cv::COLOR_BayerBGGR2GRAY);
      break;
  }
  return gray;
}

}  // namespace ols
