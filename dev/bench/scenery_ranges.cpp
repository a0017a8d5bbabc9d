// Ranges of scenery: what two stations state that they see, and what is there. Each world is a
// place in an imported folder of land, with trees, houses and masts that the folder does not have.
// Both stations state poses with errors; the pictures are matched with one draw of them, and the
// ranges of the same points are computed with many more.
#include "land/scenery/scenery_ranges.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <opencv2/imgcodecs.hpp>
#include <random>
#include <string>
#include <vector>

#include "dev/bench/program.h"
#include "dev/bench/scenery_site.h"
#include "dev/bench/scenery_world.h"
#include "geometry/angles.h"

namespace {

using namespace ols;
using scenery::ScenePanorama;

struct Options {
  std::string folder, pictures;
  int worlds = 3, draws = 50;
  unsigned seed = 11;
  double baseline_m = 500.0, focal_px = 13333.0;
  double heading_sd_deg = 15.0 / 3600.0, tilt_sd_deg = 15.0 / 3600.0, position_sd_m = 0.05;
};

struct Station {
  ScenePanorama truth;  // its pose, too
  cv::Mat1f range_m;
};

// All land from 700 m to 3 500 m, and some sky.
bench::PanoramaRaster raster_of(const bench::SceneryWorld& world, const bench::ScenerySite& site,
                                std::size_t number, double focal_px) {
  std::vector<double> elevations_rad;
  const Eigen::Vector2d right(site.along.y(), -site.along.x());
  for (double distance_m = 700.0; distance_m < 3500.0; distance_m *= 1.1) {
    for (int i = -3; i <= 3; ++i) {
      const Eigen::Vector2d place = site.along * distance_m + right * 150.0 * i;
      const double height_m = world.ground_m(place.x(), place.y());
      if (std::isnan(height_m)) continue;
      const Eigen::Vector3d off =
          Eigen::Vector3d(place.x(), place.y(), height_m) - site.cameras_enu_m[number];
      elevations_rad.push_back(std::atan2(off.z(), off.head<2>().norm()));
    }
  }
  std::ranges::sort(elevations_rad);
  const std::size_t few = elevations_rad.size() / 50;
  const double top_rad = elevations_rad[elevations_rad.size() - 1 - few] + radians(1.2);
  const double bottom_rad = std::max(elevations_rad[few] - radians(0.3), top_rad - radians(9.0));
  // Each sees the same land, up to 600 m to either side.
  const double inner_rad = radians(6.0), outer_rad = radians(33.0);
  const double heading_rad = std::atan2(site.along.x(), site.along.y());
  bench::PanoramaRaster raster;
  raster.rad_per_px = 1.0 / focal_px;
  raster.top_elevation_rad = top_rad;
  raster.first_azimuth_rad = heading_rad - (number == 0 ? inner_rad : outer_rad);
  raster.size = {static_cast<int>((inner_rad + outer_rad) * focal_px),
                 static_cast<int>((top_rad - bottom_rad) * focal_px)};
  return raster;
}

Station station_of(const bench::SceneryWorld& world, const bench::ScenerySite& site,
                   std::size_t number, const Options& options) {
  const LocalFrame frame(site.middle);
  const bench::PanoramaRaster raster = raster_of(world, site, number, options.focal_px);
  const bench::Exposure exposure =
      number == 0 ? bench::Exposure{} : bench::Exposure{.gain = 0.93, .offset = 6.0};
  const bench::DrawnPanorama drawn = bench::draw_panorama(world, site.cameras_enu_m[number], raster,
                                                          exposure, 2 * world.seed + number);
  Station station{.truth = {.gray = drawn.gray,
                            .first_azimuth_rad = raster.first_azimuth_rad,
                            .top_elevation_rad = raster.top_elevation_rad,
                            .rad_per_px = raster.rad_per_px,
                            .centre_ecef = frame.to_ecef(site.cameras_enu_m[number]),
                            .R_ecef_enu = frame.R_ecef_enu(),
                            .sd = {radians(options.heading_sd_deg), radians(options.tilt_sd_deg),
                                   options.position_sd_m}},
                  .range_m = drawn.range_m};
  if (!options.pictures.empty()) {
    cv::imwrite(options.pictures + "/scenery-" + std::to_string(world.seed) + "-" +
                    std::to_string(number) + ".png",
                drawn.gray);
  }
  return station;
}

ScenePanorama stated(const ScenePanorama& truth, std::mt19937_64& generator) {
  std::normal_distribution<double> normal;
  scenery::PoseError error{.heading_rad = truth.sd.heading_rad * normal(generator)};
  for (double& tilt_rad : error.tilt_rad) tilt_rad = truth.sd.tilt_rad * normal(generator);
  for (double& m : error.position_enu_m) m = truth.sd.position_m * normal(generator);
  return scenery::with_error(truth, error);
}

// Between pixels where these show the same surface; else the one nearest to what was stated,
// because a corner at an edge belongs to either side.
double true_range_m(const cv::Mat1f& range_m, const Eigen::Vector2d& px, double stated_m) {
  constexpr double kSame_m = 1.0, kSame = 1e-3;
  const int i = std::clamp(static_cast<int>(px.x()), 1, range_m.cols - 3);
  const int j = std::clamp(static_cast<int>(px.y()), 1, range_m.rows - 3);
  const cv::Mat1f four = range_m(cv::Rect(i, j, 2, 2));
  const auto [least, most] = std::minmax_element(four.begin(), four.end());
  if (*most - *least < kSame_m + kSame * *least) {
    const double a = px.x() - i, b = px.y() - j;
    return (1 - b) * ((1 - a) * four(0, 0) + a * four(0, 1)) +
           b * ((1 - a) * four(1, 0) + a * four(1, 1));
  }
  double nearest_m = 1e9;
  for (const float one_m : cv::Mat1f(range_m(cv::Rect(i - 1, j - 1, 4, 4)).clone())) {
    if (std::abs(one_m - stated_m) < std::abs(nearest_m - stated_m)) nearest_m = one_m;
  }
  return nearest_m;
}

constexpr double kWrong = 4.0;  // sigmas

struct Band {
  const char* name;
  double from_m, to_m;
  int points = 0, wrong = 0;
  std::vector<double> sds_m;
  // Errors over their 1-sigma: with the drawn poses; of the pictures alone, with the true poses.
  std::vector<double> sigmas, white_sigmas;

  void print() const {
    if (points == 0) return;
    std::vector<double> sds = sds_m;
    const auto middle = sds.begin() + static_cast<std::ptrdiff_t>(sds.size() / 2);
    std::ranges::nth_element(sds, middle);
    std::printf(
        "  %s: %d ranges, 1-sigma %.2f m; told over actual %.2f (robust), %.2f (RMS), %.2f (RMS "
        "without "
        "the wrong ones); pictures alone %.2f, %.2f, %.2f; wrong %d (%.2f %%)\n",
        name, points, *middle, over_median(sigmas), over_rms(sigmas), over_rms(right(sigmas)),
        over_median(white_sigmas), over_rms(white_sigmas), over_rms(right(white_sigmas)), wrong,
        100.0 * wrong / points);
  }

 private:
  static std::vector<double> right(std::vector<double> sigmas) {
    std::erase_if(sigmas, [](double one) { return std::abs(one) > kWrong; });
    return sigmas;
  }
  static double over_rms(const std::vector<double>& sigmas) {
    double sum = 0.0;
    for (double one : sigmas) sum += one * one;
    return std::sqrt(static_cast<double>(sigmas.size()) / sum);
  }
  static double over_median(std::vector<double> sigmas) {
    for (double& one : sigmas) one = std::abs(one);
    const auto middle = sigmas.begin() + static_cast<std::ptrdiff_t>(sigmas.size() / 2);
    std::ranges::nth_element(sigmas, middle);
    return 0.6745 / *middle;
  }
};

std::vector<Band> bands() {
  return {{.name = "0.7 to 1.4 km", .from_m = 700.0, .to_m = 1400.0},
          {.name = "2.2 to 4 km  ", .from_m = 2200.0, .to_m = 4000.0},
          {.name = "all          ", .from_m = 0.0, .to_m = 1e9}};
}

void add(const Band& from, Band& to) {
  to.points += from.points;
  to.wrong += from.wrong;
  to.sds_m.insert(to.sds_m.end(), from.sds_m.begin(), from.sds_m.end());
  to.sigmas.insert(to.sigmas.end(), from.sigmas.begin(), from.sigmas.end());
  to.white_sigmas.insert(to.white_sigmas.end(), from.white_sigmas.begin(), from.white_sigmas.end());
}

void judge(const std::vector<scenery::SceneryRange>& found, const Station& one, const Station& two,
           const Options& options, std::mt19937_64& generator, std::vector<Band>& result) {
  std::vector<std::array<ScenePanorama, 2>> poses;
  for (int i = 0; i < options.draws; ++i) {
    poses.push_back({stated(one.truth, generator), stated(two.truth, generator)});
  }
  for (const scenery::SceneryRange& range : found) {
    const auto exact_m =
        scenery::range_m(one.truth, two.truth, range.px, range.other_px.x(), range.range_m);
    const double truth_m = true_range_m(one.range_m, range.px, exact_m.value_or(range.range_m));
    Band here{.name = "", .from_m = 0.0, .to_m = 0.0, .points = 1, .sds_m = {range.sd_m()}};
    here.white_sigmas = {(exact_m.value_or(0.0) - truth_m) / range.sd_white_m};
    for (const auto& pose : poses) {
      const auto stated_m =
          scenery::range_m(pose[0], pose[1], range.px, range.other_px.x(), range.range_m);
      here.sigmas.push_back((stated_m.value_or(0.0) - truth_m) / range.sd_m());
    }
    here.wrong = std::abs(exact_m.value_or(0.0) - truth_m) > kWrong * range.sd_m() ? 1 : 0;
    for (Band& band : result) {
      if (range.range_m >= band.from_m && range.range_m < band.to_m) add(here, band);
    }
  }
}

void run_world(const land::TerrainFolder& folder, const Options& options, unsigned seed,
               std::vector<Band>& sum) {
  const bench::ScenerySite site = bench::find_site(folder, options.baseline_m, seed);
  const bench::TrueGround ground(*folder.terrain, site.middle, seed);
  const bench::SceneryWorld world = bench::make_world(
      [&](double east_m, double north_m) { return ground.height_m(east_m, north_m); }, site.along,
      {}, seed);
  const Station one = station_of(world, site, 0, options),
                two = station_of(world, site, 1, options);
  std::mt19937_64 generator(seed);
  const ScenePanorama stated_one = stated(one.truth, generator);
  const ScenePanorama stated_two = stated(two.truth, generator);
  const auto possible = [&](const ScenePanorama& panorama) -> scenery::PossibleRanges {
    return [&folder, frame = LocalFrame(geodetic_from_ecef(panorama.centre_ecef))](
               const AzimuthElevation& direction) {
      return scenery::possible_ranges(*folder.terrain, frame, direction, {300.0, 6000.0});
    };
  };
  const auto found =
      scenery::scenery_ranges(stated_one, stated_two, possible(stated_one), possible(stated_two));
  std::vector<Band> result = bands();
  judge(found, one, two, options, generator, result);
  std::printf("world %u at %.4f, %.4f:\n", seed, degrees(site.middle.latitude_rad),
              degrees(site.middle.longitude_rad));
  for (std::size_t i = 0; i < result.size(); ++i) {
    result[i].print();
    add(result[i], sum[i]);
  }
  std::fflush(stdout);
}

void run(const Options& options) {
  const land::TerrainFolder folder = land::read_terrain_folder(options.folder);
  std::vector<Band> sum = bands();
  for (int i = 0; i < options.worlds; ++i) {
    run_world(folder, options, options.seed + static_cast<unsigned>(i), sum);
  }
  std::printf("all worlds:\n");
  for (const Band& band : sum) band.print();
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app("Ranges of scenery from two stations' rendered panoramas.", "ols-bench-scenery");
  app.add_option("--land", options.folder, "Folder of ols-land import")->required();
  app.add_option("--worlds", options.worlds);
  app.add_option("--seed", options.seed, "Of the first world; the others follow");
  app.add_option("--draws", options.draws, "Of poses, for each world");
  app.add_option("--baseline", options.baseline_m, "Between the stations [m]");
  app.add_option("--focal", options.focal_px, "Focal length [px]");
  app.add_option("--heading-sd", options.heading_sd_deg, "1-sigma of headings [deg]");
  app.add_option("--tilt-sd", options.tilt_sd_deg, "1-sigma of each tilt [deg]");
  app.add_option("--position-sd", options.position_sd_m, "1-sigma of positions, each axis [m]");
  app.add_option("--pictures", options.pictures, "Folder for the panoramas");
  return bench::run_program(app, argc, argv, [&] { run(options); });
}
