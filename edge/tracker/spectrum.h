// Fourier transforms of small, square, real maps, two at a time, and the correlation of two
// spectra.
#pragma once

#include <array>

namespace ols::tracker {

inline constexpr int kMapSide = 32;
inline constexpr int kMapArea = kMapSide * kMapSide;
// Half of the columns are enough, because a real map's spectrum is symmetric.
inline constexpr int kHalf = kMapSide / 2 + 1;
inline constexpr int kSpectrumSize = kMapSide * kHalf;

using Map = std::array<float, kMapArea>;  // row by row, like a spectrum

// Real and imaginary parts are stored separately, so that the compiler can vectorise sums over
// them.
struct Spectrum {
  std::array<float, kSpectrumSize> re{};
  std::array<float, kSpectrumSize> im{};
};

// One spectrum for each channel of the features.
inline constexpr int kChannels = 22;  // even, because they are transformed in pairs
using Spectra = std::array<Spectrum, kChannels>;

// The unnormalised transforms of two maps.
void transform(const Map& a, const Map& b, Spectrum& to_a, Spectrum& to_b);
// The inverse: transform() followed by transform_back() gives the original maps.
void transform_back(const Spectrum& a, const Spectrum& b, Map& to_a, Map& to_b);
// The sum over all channels of conj(a) b.
Spectrum correlation(const Spectra& a, const Spectra& b);

}  // namespace ols::tracker
