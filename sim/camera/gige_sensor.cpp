#include "sim/camera/gige_sensor.h"

#include "sim/camera/gige_registers.h"

namespace ols::sim::gige {
namespace {

enum Colour : std::size_t { kRed = 0, kGreen = 1, kBlue = 2 };
using Cell = std::array<Colour, 4>;  // row 0: left, right; row 1: left, right

Cell bayer_cell(std::uint32_t format) {
  switch (format) {
    case kBayerGR8:
      return {kGreen, kRed, kBlue, kGreen};
    case kBayerRG8:
      return {kRed, kGreen, kGreen, kBlue};
    case kBayerGB8:
      return {kGreen, kBlue, kRed, kGreen};
    default:
      return {kBlue, kGreen, kGreen, kRed};
  }
}

using Table = std::array<std::uint8_t, 256>;

Table table(double factor) {
  Table t{};
  for (int i = 0; i < 256; ++i)
    t[static_cast<std::size_t>(i)] = cv::saturate_cast<std::uint8_t>(factor * i);
  return t;
}

}  // namespace

int picture_type(std::uint32_t pixel_format) {
  return bytes_per_pixel(pixel_format) == 3 ? CV_8UC3 : CV_8UC1;
}

void develop(const cv::Mat& gray, const std::array<double, 3>& tint, std::uint32_t pixel_format,
             cv::Mat& raw) {
  if (pixel_format == kMono8) return gray.copyTo(raw);
  const std::array<Table, 3> tables{table(tint[kRed]), table(tint[kGreen]), table(tint[kBlue])};
  if (raw.channels() == 3) {
    const bool red_first = pixel_format == kRGB8;
    for (int y = 0; y < gray.rows; ++y) {
      const std::uint8_t* in = gray.ptr(y);
      std::uint8_t* out = raw.ptr(y);
      for (int x = 0; x < gray.cols; ++x, out += 3) {
        out[red_first ? 0 : 2] = tables[kRed][in[x]];
        out[1] = tables[kGreen][in[x]];
        out[red_first ? 2 : 0] = tables[kBlue][in[x]];
      }
    }
    return;
  }
  const Cell cell = bayer_cell(pixel_format);
  for (int y = 0; y < gray.rows; ++y) {
    const std::size_t row = 2 * static_cast<std::size_t>(y % 2);
    const Table* const pair[2] = {&tables[cell[row]], &tables[cell[row + 1]]};
    const std::uint8_t* in = gray.ptr(y);
    std::uint8_t* out = raw.ptr(y);
    for (int x = 0; x < gray.cols; ++x) out[x] = (*pair[x % 2])[in[x]];
  }
}

}  // namespace ols::sim::gige
