// Reads the recorder's files, and makes frames for its tests.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <opencv2/core.hpp>
#include <set>
#include <string>

#include "edge/recorder/frame_memory.h"
#include "tests/unit/temporary_folder.h"

namespace ols::recorder {

inline std::set<std::string> names_in(const std::filesystem::path& folder) {
  std::set<std::string> names;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
    names.insert(entry.path().filename().string());
  }
  return names;
}

inline std::string content_of(const std::filesystem::path& file) {
  std::ifstream stream(file);
  return {std::istreambuf_iterator<char>(stream), {}};
}

// A frame of noise: its PNG is not smaller than the picture.
inline RecordedFrame noisy_frame(std::uint64_t number, double time_s, int side_px = 64) {
  RecordedFrame frame;
  frame.picture = cv::Mat(side_px, side_px, CV_8UC1);
  cv::RNG generator(number + 1);
  generator.fill(frame.picture, cv::RNG::UNIFORM, 0, 256);
  frame.number = number;
  frame.mid_exposure_s = time_s;
  frame.utime_us = 1'700'000'000'000'000 + static_cast<std::int64_t>(time_s * 1e6);
  frame.sd_s = 1e-5;
  return frame;
}

}  // namespace ols::recorder
