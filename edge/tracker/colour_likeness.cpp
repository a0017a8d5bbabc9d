#include "edge/tracker/colour_likeness.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace ols::tracker {
namespace {

constexpr std::size_t kLevels = 16;  // of each colour; of a share of the brightness: the square
constexpr std::size_t kBins = kLevels * kLevels * kLevels;
constexpr int kAcross = kMapSide * kColourSide;  // [px] of the window

const std::uint8_t* line_of(const WindowView& view, int y) {
  return view.bgr.ptr<std::uint8_t>(y + 1) + 3;  // without the border
}

// The bin of each pixel of a window.
class Binned {
 public:
  Binned(Palette palette, const WindowView& view) : bins_(kAcross * kAcross) {
    for (int y = 0; y < kAcross; ++y) {
      const std::uint8_t* bgr = line_of(view, y);
      for (int x = 0; x < kAcross; ++x, bgr += 3)
        bins_[index(x, y)] = palette == Palette::kHue ? hue_of(bgr) : colour_of(bgr);
    }
  }
  std::size_t at(int x, int y) const { return bins_[index(x, y)]; }

 private:
  static std::size_t index(int x, int y) { return static_cast<std::size_t>(y * kAcross + x); }
  static std::size_t colour_of(const std::uint8_t* bgr) {
    const auto level = [](std::uint8_t colour) { return colour * kLevels / 256; };
    return (level(bgr[0]) * kLevels + level(bgr[1])) * kLevels + level(bgr[2]);
  }
  static std::size_t hue_of(const std::uint8_t* bgr) {
    constexpr float kLeast = 0.1F, kMost = 0.6F;  // of the brightness: few colours are purer
    constexpr auto kSteps = static_cast<float>(2 * kLevels);
    const float sum = 1.0F + static_cast<float>(bgr[0] + bgr[1] + bgr[2]);
    const auto step = [sum](std::uint8_t colour) {
      const float share = (static_cast<float>(colour) / sum - kLeast) / (kMost - kLeast);
      return static_cast<std::size_t>(std::clamp(kSteps * share, 0.0F, kSteps - 1.0F));
    };
    return step(bgr[0]) * 2 * kLevels + step(bgr[2]);
  }

  std::vector<std::size_t> bins_;
};

// Half of the box [px of the window].
Eigen::Vector2d half_box(const WindowView& view, const Eigen::Vector2d& size_px) {
  return 0.5 * kColourSide * size_px / view.window.cell_px;
}

// Sums over the rectangles between the origin and each corner of a pixel.
class Sums {
 public:
  template <typename Value>
  explicit Sums(Value value) {
    for (int y = 0; y < kAcross; ++y) {
      float along = 0.0F;
      for (int x = 0; x < kAcross; ++x) {
        along += value(x, y);
        sums_[index(x + 1, y + 1)] = sums_[index(x + 1, y)] + along;
      }
    }
  }
  // The mean of the pixels within `half_x`, `half_y` of a corner; outside the window they are 0.
  float mean(int x, int y, int half_x, int half_y) const {
    const int left = std::max(0, x - half_x), right = std::min(kAcross, x + half_x);
    const int top = std::max(0, y - half_y), bottom = std::min(kAcross, y + half_y);
    const float sum = sums_[index(right, bottom)] - sums_[index(left, bottom)] -
                      sums_[index(right, top)] + sums_[index(left, top)];
    return sum / static_cast<float>(4 * half_x * half_y);
  }

 private:
  static std::size_t index(int x, int y) { return static_cast<std::size_t>(y * (kAcross + 1) + x); }

  std::array<float, (kAcross + 1) * (kAcross + 1)> sums_{};
};

}  // namespace

ColourLikeness::ColourLikeness(Palette palette, const WindowView& view,
                               const Eigen::Vector2d& size_px)
    : palette_(palette) {
  if (view.bgr.empty()) return;
  target_.resize(kBins);
  around_.resize(kBins);
  probability_.resize(kBins);
  learn_histograms(view, size_px, 1.0);
  const Response there{view.window, mean_probability(view, size_px)};
  learn_level(there.contrast(view.window.pixel), 1.0);
}

Response ColourLikeness::respond(const WindowView& view, const Eigen::Vector2d& size_px) const {
  constexpr float kMost = 1.5F;  // something in purer colours than the target is not more likely
  Response response{view.window, {}};
  if (view.bgr.empty() || above_ <= 0.0) return response;
  response.values = mean_probability(view, size_px);
  const auto level = static_cast<float>(level_), scale = static_cast<float>(1.0 / above_);
  for (float& value : response.values) value = std::min(kMost, (value - level) * scale);
  return response;
}

void ColourLikeness::learn(const WindowView& view, const Eigen::Vector2d& size_px, double share) {
  if (view.bgr.empty() || probability_.empty()) return;
  const Response there{view.window, mean_probability(view, size_px)};
  learn_level(there.contrast(view.window.pixel), share);
  learn_histograms(view, size_px, share);
}

// Of two normal distributions whose means are two standard deviations apart, it is one half.
double ColourLikeness::separability() const {
  if (above_ <= 0.0) return 0.0;
  return above_ * above_ / (above_ * above_ + 4.0 * variance_);
}

Map ColourLikeness::mean_probability(const WindowView& view, const Eigen::Vector2d& size_px) const {
  const Binned binned(palette_, view);
  const Sums sums([&](int x, int y) { return probability_[binned.at(x, y)]; });
  const Eigen::Vector2d half = half_box(view, size_px);
  const int half_x = std::clamp(static_cast<int>(std::lround(half.x())), 1, kAcross / 4);
  const int half_y = std::clamp(static_cast<int>(std::lround(half.y())), 1, kAcross / 4);
  Map made;
  for (int i = 0; i < kMapArea; ++i) {
    made[static_cast<std::size_t>(i)] =
        sums.mean(i % kMapSide * kColourSide, i / kMapSide * kColourSide, half_x, half_y);
  }
  return made;
}

// The box without its rim, which often shows background, against a ring around it.
void ColourLikeness::learn_histograms(const WindowView& view, const Eigen::Vector2d& size_px,
                                      double share) {
  constexpr double kInside = 0.8, kOutside = 1.1, kFar = 2.5;  // of the box
  // Of a bin's share: less is too rare to tell anything, and counts as the surroundings'.
  constexpr float kRare = 2e-3F;
  std::vector<float> inside(kBins), outside(kBins);
  float in = 0.0F, out = 0.0F;
  const Binned binned(palette_, view);
  const Eigen::Vector2d half = half_box(view, size_px);
  for (int y = 0; y < kAcross; ++y) {
    const double down = std::abs(y + 0.5 - 0.5 * kAcross) / half.y();
    for (int x = 0; x < kAcross; ++x) {
      const double far = std::max(down, std::abs(x + 0.5 - 0.5 * kAcross) / half.x());
      if (far <= kInside) {
        ++inside[binned.at(x, y)], ++in;
      } else if (far > kOutside && far < kFar) {
        ++outside[binned.at(x, y)], ++out;
      }
    }
  }
  if (in == 0.0F || out == 0.0F) return;
  const auto part = static_cast<float>(share);
  for (std::size_t i = 0; i < kBins; ++i) {
    target_[i] += part * (inside[i] / in - target_[i]);
    around_[i] += part * (outside[i] / out - around_[i]);
    probability_[i] = target_[i] / (target_[i] + around_[i] + kRare);
  }
}

void ColourLikeness::learn_level(const Response::Contrast& seen, double share) {
  level_ += share * (seen.mean - level_);
  variance_ += share * (seen.sd * seen.sd - variance_);
  above_ += share * (seen.above() - above_);
}

}  // namespace ols::tracker
