#include "tools/calibrate/camera.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <opencv2/imgcodecs.hpp>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "tools/calibrate/board_fit.h"
#include "tools/calibrate/output_folder.h"

namespace ols::calibration {
namespace {

bool is_adjusted(int k) { return k != 6 && k != 7; }  // all but p1, p2

std::string instrument_text(const BoardCamera& camera, LensModel model) {
  std::ostringstream out;
  out << "# The camera's part of an instrument, from pictures of a board (docs/calibration.md).\n"
      << std::setprecision(10) << "\n[lens]\nmodel = \""
      << kLensModelNames.at(static_cast<std::size_t>(model)) << "\"\np1 = " << camera.values[6]
      << "\np2 = " << camera.values[7] << "\n\n[values]\n";
  for (int k = 0; k < kCameraSize; ++k) {
    if (!is_adjusted(k)) continue;
    out << kCameraParameters.at(static_cast<std::size_t>(k)) << " = " << camera.values[k] << '\n';
  }
  out << "\n[sd]\n";
  for (int k = 0; k < kCameraSize; ++k) {
    if (!is_adjusted(k)) continue;
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

struct Boards {
  std::vector<BoardView> views;
  std::vector<std::string> names;    // the picture of each view
  std::vector<std::string> without;  // pictures without the board in whole
  cv::Size size;
};

Boards read_boards(const CameraOptions& options) {
  Boards found;
  for (const std::string& path : options.pictures) {
    const cv::Mat picture = cv::imread(path, cv::IMREAD_GRAYSCALE);
    if (picture.empty()) throw std::runtime_error(path + ": is not a picture that can be read");
    if (found.size.area() > 0 && picture.size() != found.size) {
      throw std::runtime_error(path + ": is of another size than the pictures before it");
    }
    found.size = picture.size();
    BoardView view = find_board(picture, options.shape);
    if (view.pixels.empty()) {
      found.without.push_back(path);
      continue;
    }
    found.views.push_back(std::move(view));
    found.names.push_back(path);
  }
  return found;
}

// Remarks on the views whose corners do not fit those of the others.
std::vector<std::string> suspects(const Boards& boards, const BoardCamera& camera) {
  constexpr double kSuspect_px = 0.3;
  std::vector<std::string> said;
  for (std::size_t i = 0; i < boards.views.size(); ++i) {
    if (camera.view_rms_px[i] < std::max(kSuspect_px, 2.0 * camera.rms_px)) continue;
    std::ostringstream text;
    text << boards.names[i] << ": its corners are off by " << std::setprecision(2)
         << camera.view_rms_px[i] << " px: leave it out, or take it again";
    said.push_back(text.str());
  }
  return said;
}

std::string summary_of(const Boards& boards, const BoardCamera& camera) {
  std::ostringstream out;
  out << boards.views.size() << " of " << boards.views.size() + boards.without.size()
      << " pictures, residuals " << std::setprecision(3) << camera.rms_px << " px, focal length "
      << std::setprecision(7) << camera.values[0] << " px +- " << std::setprecision(2)
      << std::sqrt(camera.covariance(0, 0));
  return out.str();
}

CommandReport report_on(const Boards& boards, const BoardCamera& camera) {
  CommandReport report{{summary_of(boards, camera)}, {}, suspects(boards, camera)};
  for (const std::string& path : boards.without) {
    report.notes.push_back(path + ": the board is not found, or not in whole: left out");
  }
  if (boards.without.size() > boards.views.size()) {
    report.faults.push_back(
        "most pictures do not show the board: check --board, --columns and --rows");
  }
  return report;
}

}  // namespace

CommandReport write_camera(const CameraOptions& options) {
  check_board(options.shape);
  const auto folder = checked_folder(options.output);
  const Boards boards = read_boards(options);
  const BoardCamera camera = fit_boards(boards.views, boards.size, options.model);
  write_folder(folder, {{"instrument.toml", instrument_text(camera, options.model)},
                        {"camera-covariance.csv", covariance_text(camera)}});
  return report_on(boards, camera);
}

}  // namespace ols::calibration
