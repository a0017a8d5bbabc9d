#include "tools/calibrate/camera.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <opencv2/imgcodecs.hpp>
#include <sstream>
#include <stdexcept>

#include "tools/calibrate/board_fit.h"
#include "tools/calibrate/output_folder.h"

namespace ols::calibration {
namespace {

std::string instrument_text(const BoardCamera& camera) {
  std::ostringstream out;
  out << "# The camera's part of an instrument, from pictures of a board (docs/calibration.md).\n"
      << std::setprecision(10) << "\n[lens]\np1 = " << camera.values[6]
      << "\np2 = " << camera.values[7] << "\nk3 = " << camera.values[8] << "\n\n[values]\n";
  constexpr int kAdjusted = 6;  // of the parameters, those that an adjustment knows
  for (int k = 0; k < kAdjusted; ++k) {
    out << kCameraParameters.at(static_cast<std::size_t>(k)) << " = " << camera.values[k] << '\n';
  }
  out << "\n[sd]\n";
  for (int k = 0; k < kAdjusted; ++k) {
    out << kCameraParameters.at(static_cast<std::size_t>(k)) << " = "
        << std::sqrt(camera.covariance(k, k)) << '\n';
  }
  return out.str();
}

std::string covariance_text(const BoardCamera& camera) {
  std::ostringstream out;
  out << std::setprecision(12) << "parameter";
  for (const char* name : kCameraParameters) out << ',' << name;
  out << '\n';
  for (int i = 0; i < kCameraSize; ++i) {
    out << kCameraParameters.at(static_cast<std::size_t>(i));
    for (int j = 0; j < kCameraSize; ++j) out << ',' << camera.covariance(i, j);
    out << '\n';
  }
  return out.str();
}

}  // namespace

std::vector<std::string> write_camera(const CameraOptions& options) {
  check_board(options.shape);
  const auto folder = checked_folder(options.output);
  std::vector<BoardView> views;
  std::vector<std::string> names, remarks;
  cv::Size size;
  for (const std::string& path : options.pictures) {
    const cv::Mat picture = cv::imread(path, cv::IMREAD_GRAYSCALE);
    if (picture.empty()) throw std::runtime_error(path + ": is not a picture that can be read");
    if (size.area() > 0 && picture.size() != size) {
      throw std::runtime_error(path + ": is of another size than the pictures before it");
    }
    size = picture.size();
    BoardView view = find_board(picture, options.shape);
    if (view.pixels.empty()) {
      remarks.push_back(path + ": the board is not found, or not in whole");
      continue;
    }
    views.push_back(std::move(view));
    names.push_back(path);
  }
  const BoardCamera camera = fit_boards(views, size);
  constexpr double kSuspect_px = 0.3;
  for (std::size_t i = 0; i < views.size(); ++i) {
    if (camera.view_rms_px[i] < std::max(kSuspect_px, 2.0 * camera.rms_px)) continue;
    std::ostringstream text;
    text << names[i] << ": its corners are off by " << std::setprecision(2) << camera.view_rms_px[i]
         << " px: take it again";
    remarks.push_back(text.str());
  }
  std::ostringstream summary;
  summary << views.size() << " pictures, residuals " << std::setprecision(3) << camera.rms_px
          << " px, focal length " << std::setprecision(7) << camera.values[0] << " px +- "
          << std::setprecision(2) << std::sqrt(camera.covariance(0, 0));
  remarks.push_back(summary.str());
  write_folder(folder, {{"instrument.toml", instrument_text(camera)},
                        {"camera-covariance.csv", covariance_text(camera)}});
  return remarks;
}

}  // namespace ols::calibration
