// Textures for the simulated landscape, from seeded noise.
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <random>
#include <vector>

namespace ols::sim {

// Fractal noise (float) with zero mean and a standard deviation of 1. Wavelengths from `longest_px`
// down to `shortest_px`; each octave has `roughness` times the amplitude of the next longer one.
// Periodic in both directions.
cv::Mat fractal_noise(cv::Size size, double longest_px, double shortest_px, double roughness,
                      std::mt19937_64& generator);

// A square, periodic texture of a wood, `size` texels wide: tree crowns, lit from the upper left,
// and clearings.
cv::Mat wood(int size, std::mt19937_64& generator);

// Heights of periodic tree tops along a line of `length` texels, in texels, >= 0.
std::vector<float> tree_tops(int length, std::mt19937_64& generator);

}  // namespace ols::sim
