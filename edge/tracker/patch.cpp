#include "edge/tracker/patch.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core/hal/intrin.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "edge/tracker/median.h"

namespace ols::tracker {
namespace {

// [px] Of the image across a patch, except for a box many times wider than high.
constexpr int kMostSpan = 512;

double grid_position(double centre, double length, int index) {
  return centre + ((index + 0.5) / kPatchSide - 0.5) * length;
}

// One axis of the sampling grid: each sample's two neighbours and the second one's weight.
struct Axis {
  std::array<int, kPatchSide> low;
  std::array<int, kPatchSide> high;
  std::array<float, kPatchSide> weight;

  double at(std::size_t i) const { return low[i] + static_cast<double>(weight[i]); }
};

Axis make_axis(double centre, double length, int limit) {
  Axis axis;
  for (int i = 0; i < kPatchSide; ++i) {
    const double at = std::clamp(grid_position(centre, length, i), 0.0, limit - 1.0);
    const int low = static_cast<int>(at);
    const auto k = static_cast<std::size_t>(i);
    axis.low[k] = low;
    axis.high[k] = std::min(low + 1, limit - 1);
    axis.weight[k] = static_cast<float>(at - low);
  }
  return axis;
}

// The same with the nearest pixel, which may be outside the image.
std::array<int, kPatchSide> nearest_pixels(double centre, double length) {
  std::array<int, kPatchSide> pixels;
  for (int i = 0; i < kPatchSide; ++i) {
    // Truncation rounds down only if the number is not negative.
    const double at = grid_position(centre, length, i) + 0.5;
    pixels[static_cast<std::size_t>(i)] = at < 0.0 ? -1 : static_cast<int>(at);
  }
  return pixels;
}

// Interpolates between two image rows, pixel by pixel.
void between(const std::uint8_t* upper, const std::uint8_t* lower, float weight, int count,
             float* out) {
  for (int i = 0; i < count; ++i) {
    const float a = upper[i];
    out[i] = a + weight * (static_cast<float>(lower[i]) - a);
  }
}

// Grey values around the box, at 0.7 of its size from the centre.
std::vector<float> surroundings(const FrameView& view, const Eigen::Vector2d& pixel,
                                const Eigen::Vector2d& size_px) {
  constexpr int kSamples = 96;
  std::vector<float> values;
  for (int i = 0; i < kSamples; ++i) {
    const double t = 8.0 * i / kSamples;  // once around the square
    const double along = 2.0 * (t - std::floor(t / 2.0) * 2.0) - 2.0;
    const int side = static_cast<int>(t / 2.0);
    const double u = side == 0 ? along + 1.0 : side == 1 ? 1.0 : side == 2 ? -along - 1.0 : -1.0;
    const double v = side == 0 ? -1.0 : side == 1 ? along + 1.0 : side == 2 ? 1.0 : -along - 1.0;
    values.push_back(bilinear(view.image, view.x_of(pixel.x() + 0.7 * u * size_px.x()),
                              view.y_of(pixel.y() + 0.7 * v * size_px.y())));
  }
  return values;
}

// The largest deviation from the plane through the patch: a sky's gradient is no structure.
float structure_of(const Patch& gray) {
  constexpr float kMiddle = (kPatchSide - 1) / 2.0F;
  float sum = 0.0F, along_x = 0.0F, along_y = 0.0F, squares = 0.0F;
  for (std::size_t i = 0; i < kPatchArea; ++i) {
    const float x = static_cast<float>(i % kPatchSide) - kMiddle;
    const float y = static_cast<float>(i / kPatchSide) - kMiddle;
    sum += gray[i];
    along_x += x * gray[i];
    along_y += y * gray[i];
    squares += x * x;
  }
  float greatest = 0.0F;
  for (std::size_t i = 0; i < kPatchArea; ++i) {
    const float x = static_cast<float>(i % kPatchSide) - kMiddle;
    const float y = static_cast<float>(i / kPatchSide) - kMiddle;
    const float plane = sum / kPatchArea + (along_x * x + along_y * y) / squares;
    greatest = std::max(greatest, std::abs(gray[i] - plane));
  }
  return greatest;
}

}  // namespace

double pixel_noise(const cv::Mat& image) {
  constexpr int kStep = 7;
  std::vector<int> left;
  for (int row = 1; row + 1 < image.rows; row += kStep) {
    const auto* a = image.ptr<std::uint8_t>(row - 1);
    const auto* b = image.ptr<std::uint8_t>(row);
    const auto* c = image.ptr<std::uint8_t>(row + 1);
    for (int i = 1; i + 1 < image.cols; i += kStep) {
      left.push_back(std::abs(a[i - 1] - 2 * a[i] + a[i + 1] -
                              2 * (b[i - 1] - 2 * b[i] + b[i + 1]) + c[i - 1] - 2 * c[i] +
                              c[i + 1]));
    }
  }
  if (left.empty()) return 0.0;
  const auto middle = left.begin() + static_cast<std::ptrdiff_t>(left.size() / 2);
  std::nth_element(left.begin(), middle, left.end());
  return 1.4826 * *middle / 6.0;  // 6 is the norm of the kernel
}

int reduction_for(const Eigen::Vector2d& size_px) {
  return std::max(1, static_cast<int>(std::min(size_px.x(), size_px.y()) / kPatchSide));
}

FrameView make_view(const cv::Mat& frame, const cv::Rect& area, int reduction) {
  const cv::Rect inside = area & cv::Rect(0, 0, frame.cols, frame.rows);
  const int width = inside.width / reduction * reduction;
  const int height = inside.height / reduction * reduction;
  if (reduction <= 1 || width == 0 || height == 0) return {frame, {0, 0}, 1};
  FrameView view{cv::Mat(), inside.tl(), reduction};
  cv::resize(frame(cv::Rect(inside.x, inside.y, width, height)), view.image,
             cv::Size(width / reduction, height / reduction), 0, 0, cv::INTER_AREA);
  return view;
}

FrameView smoothed(const FrameView& view, const cv::Rect& area, const Eigen::Vector2d& size_px) {
  constexpr double kLeastSd = 0.4;  // [px] below it: no smoothing
  const cv::Rect part(static_cast<int>(std::floor(view.x_of(area.x))),
                      static_cast<int>(std::floor(view.y_of(area.y))),
                      area.width / view.reduction + 2, area.height / view.reduction + 2);
  const cv::Rect inside = part & cv::Rect(0, 0, view.image.cols, view.image.rows);
  if (inside.empty()) return view;
  FrameView smooth{view.image(inside), view.origin + view.reduction * inside.tl(), view.reduction};
  const double sd_x = size_px.x() / kPatchSide / view.reduction;
  const double sd_y = size_px.y() / kPatchSide / view.reduction;
  if (std::max(sd_x, sd_y) < kLeastSd) return smooth;
  cv::Mat image;
  cv::GaussianBlur(smooth.image, image, {0, 0}, std::max(0.2, sd_x), std::max(0.2, sd_y),
                   cv::BORDER_REPLICATE | cv::BORDER_ISOLATED);
  smooth.image = image;
  return smooth;
}

float bilinear(const cv::Mat& image, double x, double y) {
  const double inside_x = std::clamp(x, 0.0, image.cols - 1.0);
  const double inside_y = std::clamp(y, 0.0, image.rows - 1.0);
  const int column = static_cast<int>(inside_x);
  const int row = static_cast<int>(inside_y);
  const auto wx = static_cast<float>(inside_x - column);
  const auto wy = static_cast<float>(inside_y - row);
  const auto* upper = image.ptr<std::uint8_t>(row);
  const auto* lower = image.ptr<std::uint8_t>(std::min(row + 1, image.rows - 1));
  const int next = std::min(column + 1, image.cols - 1);
  const float top = static_cast<float>(upper[column]) +
                    wx * (static_cast<float>(upper[next]) - static_cast<float>(upper[column]));
  const float bottom = static_cast<float>(lower[column]) +
                       wx * (static_cast<float>(lower[next]) - static_cast<float>(lower[column]));
  return top + wy * (bottom - top);
}

Patch sample_patch(const FrameView& view, const Eigen::Vector2d& pixel,
                   const Eigen::Vector2d& size_px) {
  const double scale = 1.0 / view.reduction;
  const Axis x = make_axis(view.x_of(pixel.x()), size_px.x() * scale, view.image.cols);
  const Axis y = make_axis(view.y_of(pixel.y()), size_px.y() * scale, view.image.rows);
  Patch patch;
  float* out = patch.data();
  // In multiples of eight columns where possible: they are processed together.
  const int wanted = (x.high.back() - x.low.front()) / 8 * 8 + 8;
  const int left = std::max(0, std::min(x.low.front(), view.image.cols - wanted));
  const int span = std::min(wanted, view.image.cols - left);
  if (span > kMostSpan) {
    for (std::size_t j = 0; j < kPatchSide; ++j) {
      for (std::size_t i = 0; i < kPatchSide; ++i) *out++ = bilinear(view.image, x.at(i), y.at(j));
    }
    return patch;
  }
  std::array<float, kMostSpan + 1> line;
  for (std::size_t j = 0; j < kPatchSide; ++j) {
    between(view.image.ptr<std::uint8_t>(y.low[j]) + left,
            view.image.ptr<std::uint8_t>(y.high[j]) + left, y.weight[j], span, line.data());
    // The pixel after a row's end has weight zero.
    line[static_cast<std::size_t>(span)] = 0.0F;
    for (std::size_t i = 0; i < kPatchSide; i += 4) {
      cv::v_float32x4 near, next;
      cv::v_lut_deinterleave(line.data(), cv::v_load(&x.low[i]) - cv::v_setall_s32(left), near,
                             next);
      cv::v_store(out, near + cv::v_load(&x.weight[i]) * (next - near));
      out += 4;
    }
  }
  return patch;
}

MaskPatch sample_mask(const FrameView& mask, const Eigen::Vector2d& pixel,
                      const Eigen::Vector2d& size_px) {
  const double scale = 1.0 / mask.reduction;
  const auto columns = nearest_pixels(mask.x_of(pixel.x()), size_px.x() * scale);
  const auto rows = nearest_pixels(mask.y_of(pixel.y()), size_px.y() * scale);
  // They are ascending: those inside are contiguous.
  const auto first = std::lower_bound(columns.begin(), columns.end(), 0);
  const auto last = std::lower_bound(first, columns.end(), mask.image.cols);
  MaskPatch patch{};
  for (std::size_t j = 0; j < kPatchSide; ++j) {
    if (rows[j] < 0 || rows[j] >= mask.image.rows) continue;
    auto* out = &patch[j * kPatchSide];
    if (j > 0 && rows[j] == rows[j - 1]) {
      std::copy_n(out - kPatchSide, kPatchSide, out);
      continue;
    }
    const auto* line = mask.image.ptr<std::uint8_t>(rows[j]);
    out += first - columns.begin();
    for (auto column = first; column != last; ++column) *out++ = line[*column];
  }
  return patch;
}

float level_around(const FrameView& view, const Eigen::Vector2d& pixel,
                   const Eigen::Vector2d& size_px) {
  return median(surroundings(view, pixel, size_px));
}

Template make_template(const FrameView& view, const Eigen::Vector2d& pixel,
                       const Eigen::Vector2d& size_px) {
  constexpr float kLeastContrast = 8.0F;  // below it noise would dominate the comparison
  Template made;
  made.gray = sample_patch(view, pixel, size_px);
  std::vector<float> around = surroundings(view, pixel, size_px);
  const float level = median(around);
  for (float& value : around) value = std::abs(value - level);
  made.noise = std::max(0.5F, 1.4826F * median(around));
  std::array<float, kPatchArea> stands_out;
  std::transform(made.gray.begin(), made.gray.end(), stands_out.begin(),
                 [level](float value) { return std::abs(value - level); });
  const auto ninth = stands_out.begin() + kPatchArea * 9 / 10;
  std::nth_element(stands_out.begin(), ninth, stands_out.end());
  made.contrast = std::max(kLeastContrast, *ninth);
  constexpr double kLeastNoise = 0.6;  // [grey levels] of the quantisation alone
  constexpr double kMostNoise = 5.0;   // above it: texture everywhere
  constexpr double kCertain = 4.5;  // standard deviations that none of 576 pixels reaches by chance
  const double pixel_sd = std::clamp(pixel_noise(view.image), kLeastNoise, kMostNoise);
  made.empty = static_cast<double>(structure_of(made.gray)) < kCertain * pixel_sd;
  return made;
}

}  // namespace ols::tracker
