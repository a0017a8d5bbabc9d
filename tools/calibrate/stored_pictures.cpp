#include "tools/calibrate/stored_pictures.h"

#include <fmt/format.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <sstream>
#include <stdexcept>

namespace ols::calibration {
namespace {

namespace fs = std::filesystem;

StoredPicture picture_from(const nlohmann::json& line, const fs::path& folder) {
  return {line.at("pose").get<std::int64_t>(),
          folder / line.at("file").get<std::string>(),
          line.at("utime_us").get<std::int64_t>(),
          {{line.at("pan_counts"), 0.0, line.at("approach_pan")},
           {line.at("tilt_counts"), 0.0, line.at("approach_tilt")}},
          {line.at("pan_rad"), line.at("tilt_rad")},
          line.value("is_view", true)};
}

}  // namespace

std::string line_of(const StoredPicture& picture, const fs::path& folder) {
  const nlohmann::ordered_json line{{"pose", picture.pose},
                                    {"file", picture.file.lexically_relative(folder).string()},
                                    {"utime_us", picture.utime_us},
                                    {"pan_counts", picture.reading.pan.counts},
                                    {"tilt_counts", picture.reading.tilt.counts},
                                    {"approach_pan", picture.reading.pan.approach},
                                    {"approach_tilt", picture.reading.tilt.approach},
                                    {"pan_rad", picture.angles.pan_rad},
                                    {"tilt_rad", picture.angles.tilt_rad},
                                    {"is_view", picture.is_view}};
  return line.dump();
}

std::vector<StoredPicture> stored_pictures(const fs::path& folder, std::string_view lines) {
  std::vector<StoredPicture> pictures;
  std::istringstream in{std::string(lines)};
  int number = 0;
  for (std::string line; std::getline(in, line);) {
    ++number;
    try {
      pictures.push_back(picture_from(nlohmann::json::parse(line), folder));
    } catch (const nlohmann::json::exception& error) {
      throw std::runtime_error(
          fmt::format("{}:{}: {}", (folder / kFramesFile).string(), number, error.what()));
    }
  }
  return pictures;
}

std::vector<StoredPicture> stored_views(const fs::path& folder) {
  std::stringstream lines;
  lines << std::ifstream(folder / kFramesFile).rdbuf();
  auto pictures = stored_pictures(folder, lines.str());
  std::erase_if(pictures, [](const StoredPicture& one) { return !one.is_view; });
  if (pictures.empty()) {
    throw std::runtime_error(
        (folder / kFramesFile).string() +
        ": has no pictures of scenery. `ols-calibrate field` takes them; so does "
        "`sweep`, whose pictures `check` takes with --panorama");
  }
  return pictures;
}

cv::Mat gray_of(const StoredPicture& picture) {
  cv::Mat gray = cv::imread(picture.file.string(), cv::IMREAD_GRAYSCALE);
  if (gray.empty()) throw std::runtime_error(picture.file.string() + ": cannot be read");
  return gray;
}

}  // namespace ols::calibration
