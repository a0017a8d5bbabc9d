#include "tools/land/heading_command.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <iostream>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>

#include "edge/skyline/picture_heading.h"
#include "edge/skyline/strip_steps.h"
#include "geometry/angles.h"
#include "land/horizon_map.h"
#include "land/terrain_folder.h"
#include "tools/calibrate/command_report.h"

namespace ols::land {
namespace {

cv::Mat read_picture(const std::string& file) {
  cv::Mat picture = cv::imread(file, cv::IMREAD_COLOR);  // turned as its EXIF says
  if (picture.empty()) throw std::runtime_error(file + ": is no picture that can be read");
  constexpr int kLeast_px = 200;
  if (std::min(picture.cols, picture.rows) < kLeast_px) {
    throw std::runtime_error(file + ": is smaller than " + std::to_string(kLeast_px) + " pixels");
  }
  return picture;
}

void complete(CameraIntrinsics& camera, const cv::Mat& picture) {
  camera.width_px = picture.cols;
  camera.height_px = picture.rows;
  if (std::isnan(camera.fy_px)) camera.fy_px = camera.fx_px;
  if (std::isnan(camera.cx_px)) camera.cx_px = 0.5 * (picture.cols - 1);
  if (std::isnan(camera.cy_px)) camera.cy_px = 0.5 * (picture.rows - 1);
}

// As a station has it: the position's error and a shift of the whole model.
double place_sd_m(double position_sd_m, const Manifest& manifest) {
  double model_sd_m = 0.0;
  for (const GridFile& grid : manifest.grids) model_sd_m = std::max(model_sd_m, grid.sd_m);
  return std::hypot(position_sd_m, model_sd_m);
}

void print(const char* name, double rad, double sd_rad) {
  std::cout << name << ' ' << std::setprecision(3) << degrees(rad) << " deg, 1-sigma "
            << degrees(sd_rad) << " deg\n";
}

}  // namespace

int print_heading(HeadingOptions options) {
  const cv::Mat picture = read_picture(options.picture);
  complete(options.camera, picture);
  const TerrainFolder folder = read_terrain_folder(options.folder);
  std::vector<HorizonMap> maps;
  for (const double reach_m : skyline::visibilities_m(options.reach_m)) {
    maps.emplace_back(*folder.terrain, options.at, HorizonMapConfig{.reach_m = reach_m});
  }
  options.prior.place_sd_enu_m.setConstant(place_sd_m(options.position_sd_m, folder.manifest));
  const auto found = skyline::picture_heading(picture, options.camera, maps, options.prior);
  if (!found.doubt.empty()) {
    std::cerr << "ols-land: BAD  the picture does not determine the heading: " << found.doubt
              << '\n';
    return calibration::kExitLookAtIt;
  }
  const skyline::PictureFit& fit = *found.fit;
  std::cout << std::fixed;
  print("heading", fit.pose.heading_rad, fit.sd.heading_rad);
  print("tilt", fit.pose.tilt_rad, fit.sd.tilt_rad);
  print("roll", fit.pose.roll_rad, fit.sd.roll_rad);
  std::cout << "columns " << fit.agreeing * skyline::kStrip_px << " agree with the land, of "
            << fit.expected * skyline::kStrip_px << '\n';
  return 0;
}

}  // namespace ols::land
