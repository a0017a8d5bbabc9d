// The pictures that a procedure has stored in its folder: frames.jsonl, with one line for each, and
// the files that it names.
#pragma once

#include <cstdint>
#include <filesystem>
#include <opencv2/core.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/kinematic_chain.h"
#include "geometry/station_model.h"

namespace ols::calibration {

inline constexpr const char* kFramesFile = "frames.jsonl";

struct StoredPicture {
  std::int64_t pose = 0;  // number of the picture in its procedure
  std::filesystem::path file;
  std::int64_t utime_us = 0;
  UnitReading reading;
  PanTilt angles;       // as the unit reported them
  bool is_view = true;  // shows permanent scenery, not stars, the sun or a drone
};

std::string line_of(const StoredPicture& picture, const std::filesystem::path& folder);
// `lines`: the text of the folder's frames.jsonl. Throws std::runtime_error naming file and line.
std::vector<StoredPicture> stored_pictures(const std::filesystem::path& folder,
                                           std::string_view lines);
// Reads the folder's frames.jsonl; only pictures of scenery. Throws std::runtime_error, also if
// there is none.
std::vector<StoredPicture> stored_views(const std::filesystem::path& folder);
// Throws std::runtime_error naming the file.
cv::Mat gray_of(const StoredPicture& picture);

}  // namespace ols::calibration
