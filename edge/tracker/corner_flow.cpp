#include "edge/tracker/corner_flow.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <opencv2/core/hal/intrin.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>

namespace ols::tracker {
namespace {

using Four = cv::v_float32x4;
constexpr int kSide = 12;  // of the window; the corner is at its pixel (6, 6)
constexpr int kMiddle = kSide / 2;
constexpr int kFramed = kSide + 4;  // with the margin of the derivatives, a multiple of four
constexpr int kMostSteps = 15;
constexpr float kEnough = 0.03F;  // [px] a step below it ends the iteration

template <int side>
using Square = std::array<float, static_cast<std::size_t>(side* side)>;

// Not v_load_expand_q(): it may read beyond the memory.
Four four_pixels(const std::uint8_t* at) {
  std::int32_t packed = 0;
  std::memcpy(&packed, at, sizeof packed);
  const cv::v_uint8x16 bytes = cv::v_reinterpret_as_u8(cv::v_setall_s32(packed));
  const cv::v_uint32x4 wide = cv::v_expand_low(cv::v_expand_low(bytes));
  return cv::v_cvt_f32(cv::v_reinterpret_as_s32(wide));
}

// A square of the image at sub-pixel positions, its first sample at `corner`; empty: beyond even
// the image's margin.
template <int side>
bool sample(const cv::Mat& image, const cv::Point2f& corner, Square<side>& out) {
  constexpr int kMargin = ImagePyramid::kMargin;
  const cv::Point2f first = corner + cv::Point2f(kMargin, kMargin);
  const bool inside = first.x >= 0.0F && first.y >= 0.0F &&
                      first.x < static_cast<float>(image.cols + 2 * kMargin - side) &&
                      first.y < static_cast<float>(image.rows + 2 * kMargin - side);
  if (!inside) return false;
  const int left = static_cast<int>(first.x) - kMargin;
  const int top = static_cast<int>(first.y) - kMargin;
  const Four across = cv::v_setall_f32(corner.x - static_cast<float>(left));
  const Four down = cv::v_setall_f32(corner.y - static_cast<float>(top));
  const auto stride = static_cast<std::ptrdiff_t>(image.step);
  const auto* first_line = image.data + top * stride + left;
  std::array<Four, side / 4> above;
  for (int row = 0; row <= side; ++row) {
    const auto* line = first_line + row * stride;
    for (int i = 0; i < side; i += 4) {
      const Four near = four_pixels(line + i);
      const Four here = near + across * (four_pixels(line + i + 1) - near);
      Four& before = above[static_cast<std::size_t>(i / 4)];
      if (row > 0) cv::v_store(&out[(row - 1) * side + i], before + down * (here - before));
      before = here;
    }
  }
  return true;
}

// The window around a corner and its derivatives.
struct Window {
  Square<kSide> gray, along_x, along_y;
  float xx, xy, yy;  // sums of the derivatives' products
};

std::optional<Window> window_around(const cv::Mat& image, const cv::Point2f& corner) {
  Square<kFramed> framed;
  const cv::Point2f first = corner - cv::Point2f(kMiddle + 1, kMiddle + 1);
  if (!sample<kFramed>(image, first, framed)) return std::nullopt;
  Window window;
  const Four half = cv::v_setall_f32(0.5F);
  Four xx = cv::v_setzero_f32(), xy = xx, yy = xx;
  for (int row = 0; row < kSide; ++row) {
    for (int i = 0; i < kSide; i += 4) {
      const float* at = &framed[(row + 1) * kFramed + i + 1];
      const Four x = half * (cv::v_load(at + 1) - cv::v_load(at - 1));
      const Four y = half * (cv::v_load(at + kFramed) - cv::v_load(at - kFramed));
      cv::v_store(&window.gray[row * kSide + i], cv::v_load(at));
      cv::v_store(&window.along_x[row * kSide + i], x);
      cv::v_store(&window.along_y[row * kSide + i], y);
      xx += x * x;
      xy += x * y;
      yy += y * y;
    }
  }
  window.xx = cv::v_reduce_sum(xx);
  window.xy = cv::v_reduce_sum(xy);
  window.yy = cv::v_reduce_sum(yy);
  return window;
}

// The step that aligns the window with the image at `now`.
cv::Point2f step(const Window& window, const Square<kSide>& now) {
  Four x = cv::v_setzero_f32(), y = x;
  for (int i = 0; i < kSide * kSide; i += 4) {
    const Four off = cv::v_load(&window.gray[i]) - cv::v_load(&now[i]);
    x += off * cv::v_load(&window.along_x[i]);
    y += off * cv::v_load(&window.along_y[i]);
  }
  const float bx = cv::v_reduce_sum(x), by = cv::v_reduce_sum(y);
  const float determinant = window.xx * window.yy - window.xy * window.xy;
  return {(window.yy * bx - window.xy * by) / determinant,
          (window.xx * by - window.xy * bx) / determinant};
}

double correlation(const Square<kSide>& one, const Square<kSide>& other) {
  Four p = cv::v_setzero_f32(), q = p, pp = p, qq = p, pq = p;
  const Four level = cv::v_setall_f32(one[kMiddle * kSide + kMiddle]);  // for precision
  for (int i = 0; i < kSide * kSide; i += 4) {
    const Four u = cv::v_load(&one[i]) - level;
    const Four v = cv::v_load(&other[i]) - level;
    p += u;
    q += v;
    pp += u * u;
    qq += v * v;
    pq += u * v;
  }
  constexpr float n = kSide * kSide;
  const float a = cv::v_reduce_sum(p), b = cv::v_reduce_sum(q);
  const float spread = (cv::v_reduce_sum(pp) - a * a / n) * (cv::v_reduce_sum(qq) - b * b / n);
  const float product = cv::v_reduce_sum(pq) - a * b / n;
  return spread > 0.0F ? static_cast<double>(product / std::sqrt(spread)) : 0.0;
}

bool within(const cv::Mat& image, const cv::Point2f& at) {
  return cv::Rect2f(0.0F, 0.0F, static_cast<float>(image.cols), static_cast<float>(image.rows))
      .contains(at);
}

}  // namespace

void ImagePyramid::build(const cv::Mat& image) {
  cv::Size size = image.size();
  for (std::size_t i = 0; i < kLevels; ++i) {
    framed_[i].create(size.height + 2 * kMargin, size.width + 2 * kMargin, CV_8UC1);
    levels_[i] = framed_[i](cv::Rect({kMargin, kMargin}, size));
    if (i > 0) cv::pyrDown(levels_[i - 1], levels_[i], size);
    cv::copyMakeBorder(i > 0 ? levels_[i] : image, framed_[i], kMargin, kMargin, kMargin, kMargin,
                       cv::BORDER_REPLICATE | cv::BORDER_ISOLATED);
    size = {(size.width + 1) / 2, (size.height + 1) / 2};
  }
}

FollowedCorner follow_corner(const ImagePyramid& previous, const ImagePyramid& current,
                             const cv::Point2f& corner, const cv::Point2f& guess) {
  constexpr float kLeastDeterminant = 1e-3F;  // of a surface without texture
  FollowedCorner followed{guess};
  const cv::Point2f to_first(kMiddle, kMiddle);
  for (int level = ImagePyramid::kLevels - 1; level >= 0; --level) {
    const float scale = 1.0F / static_cast<float>(1 << level);
    const auto window = window_around(previous.level(level), scale * corner);
    if (!window || window->xx * window->yy - window->xy * window->xy < kLeastDeterminant) continue;
    cv::Point2f at = scale * followed.at;
    Square<kSide> now;
    bool inside = sample<kSide>(current.level(level), at - to_first, now);
    for (int i = 0; inside && i < kMostSteps; ++i) {
      const cv::Point2f moved = step(*window, now);
      at += moved;
      inside = sample<kSide>(current.level(level), at - to_first, now);
      if (moved.dot(moved) < kEnough * kEnough) break;
    }
    if (inside) followed.at = at / scale;
    if (level == 0 && inside && within(current.level(0), at))
      followed.correlation = correlation(window->gray, now);
  }
  return followed;
}

}  // namespace ols::tracker
