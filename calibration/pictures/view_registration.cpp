#include "calibration/pictures/view_registration.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <vector>

#include "calibration/pictures/gradients.h"
#include "geometry/median.h"

namespace ols::calibration {
namespace {

using Refusal = ViewRegistration::Refusal;
using Eigen::Vector2d;

constexpr double kSmoothing_px = 1.5;
constexpr int kReach_px = 2;  // of a tile, once the whole is aligned
constexpr int kSide = 2 * kReach_px + 1;

// Orientations as complex numbers of a size below one (two channels).
cv::Mat orientations(const cv::Mat& gray) {
  const Gradients g = gradients_of(gray, kSmoothing_px);
  constexpr double kAbove = 3.0;
  const auto floor2 = static_cast<float>(std::pow(kAbove * g.sd, 2));
  cv::Mat result(gray.size(), CV_32FC2);
  for (int y = 0; y < gray.rows; ++y) {
    const float *gx = g.x.ptr<float>(y), *gy = g.y.ptr<float>(y);
    auto* out = result.ptr<cv::Vec2f>(y);
    for (int x = 0; x < gray.cols; ++x) {
      const float xx = gx[x] * gx[x], yy = gy[x] * gy[x], scale = 1.0F / (xx + yy + floor2);
      out[x] = {(xx - yy) * scale, 2.0F * gx[x] * gy[x] * scale};
    }
  }
  return result;
}

// A tile's side: some eighty of them, large enough to hold edges.
int tile_side(const cv::Size& size) {
  return std::clamp(std::min(size.width, size.height) / 8, 24, 96);
}

cv::Mat windowed(const cv::Mat& field) {
  cv::Mat window, both, level = field - cv::mean(field);
  cv::createHanningWindow(window, field.size(), CV_32F);
  cv::merge(std::vector<cv::Mat>{window, window}, both);
  return level.mul(both);
}

// Phases alone: with their sizes, a texture of even waves would have a peak at each wave.
void whiten(cv::Mat& spectrum) {
  for (int y = 0; y < spectrum.rows; ++y) {
    auto* row = spectrum.ptr<cv::Vec2f>(y);
    for (int x = 0; x < spectrum.cols; ++x) {
      const float size = std::hypot(row[x][0], row[x][1]);
      if (size > 0.0F) row[x] /= size;
    }
  }
}

// The shift of the whole, to about a pixel.
Vector2d whole_shift(const cv::Mat& reference, const cv::Mat& view) {
  cv::Mat a, b, product, surface;
  cv::dft(windowed(reference), a, cv::DFT_COMPLEX_OUTPUT);
  cv::dft(windowed(view), b, cv::DFT_COMPLEX_OUTPUT);
  cv::mulSpectrums(b, a, product, 0, true);
  whiten(product);
  cv::dft(product, surface, cv::DFT_INVERSE | cv::DFT_SCALE | cv::DFT_COMPLEX_OUTPUT);
  cv::Mat real;
  cv::extractChannel(surface, real, 0);
  cv::Point peak;
  cv::minMaxLoc(real, nullptr, nullptr, nullptr, &peak);
  if (peak.x > real.cols / 2) peak.x -= real.cols;
  if (peak.y > real.rows / 2) peak.y -= real.rows;
  return {peak.x, peak.y};
}

cv::Mat moved_back(const cv::Mat& view, const Vector2d& shift) {
  const cv::Mat to = (cv::Mat_<double>(2, 3) << 1, 0, shift.x(), 0, 1, shift.y());
  cv::Mat result;
  cv::warpAffine(view, result, to, view.size(), cv::INTER_CUBIC | cv::WARP_INVERSE_MAP,
                 cv::BORDER_REPLICATE);
  return result;
}

// Correlation of each tile for each small shift: kSide * kSide pictures of one value a tile.
std::vector<cv::Mat> tile_scores(const cv::Mat& reference, const cv::Mat& view) {
  const int side = tile_side(reference.size());
  const cv::Size tiles((reference.cols - 2 * kReach_px) / side,
                       (reference.rows - 2 * kReach_px) / side);
  const cv::Rect inner((reference.cols - tiles.width * side) / 2,
                       (reference.rows - tiles.height * side) / 2, tiles.width * side,
                       tiles.height * side);
  std::vector<cv::Mat> scores;
  for (int dy = -kReach_px; dy <= kReach_px; ++dy) {
    for (int dx = -kReach_px; dx <= kReach_px; ++dx) {
      const cv::Mat product = reference(inner).mul(view(inner + cv::Point(dx, dy)));
      cv::Mat sums, sum;
      cv::resize(product, sums, tiles, 0, 0, cv::INTER_AREA);
      cv::transform(sums, sum, cv::Matx12f(1.0F, 1.0F));
      scores.push_back(sum);
    }
  }
  return scores;
}

// The vertex of a parabola through three values at -1, 0, 1.
double vertex(double before, double at, double after) {
  const double bend = before - 2.0 * at + after;
  return bend < 0.0 ? 0.5 * (before - after) / bend : 0.0;
}

// Where a tile's score is greatest; nothing at the border of the search, or where nothing of the
// reference is in the view: a dark one scores zero everywhere, and so best where it is.
std::optional<Vector2d> tile_shift(const std::vector<cv::Mat>& scores, int row, int column) {
  const auto at = [&](int dx, int dy) {
    return scores[static_cast<std::size_t>((dy + kReach_px) * kSide + dx + kReach_px)].at<float>(
        row, column);
  };
  int x = 0, y = 0;
  for (int dy = -kReach_px; dy <= kReach_px; ++dy) {
    for (int dx = -kReach_px; dx <= kReach_px; ++dx) {
      if (at(dx, dy) > at(x, y)) x = dx, y = dy;
    }
  }
  if (std::max(std::abs(x), std::abs(y)) == kReach_px || at(x, y) <= 0.0F) return std::nullopt;
  return Vector2d(x + vertex(at(x - 1, y), at(x, y), at(x + 1, y)),
                  y + vertex(at(x, y - 1), at(x, y), at(x, y + 1)));
}

struct Tiles {
  int with_structure = 0;
  std::vector<Vector2d> shifts;  // of those that have an inner maximum
};

Tiles look_at_tiles(const cv::Mat& reference, const cv::Mat& view) {
  constexpr double kLeastEnergy = 0.08;  // noise alone has 0.04, strong edges 1
  const std::vector<cv::Mat> scores = tile_scores(reference, view);
  const std::vector<cv::Mat> energy = tile_scores(reference, reference);
  const auto middle = static_cast<std::size_t>(kReach_px * kSide + kReach_px);
  Tiles tiles;
  for (int row = 0; row < scores.front().rows; ++row) {
    for (int column = 0; column < scores.front().cols; ++column) {
      if (energy[middle].at<float>(row, column) < kLeastEnergy) continue;
      ++tiles.with_structure;
      if (const auto shift = tile_shift(scores, row, column)) tiles.shifts.push_back(*shift);
    }
  }
  return tiles;
}

// Mean and scatter of those near the median.
void combine(const Tiles& tiles, const Vector2d& before, ViewRegistration& result) {
  // Tiles of another view fall anywhere in the reach: within this of one place by chance 5 %.
  constexpr double kNear_px = 0.5, kLeastAgreeing = 0.3;
  constexpr std::size_t kLeastTiles = 6;
  const Vector2d centre = median(tiles.shifts);
  std::vector<double> misses;
  for (const Vector2d& one : tiles.shifts) misses.push_back((one - centre).cwiseAbs().maxCoeff());
  const double wide_px = std::clamp(3.0 * 1.4826 * median(misses), 0.05, kNear_px);
  Vector2d sum = Vector2d::Zero(), squares = Vector2d::Zero();
  double n = 0.0;
  for (std::size_t i = 0; i < misses.size(); ++i) {
    if (misses[i] > wide_px) continue;
    const Vector2d from_centre = tiles.shifts[i] - centre;
    sum += from_centre;
    squares += from_centre.cwiseAbs2();
    n += 1.0;
  }
  result.agreeing = n / tiles.with_structure;
  result.shift_px = before + centre + sum / n;
  const double variance = (squares - sum.cwiseAbs2() / n).maxCoeff() / std::max(1.0, n - 1.0);
  // What another light does, neighbouring tiles share.
  constexpr double kTilesAlike = 4.0;
  result.sd_px = std::sqrt(kTilesAlike * variance / n);
  if (n < kLeastTiles || result.agreeing < kLeastAgreeing) result.refusal = Refusal::kNoAgreement;
}

}  // namespace

const char* to_string(Refusal refusal) {
  switch (refusal) {
    case Refusal::kNone:
      return "none";
    case Refusal::kSize:
      return "the pictures are not of one size, or too small";
    case Refusal::kNoStructure:
      return "too little structure: sky, fog or darkness";
    case Refusal::kNoAgreement:
      return "the parts of the view do not agree: another view, or too much has moved";
  }
  return "";
}

ViewRegistration register_view(const cv::Mat& reference, const cv::Mat& view) {
  constexpr int kLeast_px = 160, kLeastTiles = 6, kRounds = 3;
  ViewRegistration result;
  if (reference.size() != view.size() || std::min(view.rows, view.cols) < kLeast_px) {
    result.refusal = Refusal::kSize;
    return result;
  }
  const cv::Mat was = orientations(reference);
  Vector2d shift = whole_shift(was, orientations(view));
  for (int round = 0; round < kRounds; ++round) {
    const Tiles tiles = look_at_tiles(was, orientations(moved_back(view, shift)));
    result.tiles = tiles.with_structure;
    if (tiles.with_structure < kLeastTiles) {
      result.refusal = Refusal::kNoStructure;
      return result;
    }
    if (static_cast<int>(tiles.shifts.size()) < kLeastTiles) {
      result.refusal = Refusal::kNoAgreement;
      return result;
    }
    result.refusal = Refusal::kNone;
    combine(tiles, shift, result);
    if (result.refusal != Refusal::kNone) return result;
    shift = result.shift_px;
  }
  return result;
}

}  // namespace ols::calibration
