#include "edge/tracker/scale_filter.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "edge/tracker/feature_map.h"
#include "edge/tracker/patch.h"

namespace ols::tracker {
namespace {

constexpr int kSizes = ScaleFilter::kSizes;
constexpr int kFrequencies = ScaleFilter::kFrequencies;
constexpr int kMiddle = kSizes / 2;
constexpr int kSide = 6;             // cells across the box
constexpr double kLeastShown = 0.5;  // pixels of the image a sample, each way
constexpr double kPeakSd = 1.1;      // [steps] of the wanted response
constexpr float kRegularisation = 0.001F;
constexpr double kLearning_s = 1.3;

double log_step() { return std::log(ScaleFilter::kStep); }

// Column f turns a function of the size into its spectrum at frequency f; Hann's window.
const Eigen::MatrixXcf& transform_matrix() {
  static const Eigen::MatrixXcf matrix = [] {
    Eigen::MatrixXcf made(kSizes, kFrequencies);
    for (int n = 0; n < kSizes; ++n) {
      const double window =
          0.5 + 0.5 * std::cos(2.0 * std::numbers::pi * (n - kMiddle) / (kSizes + 1));
      for (int f = 0; f < kFrequencies; ++f) {
        const double angle = -2.0 * std::numbers::pi * f * (n - kMiddle) / kSizes;
        made(n, f) = std::complex<float>(std::polar(window, angle));
      }
    }
    return made;
  }();
  return matrix;
}

// Spectrum of the wanted response to a target that is larger by `steps`.
Eigen::VectorXcf wanted(double steps) {
  Eigen::VectorXcf spectrum(kFrequencies);
  for (int f = 0; f < kFrequencies; ++f) {
    const double omega = 2.0 * std::numbers::pi * f / kSizes;
    const double gain = std::exp(-0.5 * std::pow(kPeakSd * omega, 2));
    spectrum(f) = std::complex<float>(std::polar(gain, -omega * steps));
  }
  return spectrum;
}

// The box resampled to kSide x kSide cells with a border of a pixel.
cv::Mat sampled(const FrameView& view, const Eigen::Vector2d& pixel,
                const Eigen::Vector2d& size_px) {
  const int across = kSide * kCellSide + 2;
  const Eigen::Vector2d step = size_px / (kSide * kCellSide) / view.reduction;
  const double first = -0.5 * (across - 1);
  const cv::Matx23d to_view(step.x(), 0.0, view.x_of(pixel.x()) + first * step.x(), 0.0, step.y(),
                            view.y_of(pixel.y()) + first * step.y());
  cv::Mat samples;
  cv::warpAffine(view.image, samples, to_view, {across, across},
                 cv::INTER_LINEAR | cv::WARP_INVERSE_MAP, cv::BORDER_REPLICATE);
  return samples;
}

// The response is real: each frequency but the first stands for its opposite, too.
double response_at(const Eigen::VectorXcf& spectrum, double steps) {
  double sum = static_cast<double>(spectrum(0).real());
  for (int f = 1; f < kFrequencies; ++f) {
    const double omega = 2.0 * std::numbers::pi * f / kSizes;
    sum += 2.0 * (std::complex<double>(spectrum(f)) * std::polar(1.0, omega * steps)).real();
  }
  return sum;
}

// Where the response is greatest, to a tenth of a step.
double steps_to_maximum(const Eigen::VectorXcf& spectrum) {
  constexpr int kFine = 10;
  double best = 0.0, most = response_at(spectrum, 0.0);
  const auto look = [&](double steps) {
    const double value = response_at(spectrum, steps);
    if (value > most) most = value, best = steps;
  };
  for (int n = -kMiddle; n <= kMiddle; ++n) look(n);
  const double rough = best;
  for (int n = -kFine; n <= kFine; ++n) look(rough + static_cast<double>(n) / kFine);
  return best;
}

// A small object in a box of sky shows no size that could be wrong: growth would feed on itself.
bool shows_at_border(const Eigen::Ref<const Eigen::VectorXf>& features) {
  constexpr float kLeast = 0.7F;  // of the gradients inside
  const auto in_cell = [&](int x, int y) {
    return features.segment((y * kSide + x) * kShapeChannels, kShapeChannels).sum();
  };
  constexpr int kInside = (kSide - 2) * (kSide - 2), kBorder = kSide * kSide - kInside;
  float inside = 0.0F;
  for (int y = 1; y < kSide - 1; ++y) {
    for (int x = 1; x < kSide - 1; ++x) inside += in_cell(x, y);
  }
  return (features.sum() - inside) / kBorder >= kLeast * inside / kInside;
}

}  // namespace

std::optional<ScaleFilter::Spectra> ScaleFilter::look_at(const cv::Mat& gray,
                                                         const Eigen::Vector2d& pixel,
                                                         const Eigen::Vector2d& size_px) {
  const double shown = std::sqrt(size_px.prod()) / (kSide * kCellSide);
  if (shown < kLeastShown) return std::nullopt;
  const double most = std::pow(kStep, kMiddle);
  const Eigen::Vector2d all = most * size_px + Eigen::Vector2d::Constant(4.0 * shown + 4.0);
  const FrameView view =
      make_view(gray, enclosing(box_of(pixel, all)), std::max(1, static_cast<int>(shown)));
  Samples samples(kSide * kSide * kShapeChannels, kSizes);
  for (int n = 0; n < kSizes; ++n) {
    const double scale = std::pow(kStep, n - kMiddle);
    add_shape(sampled(view, pixel, scale * size_px), kSide, samples.col(n).data());
  }
  if (!shows_at_border(samples.col(kMiddle))) return std::nullopt;
  return Spectra(samples * transform_matrix());
}

double ScaleFilter::growth(const Spectra& seen) const {
  if (empty()) return 0.0;
  Eigen::VectorXcf response(kFrequencies);
  for (int f = 0; f < kFrequencies; ++f) {
    response(f) = numerator_.col(f).conjugate().cwiseProduct(seen.col(f)).sum();
    response(f) /= energy_(f) + kRegularisation * energy_(0);
  }
  return steps_to_maximum(response) * log_step();
}

void ScaleFilter::learn(const Spectra& seen, double growth, double interval_s) {
  const Eigen::VectorXcf goal = wanted(growth / log_step());
  const Spectra numerator = seen * goal.conjugate().asDiagonal();
  const Eigen::VectorXf energy = seen.cwiseAbs2().colwise().sum();
  const auto share = empty() ? 1.0F : static_cast<float>(1.0 - std::exp(-interval_s / kLearning_s));
  if (empty()) {
    numerator_ = numerator;
    energy_ = energy;
    return;
  }
  numerator_ += share * (numerator - numerator_);
  energy_ += share * (energy - energy_);
}

}  // namespace ols::tracker
