// Headings of single photographs by the skyline of the land (ols-land heading), at many places in
// an imported folder. A picture shows that land with errors of the size that the folder states and
// of a length of land::kLowered_m, from a place that is known to --position-sd, through a lens
// whose focal length and distortion are known to the stated sigmas. It has haze, clouds with hard
// edges, trees and masts in front of the skyline, vignetting, noise, JPEG's losses, and sometimes
// a caption. The heading is known to --heading-sd.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <random>
#include <vector>

#include "dev/bench/program.h"
#include "dev/bench/true_land.h"
#include "edge/skyline/picture_heading.h"
#include "geometry/angles.h"
#include "geometry/direction.h"
#include "land/column_march.h"
#include "land/terrain_folder.h"
#include "sim/world/texture.h"

namespace {

using namespace ols;

struct Options {
  std::string folder, pictures;
  int sites = 40, from = 0;
  double heading_sd_deg = 5.0, position_sd_m = 5.0, focal_sd = 0.01, k1_sd = 0.02;
  double haze_km = 40.0;  // visibility, median
  double land_errors = 1.0;
  bool all_around = false;
  double elsewhere_deg = 0.0;
  unsigned seed = 1;
};

struct Tree {  // in front of the skyline
  double azimuth_rad = 0.0, half_rad = 0.0, high_rad = 0.0;
  bool is_mast = false;
};

struct Sky {
  double cloudiness = 0.0, visibility_m = 0.0, overcast = 0.0;
  std::vector<Tree> trees;
  cv::Mat clouds, leaves;  // noise, of the picture's size
};

cv::Vec3d mixed(const cv::Vec3d& a, const cv::Vec3d& b, double share) {
  return a * (1.0 - share) + b * share;
}

class Painter {
 public:
  Painter(const land::HorizonMap& land, const Sky& sky) : land_(land), sky_(sky) {}

  // Of one line of sight; `place`: in the picture.
  cv::Vec3d colour(const AzimuthElevation& sight, const cv::Point& place) const {
    static const cv::Vec3d kHorizon(225, 215, 205), kZenith(190, 130, 80), kGray(190, 190, 188);
    const double grain = sky_.leaves.at<float>(place), cloud = sky_.clouds.at<float>(place);
    const double high = std::clamp(sight.elevation_rad / radians(40.0), 0.0, 1.0);
    const cv::Vec3d clear = mixed(mixed(kHorizon, kZenith, std::sqrt(high)), kGray, sky_.overcast);
    for (const Tree& tree : sky_.trees) {
      const double off = std::abs(wrap_pi(sight.azimuth_rad - tree.azimuth_rad)) / tree.half_rad;
      if (off > 1.0) continue;
      const auto skyline = land_.skyline(sight.azimuth_rad);
      const double shape = tree.is_mast ? 1.0 : std::sqrt(1.0 - off * off) + 0.1 * grain;
      if (skyline && sight.elevation_rad < skyline->elevation_rad + tree.high_rad * shape) {
        return cv::Vec3d(35, 50, 40) + cv::Vec3d(12, 18, 14) * grain;
      }
    }
    if (const auto hit = land_.ground(sight)) {
      const bool is_sea = sight.elevation_rad < 0.0 &&
                          hit->range_m * -sight.elevation_rad > land_.camera().height_m - 75.0;
      const double rock = 0.5 + 0.5 * std::tanh(cloud);
      const cv::Vec3d own =
          is_sea ? cv::Vec3d(120, 95, 60) + cv::Vec3d(4, 4, 4) * grain
                 : mixed({45, 75, 65}, {95, 100, 110}, rock) + cv::Vec3d(14, 18, 16) * grain;
      return mixed(own, clear, 1.0 - std::exp(-3.9 * hit->range_m / sky_.visibility_m));
    }
    const double inside = 1.0 / (1.0 + std::exp(-25.0 * (cloud - 1.2 + 2.0 * sky_.cloudiness)));
    const double lit = 235.0 - 60.0 * (0.5 + 0.5 * std::tanh(0.7 * cloud + 0.3 * grain));
    return mixed(clear, cv::Vec3d(lit, lit - 2, lit - 5), sky_.cloudiness > 0.0 ? inside : 0.0);
  }

 private:
  const land::HorizonMap& land_;
  const Sky& sky_;
};

struct Case {
  CameraIntrinsics stated, own;  // the camera as it is known, as it is
  skyline::PicturePose pose;
  Sky sky;
};

// Whether the skyline around an azimuth is far, and no plain.
bool is_worth_it(const land::HorizonMap& land, double azimuth_rad) {
  constexpr double kFar_m = 2000.0, kRelief_rad = radians(1.0);
  int far = 0, all = 0;
  double lowest_rad = 1.0, highest_rad = -1.0;
  for (int deg = -15; deg <= 15; ++deg, ++all) {
    const auto skyline = land.skyline(azimuth_rad + radians(deg));
    if (!skyline || skyline->distance_m < kFar_m) continue;
    ++far;
    lowest_rad = std::min(lowest_rad, skyline->elevation_rad);
    highest_rad = std::max(highest_rad, skyline->elevation_rad);
  }
  return far > all / 2 && highest_rad - lowest_rad > kRelief_rad;
}

Case make_case(const Options& options, const land::HorizonMap& land, std::mt19937_64& generator) {
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  std::normal_distribution<double> normal(0.0, 1.0);
  Case made;
  const bool portrait = uniform(generator) < 0.2;
  made.stated.width_px = portrait ? 720 : 1080;
  made.stated.height_px = portrait ? 1080 : 720;
  made.stated.cx_px = 0.5 * (made.stated.width_px - 1);
  made.stated.cy_px = 0.5 * (made.stated.height_px - 1);
  made.stated.fx_px = made.stated.fy_px =
      540.0 / std::tan(0.5 * radians(30.0 + 40.0 * uniform(generator)));
  made.own = made.stated;
  made.own.fx_px *= 1.0 + options.focal_sd * normal(generator);
  made.own.fy_px = made.own.fx_px;
  made.own.k1 = options.k1_sd * normal(generator);
  // One takes a picture of what is far.
  constexpr int kTries = 30;
  for (int i = 0; i < kTries; ++i) {
    made.pose.heading_rad = 2.0 * kPi * uniform(generator);
    if (is_worth_it(land, made.pose.heading_rad)) break;
  }
  const auto there = land.skyline(made.pose.heading_rad);
  made.pose.tilt_rad =
      (there ? 0.5 * there->elevation_rad : 0.0) + radians(3.0) * normal(generator);
  made.pose.roll_rad = radians(1.0) * normal(generator);
  made.sky.visibility_m = 1000.0 * options.haze_km * std::exp(0.6 * normal(generator));
  made.sky.cloudiness = std::max(0.0, 1.2 * uniform(generator) - 0.2);
  made.sky.overcast = std::max(0.0, 2.0 * uniform(generator) - 1.0);
  const int trees = static_cast<int>(6.0 * uniform(generator));
  for (int i = 0; i < trees; ++i) {
    Tree tree;
    tree.azimuth_rad = made.pose.heading_rad + radians(60.0) * (uniform(generator) - 0.5);
    tree.is_mast = uniform(generator) < 0.3;
    tree.half_rad =
        tree.is_mast ? radians(0.1) : radians(0.3 + 3.0 * std::pow(uniform(generator), 2));
    tree.high_rad = radians(0.5 + 6.0 * std::pow(uniform(generator), 2));
    made.sky.trees.push_back(tree);
  }
  const cv::Size size(made.stated.width_px, made.stated.height_px);
  made.sky.clouds = sim::fractal_noise(size, 300, 6, 0.6, generator);
  made.sky.leaves = sim::fractal_noise(size, 12, 1.5, 0.8, generator);
  return made;
}

cv::Mat picture_of(const Case& made, const land::HorizonMap& truth, std::mt19937_64& generator) {
  const Painter painter(truth, made.sky);
  const Eigen::Matrix3d R = skyline::R_enu_cam(made.pose);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  const double vignette = 0.4 * uniform(generator);
  cv::Mat exact(made.own.height_px, made.own.width_px, CV_64FC3);
  const double reach2 = std::pow(0.5 * std::hypot(exact.cols, exact.rows), 2);
  for (int y = 0; y < exact.rows; ++y) {
    for (int x = 0; x < exact.cols; ++x) {
      const auto ray = unproject(made.own, Eigen::Vector2d(x, y));
      const double off2 = std::pow(x - made.own.cx_px, 2) + std::pow(y - made.own.cy_px, 2);
      exact.at<cv::Vec3d>(y, x) =
          painter.colour(azimuth_elevation_from_enu(R * ray.value()), {x, y}) *
          (1.0 - vignette * off2 / reach2);
    }
  }
  cv::GaussianBlur(exact, exact, {}, 0.6);
  cv::Mat noise(exact.size(), CV_64FC3), picture;
  cv::theRNG().state = generator();
  cv::randn(noise, 0.0, 2.5);
  cv::Mat(exact + noise).convertTo(picture, CV_8U);
  if (uniform(generator) < 0.25) {  // a caption
    cv::Mat bar = picture.rowRange(picture.rows * 93 / 100, picture.rows);
    bar.setTo(cv::Scalar::all(0));
    cv::putText(bar, "12:31  alfa", {20, bar.rows - 12}, cv::FONT_HERSHEY_SIMPLEX, 1.0,
                cv::Scalar::all(255), 2);
  }
  std::vector<std::uint8_t> file;
  cv::imencode(".jpg", picture, file, {cv::IMWRITE_JPEG_QUALITY, 85});
  return cv::imdecode(file, cv::IMREAD_COLOR);
}

Geodetic place_of(const land::TerrainFolder& folder, std::mt19937_64& generator) {
  constexpr double kWithin_rad = radians(0.15), kLand_m = 70.0;
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  // Where one sees far: the highest of some places.
  std::optional<Geodetic> place;
  double highest_m = kLand_m;
  for (int i = 0; i < 4 || !place; ++i) {
    const double latitude_rad =
        radians(folder.manifest.latitude_deg) + kWithin_rad * uniform(generator);
    const double longitude_rad =
        radians(folder.manifest.longitude_deg) + kWithin_rad * uniform(generator);
    const auto there = folder.terrain->ground(latitude_rad, longitude_rad);
    if (!there || there->height_m <= highest_m) continue;
    highest_m = there->height_m;
    place = Geodetic{latitude_rad, longitude_rad, 0.0};
  }
  return *place;
}

struct Sum {
  int pictures = 0, doubtful = 0, wrong = 0;
  double nees = 0.0;
  std::vector<double> errors_deg;
};

void run_site(const land::TerrainFolder& folder, const Options& options, unsigned seed, Sum& sum) {
  std::mt19937_64 generator(seed);
  Geodetic place = place_of(folder, generator);
  const bench::TrueLand land(*folder.terrain, place, options.land_errors, land::kLowered_m, seed);
  place.height_m = land.ground(place.latitude_rad, place.longitude_rad)->height_m + 3.0;
  std::normal_distribution<double> normal(0.0, 1.0);
  const Eigen::Vector3d off_m(normal(generator), normal(generator), normal(generator));
  const Geodetic stated =
      geodetic_from_ecef(LocalFrame(place).to_ecef(options.position_sd_m * off_m));
  std::vector<land::HorizonMap> maps;
  for (const double reach_m : skyline::visibilities_m(60'000.0)) {
    maps.emplace_back(*folder.terrain, stated, land::HorizonMapConfig{.reach_m = reach_m});
  }
  const land::HorizonMap& known = maps.front();
  const Case made = make_case(options, known, generator);
  constexpr double kSector_rad = radians(100.0);  // that a picture may show
  const land::HorizonMap truth(land, place,
                               {.columns = 3600,
                                .reach_m = 60'000.0,
                                .from_azimuth_rad = made.pose.heading_rad - 0.5 * kSector_rad,
                                .sector_rad = kSector_rad});
  const cv::Mat picture = picture_of(made, truth, generator);
  if (!options.pictures.empty()) {
    cv::imwrite(options.pictures + "/" + std::to_string(seed) + ".jpg", picture);
  }
  skyline::PicturePrior prior;
  prior.heading_sd_rad = radians(options.heading_sd_deg);
  const double prior_off_rad =
      prior.heading_sd_rad * normal(generator) + radians(options.elsewhere_deg);
  if (!options.all_around) prior.heading_rad = wrap_two_pi(made.pose.heading_rad + prior_off_rad);
  prior.tilt_sd_rad = radians(8.0);
  prior.roll_sd_rad = radians(2.0);
  prior.focal_sd = options.focal_sd;
  prior.k1_sd = options.k1_sd;
  prior.place_sd_enu_m.setConstant(std::hypot(options.position_sd_m, 4.0));
  const auto heading = skyline::picture_heading(picture, made.stated, maps, prior);
  ++sum.pictures;
  std::printf(
      "site %u: heading %.3f tilt %.2f roll %.2f, prior off %+.2f, visibility %.0f km, clouds "
      "%.1f, trees %zu: ",
      seed, degrees(made.pose.heading_rad), degrees(made.pose.tilt_rad),
      degrees(made.pose.roll_rad), degrees(prior_off_rad), 1e-3 * made.sky.visibility_m,
      made.sky.cloudiness, made.sky.trees.size());
  const bool is_told = heading.fit && heading.doubt.empty();
  if (heading.fit) {
    const double error_deg =
        degrees(wrap_pi(heading.fit->pose.heading_rad - made.pose.heading_rad));
    const double sigmas = error_deg / degrees(heading.fit->sd.heading_rad);
    std::printf("off %+.3f +- %.3f (%+.1f) deg, %d of %d strips agree, lead %.0f%s ", error_deg,
                degrees(heading.fit->sd.heading_rad), sigmas, heading.fit->agreeing,
                heading.fit->expected, heading.lead, std::abs(sigmas) > 3.0 ? " WRONG" : "");
    if (is_told) {
      sum.errors_deg.push_back(std::abs(error_deg));
      sum.wrong += std::abs(sigmas) > 3.0 ? 1 : 0;
      sum.nees += sigmas * sigmas;
    }
  }
  if (!is_told) ++sum.doubtful;
  std::printf("%s\n", heading.doubt.c_str());
}

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0.0;
  std::ranges::sort(values);
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

void run(const Options& options) {
  const land::TerrainFolder folder = land::read_terrain_folder(options.folder);
  Sum sum;
  for (int i = 0; i < options.sites; ++i) {
    run_site(folder, options, options.seed * 1000 + static_cast<unsigned>(i + options.from), sum);
    std::fflush(stdout);
  }
  std::printf(
      "%d pictures: heading told in %zu, error (median) %.3f deg, 90 %% %.3f deg, NEES %.2f, "
      "beyond three sigmas %d; in doubt %d\n",
      sum.pictures, sum.errors_deg.size(), quantile(sum.errors_deg, 0.5),
      quantile(sum.errors_deg, 0.9),
      sum.nees / std::max<double>(1.0, static_cast<double>(sum.errors_deg.size())), sum.wrong,
      sum.doubtful);
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app("Headings of rendered photographs by the skyline.", "ols-bench-photograph");
  app.add_option("--land", options.folder, "Folder of ols-land import")->required();
  app.add_option("--sites", options.sites);
  app.add_option("--from", options.from, "The first of them");
  app.add_option("--heading-sd", options.heading_sd_deg, "1-sigma of the stated heading [deg]");
  app.add_option("--position-sd", options.position_sd_m, "The same of the position, each axis [m]");
  app.add_option("--focal-sd", options.focal_sd, "The same of the focal length, as a part of it");
  app.add_option("--k1-sd", options.k1_sd, "The same of k1");
  app.add_option("--visibility-km", options.haze_km, "Median of all pictures");
  app.add_option("--land-errors", options.land_errors, "Of the land, over those that it states");
  app.add_flag("--all-around", options.all_around, "Nothing is known of the heading");
  app.add_option("--elsewhere", options.elsewhere_deg,
                 "The stated heading is wrong by so much: nothing may be told [deg]");
  app.add_option("--pictures", options.pictures, "Folder for the pictures");
  app.add_option("--seed", options.seed);
  return bench::run_program(app, argc, argv, [&] { run(options); });
}
