// Textures for the simulated landscape, from seeded noise.
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <random>
#include <vector>

namespace ols::sim {

// Fractal noise, float, with zero mean and unit deviation. Wavelengths from `longest_px` down to
// `shortest_px`; each octave has `roughness` times the amplitude of the octave before. Periodic in
// both directions.
cv::Mat fractal_noise(cv::Size size, double longest_px, double shortest_px, double roughness,
                      std::mt19937_64& generator);

// A periodic wood of this size: tree crowns, lit from the upper left, and clearings.
cv::Mat wood(int size, std::mt19937_64& generator);

// Periodic tree tops along a line of `length` texels: heights in texels >= 0.
std::vector<float> tree_tops(int length, std::mt19937_64& generator);

}  // namespace ols::sim
