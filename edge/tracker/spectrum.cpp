#include "edge/tracker/spectrum.h"

#include <opencv2/core.hpp>

namespace ols::tracker {
namespace {

constexpr auto kSide = static_cast<std::size_t>(kMapSide);
constexpr auto kColumns = static_cast<std::size_t>(kHalf);

// The index of the frequency of opposite sign.
constexpr std::size_t opposite(std::size_t i) { return (kSide - i) % kSide; }

using Complex = std::array<float, 2 * kMapArea>;  // interleaved

cv::Mat as_matrix(Complex& values) { return {kMapSide, kMapSide, CV_32FC2, values.data()}; }

}  // namespace

// One map is the real part, the other one the imaginary part; symmetry separates the spectra.
void transform(const Map& a, const Map& b, Spectrum& to_a, Spectrum& to_b) {
  Complex values;
  for (std::size_t i = 0; i < a.size(); ++i) {
    values[2 * i] = a[i];
    values[2 * i + 1] = b[i];
  }
  cv::Mat matrix = as_matrix(values);
  cv::dft(matrix, matrix);
  for (std::size_t row = 0; row < kSide; ++row) {
    for (std::size_t column = 0; column < kColumns; ++column) {
      const std::size_t at = 2 * (row * kSide + column);
      const std::size_t mirror = 2 * (opposite(row) * kSide + opposite(column));
      const std::size_t k = row * kColumns + column;
      to_a.re[k] = 0.5F * (values[at] + values[mirror]);
      to_a.im[k] = 0.5F * (values[at + 1] - values[mirror + 1]);
      to_b.re[k] = 0.5F * (values[at + 1] + values[mirror + 1]);
      to_b.im[k] = 0.5F * (values[mirror] - values[at]);
    }
  }
}

void transform_back(const Spectrum& a, const Spectrum& b, Map& to_a, Map& to_b) {
  Complex values;
  for (std::size_t row = 0; row < kSide; ++row) {
    for (std::size_t column = 0; column < kColumns; ++column) {
      const std::size_t k = row * kColumns + column;
      const std::size_t at = 2 * (row * kSide + column);
      values[at] = a.re[k] - b.im[k];
      values[at + 1] = a.im[k] + b.re[k];
      if (column == 0 || column + 1 == kColumns) continue;
      const std::size_t mirror = 2 * (opposite(row) * kSide + opposite(column));
      values[mirror] = a.re[k] + b.im[k];
      values[mirror + 1] = b.re[k] - a.im[k];
    }
  }
  cv::Mat matrix = as_matrix(values);
  cv::dft(matrix, matrix, cv::DFT_INVERSE | cv::DFT_SCALE);
  for (std::size_t i = 0; i < to_a.size(); ++i) {
    to_a[i] = values[2 * i];
    to_b[i] = values[2 * i + 1];
  }
}

Spectrum correlation(const Spectra& a, const Spectra& b) {
  Spectrum sum;
  for (std::size_t c = 0; c < a.size(); ++c) {
    for (std::size_t k = 0; k < kSpectrumSize; ++k) {
      sum.re[k] += a[c].re[k] * b[c].re[k] + a[c].im[k] * b[c].im[k];
      sum.im[k] += a[c].re[k] * b[c].im[k] - a[c].im[k] * b[c].re[k];
    }
  }
  return sum;
}

}  // namespace ols::tracker
