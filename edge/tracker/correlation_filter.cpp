#include "edge/tracker/correlation_filter.h"

#include <algorithm>
#include <cmath>

namespace ols::tracker {
namespace {

constexpr auto kSide = static_cast<std::size_t>(kMapSide);
constexpr int kMiddle = kMapSide / 2;
constexpr double kBoxCells = kMapSide / 4.0;  // along the geometric mean of the box's sides
constexpr double kPeakSd = kBoxCells / 16.0;  // [cells] of the wanted response
constexpr double kInertia = 15.0;             // of the filter, against the newest frame

Spectra spectra_of(const WindowView& view) {
  const FeatureMap features = extract_features(view);
  Spectra spectra;
  for (std::size_t c = 0; c < features.size(); c += 2) {
    transform(features[c], features[c + 1], spectra[c], spectra[c + 1]);
  }
  return spectra;
}

// Share of a cell within `half` cells of the box's centre.
double covered(double from_centre, double half) {
  return std::clamp(half + 0.5 - std::abs(from_centre), 0.0, 1.0);
}

// Where the parabola through three values has its maximum, from the middle one.
double vertex(float low, float middle, float high) {
  const double bend =
      static_cast<double>(low) - 2.0 * static_cast<double>(middle) + static_cast<double>(high);
  return bend < 0.0 ? std::clamp(0.5 * static_cast<double>(low - high) / bend, -0.5, 0.5) : 0.0;
}

// Zero outside the support.
void restrict_to(const Map& support, Spectra& spectra) {
  for (std::size_t c = 0; c < spectra.size(); c += 2) {
    Map a, b;
    transform_back(spectra[c], spectra[c + 1], a, b);
    for (std::size_t i = 0; i < a.size(); ++i) {
      a[i] *= support[i];
      b[i] *= support[i];
    }
    transform(a, b, spectra[c], spectra[c + 1]);
  }
}

}  // namespace

FeatureWindow window_around(const Eigen::Vector2d& pixel, const Eigen::Vector2d& size_px) {
  return {pixel, std::sqrt(size_px.prod()) / kBoxCells};
}

double Response::at(const Eigen::Vector2d& pixel) const {
  const Eigen::Vector2d cell =
      (pixel - window.pixel) / window.cell_px + Eigen::Vector2d::Constant(kMiddle);
  const double last = kMapSide - 1.0;
  if (!(cell.minCoeff() >= 0.0 && cell.maxCoeff() < last)) return 0.0;
  const auto column = static_cast<std::size_t>(cell.x());
  const auto row = static_cast<std::size_t>(cell.y());
  const double wx = cell.x() - static_cast<double>(column);
  const double wy = cell.y() - static_cast<double>(row);
  const auto along = [&](std::size_t line) {
    const std::size_t i = line * kSide + column;
    return (1.0 - wx) * static_cast<double>(values[i]) + wx * static_cast<double>(values[i + 1]);
  };
  return (1.0 - wy) * along(row) + wy * along(row + 1);
}

Response::Peak Response::peak() const {
  const auto most = std::max_element(values.begin(), values.end());
  const auto at = static_cast<int>(most - values.begin());
  const int column = at % kMapSide, row = at / kMapSide;
  Eigen::Vector2d shift(column - kMiddle, row - kMiddle);
  if (column > 0 && column + 1 < kMapSide) shift.x() += vertex(most[-1], *most, most[1]);
  if (row > 0 && row + 1 < kMapSide) shift.y() += vertex(most[-kMapSide], *most, most[kMapSide]);
  return {window.pixel + shift * window.cell_px, static_cast<double>(*most)};
}

Response::Contrast Response::contrast(const Eigen::Vector2d& pixel) const {
  constexpr double kPeak = 5.0;  // [cells] not further from the target: its own response
  const Eigen::Vector2d centre =
      (pixel - window.pixel) / window.cell_px + Eigen::Vector2d::Constant(kMiddle);
  double sum = 0.0, squares = 0.0;
  int count = 0;
  for (int i = 0; i < kMapArea; ++i) {
    const Eigen::Vector2d cell(i % kMapSide, i / kMapSide);
    if ((cell - centre).cwiseAbs().maxCoeff() <= kPeak) continue;
    const auto value = static_cast<double>(values[static_cast<std::size_t>(i)]);
    sum += value;
    squares += value * value;
    ++count;
  }
  const double mean = sum / count;
  return {at(pixel), mean, std::sqrt(std::max(0.0, squares / count - mean * mean))};
}

double Response::prominence(const Eigen::Vector2d& pixel) const {
  const Contrast found = contrast(pixel);
  return found.sd > 0.0 ? found.above() / found.sd : 0.0;
}

CorrelationFilter::CorrelationFilter(const WindowView& view, const Eigen::Vector2d& size_px) {
  const Eigen::Vector2d half = 0.5 * size_px / view.window.cell_px;
  Map wanted;
  for (int i = 0; i < kMapArea; ++i) {
    const int x = i % kMapSide, y = i / kMapSide;
    const auto k = static_cast<std::size_t>(i);
    constexpr double kCentre = (kMapSide - 1) / 2.0;
    support_[k] =
        static_cast<float>(covered(x - kCentre, half.x()) * covered(y - kCentre, half.y()));
    const double right = x < kMiddle ? x : x - kMapSide, down = y < kMiddle ? y : y - kMapSide;
    wanted[k] =
        static_cast<float>(std::exp(-0.5 * (right * right + down * down) / (kPeakSd * kPeakSd)));
  }
  Spectrum none;
  transform(wanted, Map{}, wanted_, none);
  fit(spectra_of(view), 0.0);
}

Response CorrelationFilter::respond(const WindowView& view) const {
  Response response;
  response.window = view.window;
  Map wrapped, none;
  transform_back(correlation(filter_, spectra_of(view)), Spectrum{}, wrapped, none);
  for (std::size_t row = 0; row < kSide; ++row) {
    for (std::size_t column = 0; column < kSide; ++column) {
      response.values[(row + kMiddle) % kSide * kSide + (column + kMiddle) % kSide] =
          wrapped[row * kSide + column];
    }
  }
  return response;
}

void CorrelationFilter::learn(const WindowView& view, double share) {
  fit(spectra_of(view), kInertia / share);
}

// Minimises |x f - wanted|^2 + inertia |f - before|^2 for an f that equals a g which is zero
// outside the support, by two steps of the alternating direction method of multipliers from g = 0:
// equations (8) to (11) of the article. The matrix of each frequency is a multiple of the identity
// plus x x^H, so Sherman and Morrison's formula inverts it.
void CorrelationFilter::fit(const Spectra& x, double inertia) {
  constexpr std::array<float, 2> kPenalties{1.0F, 0.1F};
  constexpr auto kCount = static_cast<float>(kMapArea);
  const Spectra before = filter_;
  const Spectrum energy = correlation(x, x);
  Spectra restricted{}, multiplier{};
  const auto held = static_cast<float>(inertia);
  for (const float penalty : kPenalties) {
    const float sum = penalty + held;
    Spectra right;
    for (std::size_t c = 0; c < x.size(); ++c) {
      const auto part = [&](float sample, float l, float g, float b) {
        return (sample / kCount - l + penalty * g + held * b) / sum;
      };
      for (std::size_t k = 0; k < kSpectrumSize; ++k) {
        // The wanted response is symmetric: its spectrum is real.
        right[c].re[k] = part(x[c].re[k] * wanted_.re[k], multiplier[c].re[k], restricted[c].re[k],
                              before[c].re[k]);
        right[c].im[k] = part(x[c].im[k] * wanted_.re[k], multiplier[c].im[k], restricted[c].im[k],
                              before[c].im[k]);
      }
    }
    const Spectrum along = correlation(x, right);
    for (std::size_t c = 0; c < x.size(); ++c) {
      for (std::size_t k = 0; k < kSpectrumSize; ++k) {
        const float scale = 1.0F / (energy.re[k] + kCount * sum);
        const float re = along.re[k] * scale, im = along.im[k] * scale;
        filter_[c].re[k] = right[c].re[k] - (x[c].re[k] * re - x[c].im[k] * im);
        filter_[c].im[k] = right[c].im[k] - (x[c].re[k] * im + x[c].im[k] * re);
      }
    }
    if (penalty == kPenalties.back()) break;
    restricted = filter_;
    restrict_to(support_, restricted);
    for (std::size_t c = 0; c < x.size(); ++c) {
      for (std::size_t k = 0; k < kSpectrumSize; ++k) {
        multiplier[c].re[k] = penalty * (filter_[c].re[k] - restricted[c].re[k]);
        multiplier[c].im[k] = penalty * (filter_[c].im[k] - restricted[c].im[k]);
      }
    }
  }
}

}  // namespace ols::tracker
