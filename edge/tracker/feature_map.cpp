#include "edge/tracker/feature_map.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "edge/tracker/patch.h"

namespace ols::tracker {
namespace {

constexpr auto kSide = static_cast<std::size_t>(kMapSide);
constexpr int kCell = kCellSide;
constexpr std::size_t kUnsigned = 6, kSigned = 2 * kUnsigned;
constexpr std::size_t kEnergy = kSigned + kUnsigned, kLevel = kEnergy + 1, kRed = kEnergy + 2,
                      kYellow = kEnergy + 3;
static_assert(kYellow + 1 == kChannels);

// The window, resampled to `cell` pixels a cell, with a border of one pixel.
cv::Mat resample(const cv::Mat& image, const FeatureWindow& window, int cell) {
  const int across = kMapSide * cell + 2;
  const double scale = window.cell_px / cell;  // image pixels a resampled pixel
  const int reduction = std::max(1, static_cast<int>(scale));
  const double side = scale * across + 2.0 * reduction;
  const FrameView view =
      make_view(image, enclosing(box_of(window.pixel, Eigen::Vector2d::Constant(side))), reduction);
  const double step = scale / view.reduction;
  const double first = -0.5 * (across - 1) * step;
  const cv::Matx23d to_view(step, 0.0, view.x_of(window.pixel.x()) + first, 0.0, step,
                            view.y_of(window.pixel.y()) + first);
  cv::Mat sampled;
  cv::warpAffine(view.image, sampled, to_view, {across, across},
                 cv::INTER_LINEAR | cv::WARP_INVERSE_MAP, cv::BORDER_REPLICATE);
  return sampled;
}

// Converts no more of the picture than the window.
cv::Mat resample_colours(const ColourPicture& picture, const FeatureWindow& window) {
  const double side = (kMapSide + 2) * window.cell_px + 4.0;
  const ColourPicture::Part part =
      picture.part(enclosing(box_of(window.pixel, Eigen::Vector2d::Constant(side))));
  FeatureWindow within = window;
  within.pixel -= Eigen::Vector2d(part.origin.x, part.origin.y);
  return resample(part.bgr, within, kColourSide);
}

// The means of the cells of a resampled window.
cv::Mat cell_means(const cv::Mat& sampled) {
  cv::Mat means;
  cv::resize(sampled(cv::Rect(1, 1, sampled.cols - 2, sampled.rows - 2)), means,
             {kMapSide, kMapSide}, 0, 0, cv::INTER_AREA);
  return means;
}

// Length and direction of a gradient with components -kLimit..kLimit.
class Gradients {
 public:
  static constexpr int kLimit = 64;  // a quarter of the difference of two grey levels
  struct Polar {
    float length = 0.0F;  // [grey levels]
    std::size_t bin = 0;
  };

  Gradients() {
    for (int y = -kLimit; y <= kLimit; ++y) {
      for (int x = -kLimit; x <= kLimit; ++x) {
        const double turn = std::atan2(y, x) / (2.0 * std::numbers::pi) + 1.0;
        table_[index(x, y)] = {static_cast<float>(4.0 * std::hypot(x, y)),
                               static_cast<std::size_t>(turn * kSigned + 0.5) % kSigned};
      }
    }
  }
  const Polar& operator()(int x, int y) const { return table_[index(x, y)]; }

 private:
  static constexpr int kWidth = 2 * kLimit + 1;
  static std::size_t index(int x, int y) {
    return static_cast<std::size_t>((y + kLimit) * kWidth + x + kLimit);
  }
  std::array<Polar, kWidth * kWidth> table_;
};

using Histogram = std::array<float, kSigned>;
constexpr float kMost = 0.4F;  // of a normalised histogram's bin

// Of side x side cells with a border of one. Each pixel's gradient is shared by the four cells
// around it.
std::vector<Histogram> histograms(const cv::Mat& sampled, int side) {
  static const Gradients gradients;
  const auto bordered = static_cast<std::size_t>(side + 2);
  std::vector<Histogram> cells(bordered * bordered, Histogram{});
  for (int y = 0; y < side * kCell; ++y) {
    const auto* above = sampled.ptr<std::uint8_t>(y) + 1;
    const auto* here = sampled.ptr<std::uint8_t>(y + 1) + 1;
    const auto* below = sampled.ptr<std::uint8_t>(y + 2) + 1;
    const int down = y + kCell / 2;
    const float wy = (static_cast<float>(down % kCell) + 0.5F) / kCell;
    Histogram* upper = &cells[static_cast<std::size_t>(down / kCell) * bordered];
    Histogram* lower = upper + bordered;
    for (int x = 0; x < side * kCell; ++x) {
      const auto [length, bin] =
          gradients((here[x + 1] - here[x - 1]) / 4, (below[x] - above[x]) / 4);
      const int right = x + kCell / 2;
      const int column = right / kCell;
      const float wx = (static_cast<float>(right % kCell) + 0.5F) / kCell;
      const float low = length * wy, high = length - low;
      upper[column][bin] += high * (1.0F - wx);
      upper[column + 1][bin] += high * wx;
      lower[column][bin] += low * (1.0F - wx);
      lower[column + 1][bin] += low * wx;
    }
  }
  return cells;
}

std::vector<float> energies(const std::vector<Histogram>& cells) {
  std::vector<float> made(cells.size());
  for (std::size_t i = 0; i < cells.size(); ++i) {
    for (std::size_t b = 0; b < kUnsigned; ++b) {
      const float both = cells[i][b] + cells[i][b + kUnsigned];
      made[i] += both * both;
    }
  }
  return made;
}

// What a cell's histogram is divided by: the gradients of the three by three cells around it.
float normaliser(const std::vector<float>& energy, std::size_t at, std::size_t bordered) {
  constexpr float kNoise = 16.0F;  // [grey levels] of a cell's gradients: not amplified
  float around = 0.0F;
  for (const std::size_t line : {at - bordered, at, at + bordered}) {
    around += energy[line - 1] + energy[line] + energy[line + 1];
  }
  return 1.0F / std::sqrt(around / 4.0F + kNoise * kNoise);
}

void add_gradients(const cv::Mat& sampled, FeatureMap& features) {
  constexpr float kMostEnergy = 2.0F;
  constexpr std::size_t kBordered = kSide + 2;
  const std::vector<Histogram> cells = histograms(sampled, kMapSide);
  const std::vector<float> energy = energies(cells);
  Map scale;
  for (std::size_t i = 0; i < kMapArea; ++i) {
    scale[i] = normaliser(energy, (i / kSide + 1) * kBordered + i % kSide + 1, kBordered);
  }
  Map all{};
  for (std::size_t b = 0; b < kUnsigned; ++b) {
    for (std::size_t i = 0; i < kMapArea; ++i) {
      const Histogram& cell = cells[(i / kSide + 1) * kBordered + i % kSide + 1];
      const float one = scale[i] * cell[b], other = scale[i] * cell[b + kUnsigned];
      features[b][i] = std::min(kMost, one);
      features[b + kUnsigned][i] = std::min(kMost, other);
      features[b + kSigned][i] = std::min(kMost, one + other);
      all[i] += one + other;
    }
  }
  for (std::size_t i = 0; i < kMapArea; ++i)
    features[kEnergy][i] = 0.25F * std::min(kMostEnergy, all[i]);
}

// Relative to the window's mean, `deviation` across the window unless there is hardly any.
void standardise(Map& map, float deviation) {
  constexpr float kLeast = 4.0F;  // [grey levels]
  float sum = 0.0F, squares = 0.0F;
  for (const float value : map) {
    sum += value;
    squares += value * value;
  }
  const float mean = sum / kMapArea;
  const float now = std::sqrt(std::max(0.0F, squares / kMapArea - mean * mean));
  const float gain = deviation / std::max(kLeast, now);
  for (float& value : map) value = (value - mean) * gain;
}

void add_levels(const cv::Mat& means, Map& levels) {
  for (std::size_t i = 0; i < kMapArea; ++i) levels[i] = means.data[i];
  standardise(levels, 0.25F);
}

// A colour tells one walker from the next better than a grey level.
void add_colours(const cv::Mat& means, Map& red, Map& yellow) {
  for (std::size_t i = 0; i < kMapArea; ++i) {
    const std::uint8_t* bgr = means.data + 3 * i;
    const auto b = static_cast<float>(bgr[0]), g = static_cast<float>(bgr[1]),
               r = static_cast<float>(bgr[2]);
    red[i] = r - g;
    yellow[i] = 0.5F * (r + g) - b;
  }
  standardise(red, 0.5F);
  standardise(yellow, 0.5F);
}

// Squared sine: the transform takes the window's edges for neighbours.
void taper(FeatureMap& features) {
  static const auto weights = [] {
    Map made;
    const auto sine = [](std::size_t i) {
      return std::sin(std::numbers::pi * (static_cast<double>(i) + 0.5) / kMapSide);
    };
    for (std::size_t i = 0; i < made.size(); ++i) {
      made[i] = static_cast<float>(std::pow(sine(i / kSide) * sine(i % kSide), 2));
    }
    return made;
  }();
  for (Map& map : features) {
    for (std::size_t i = 0; i < map.size(); ++i) map[i] *= weights[i];
  }
}

}  // namespace

void add_shape(const cv::Mat& sampled, int side, float* features) {
  const std::vector<Histogram> cells = histograms(sampled, side);
  const std::vector<float> energy = energies(cells);
  const auto across = static_cast<std::size_t>(side), bordered = across + 2;
  for (std::size_t i = 0; i < across * across; ++i) {
    const std::size_t at = (i / across + 1) * bordered + i % across + 1;
    const float scale = normaliser(energy, at, bordered);
    for (std::size_t b = 0; b < kUnsigned; ++b) {
      *features++ = std::min(kMost, scale * (cells[at][b] + cells[at][b + kUnsigned]));
    }
  }
}

WindowView view_window(const TrackerInput& frame, const FeatureWindow& window) {
  WindowView view{window, resample(frame.gray, window, kCell), {}};
  if (!frame.colour.empty()) view.bgr = resample_colours(frame.colour, window);
  return view;
}

FeatureMap extract_features(const WindowView& view) {
  FeatureMap features{};
  add_gradients(view.gray, features);
  add_levels(cell_means(view.gray), features[kLevel]);
  if (!view.bgr.empty()) add_colours(cell_means(view.bgr), features[kRed], features[kYellow]);
  taper(features);
  return features;
}

}  // namespace ols::tracker
