// The skyline in rendered pictures, and the heading that a station finds by it, at many sites. A
// site is a place in an imported folder of land. What the camera sees is that land with an error
// field of the stated size added, and trees on its crests; what the station knows is the folder.
// For each site: a sweep with the right heading and one with a wrong one. With --pictures, many
// more pictures with the right heading, as of a week.
#include "edge/skyline/skyline_heading.h"

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <memory>
#include <opencv2/core.hpp>
#include <random>

#include "dev/bench/program.h"
#include "edge/skyline/expected_skyline.h"
#include "edge/skyline/seen_horizon.h"
#include "geometry/angles.h"
#include "land/terrain_folder.h"
#include "sim/world/panorama.h"
#include "sim/world/relief.h"

namespace {

using namespace ols;

// The land with errors: long waves and short ones.
class TrueLand : public land::Surface {
 public:
  TrueLand(const land::Surface& model, const Geodetic& centre, double length_m, unsigned seed)
      : model_(model),
        frame_(centre),
        long_(0.9, length_m, seed),
        short_(0.44, length_m / 4, seed + 1) {}

  std::optional<land::SurfaceHeight> ground(double latitude_rad,
                                            double longitude_rad) const override {
    auto known = model_.ground(latitude_rad, longitude_rad);
    constexpr double kSea_m = 61.0;  // above the ellipsoid there
    if (!known || known->height_m < kSea_m) return known;
    const Eigen::Vector2d at =
        frame_.to_enu(ecef_from_geodetic({latitude_rad, longitude_rad, 0.0})).head<2>();
    known->height_m += known->sd_m * (long_.at(at) + short_.at(at));
    known->sd_m = 0.0;
    return known;
  }
  std::optional<land::SurfaceHeight> top(double latitude_rad, double longitude_rad) const override {
    return ground(latitude_rad, longitude_rad);
  }

 private:
  const land::Surface& model_;
  LocalFrame frame_;
  sim::Waves long_, short_;
};

constexpr int kTrees = 2400;

struct Site {
  CameraIntrinsics camera;
  std::unique_ptr<land::HorizonMap> known, truth;
  std::unique_ptr<sim::Panorama> panorama;
  std::vector<double> trees_rad;  // around the horizon
  double place_sd_m = 0.0;
};

// Quicker than the usual one.
const land::HorizonMapConfig kMap{.columns = 3600, .reach_m = 20'000.0};

// Of 25 mm at pixels of 3.75 um.
CameraIntrinsics camera_of() {
  CameraIntrinsics camera;
  camera.fx_px = camera.fy_px = 25e-3 / 3.75e-6;
  return camera;
}

struct Options {
  std::string folder;
  int sites = 20, pictures = 0;
  double wrong_deg = 0.1, length_m = 600.0;
  unsigned seed = 1;
};

Site make_site(const land::TerrainFolder& folder, const Options& options, unsigned seed) {
  std::mt19937_64 generator(seed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  Site site;
  site.camera = camera_of();
  const double latitude_rad = radians(folder.manifest.latitude_deg);
  // A station stands where it sees far: on the highest of some places.
  Geodetic place;
  std::optional<land::SurfaceHeight> ground;
  for (int i = 0; i < 8; ++i) {
    constexpr double kWithin_rad = radians(0.12);
    const Geodetic other{latitude_rad + kWithin_rad * uniform(generator),
                         radians(folder.manifest.longitude_deg) + kWithin_rad * uniform(generator),
                         0.0};
    const auto there = folder.terrain->ground(other.latitude_rad, other.longitude_rad);
    if (!there || (ground && there->height_m < ground->height_m)) continue;
    ground = there;
    place = other;
  }
  const TrueLand truth(*folder.terrain, place, options.length_m, seed);
  place.height_m = truth.ground(place.latitude_rad, place.longitude_rad)->height_m + 5.0;
  site.place_sd_m = ground->sd_m;
  site.truth = std::make_unique<land::HorizonMap>(truth, place, kMap);
  site.known = std::make_unique<land::HorizonMap>(*folder.terrain, place, kMap);
  sim::Landscape landscape;
  landscape.ridge_mean_rad = radians(-30.0);
  landscape.ridge_relief_rad = 0.0;
  landscape.cloudiness = 1.0 + uniform(generator);
  landscape.haze = 0.4 + 0.4 * uniform(generator);
  landscape.seed = static_cast<int>(seed);
  site.panorama = std::make_unique<sim::Panorama>(
      landscape, site.camera, sim::slopes_texture(landscape, site.camera), seed);
  std::uniform_real_distribution<double> tree_m(0.0, 3.0);
  for (int i = 0; i < kTrees; ++i) {
    const auto skyline = site.truth->skyline(2.0 * kPi * i / kTrees);
    const bool wooded = skyline && skyline->distance_m > 1000.0 && skyline->distance_m < 15'000.0;
    site.trees_rad.push_back(wooded ? tree_m(generator) / skyline->distance_m : 0.0);
  }
  site.panorama->raise([&](double azimuth_rad) {
    const auto skyline = site.truth->skyline(azimuth_rad);
    const auto tree = static_cast<std::size_t>(wrap_two_pi(azimuth_rad) / (2.0 * kPi) * kTrees);
    return (skyline ? skyline->elevation_rad : -0.5) + site.trees_rad[tree % kTrees];
  });
  return site;
}

Eigen::Matrix3d R_enu_cam(double azimuth_rad, double elevation_rad) {
  const Eigen::Vector3d forward = enu_from_azimuth_elevation({azimuth_rad, elevation_rad});
  const Eigen::Vector3d right(std::cos(azimuth_rad), -std::sin(azimuth_rad), 0.0);
  Eigen::Matrix3d R;
  R << right, forward.cross(right), forward;
  return R;
}

struct Tally {
  int strips = 0, found = 0, far = 0;
  double off2_px2 = 0.0;
};

std::vector<double> true_rows(const Site& site, const skyline::PictureView& view) {
  std::vector<double> rows;
  for (int strip = 0; strip < skyline::strips_of(view.camera.width_px); ++strip) {
    double y_px = view.camera.cy_px;
    for (int i = 0; i < 6; ++i) {
      const auto ray = unproject(view.camera, {skyline::strip_x_px(strip), y_px});
      const auto at = azimuth_elevation_from_enu(view.R_enu_cam * *ray);
      y_px += (at.elevation_rad - site.panorama->ridge_rad(at.azimuth_rad)) * view.camera.fy_px;
    }
    rows.push_back(y_px);
  }
  return rows;
}

// Only strips that show the skyline count; errors are across the skyline, which may be steep.
void score(const skyline::Rows& found, const std::vector<double>& rows, Tally& tally) {
  for (std::size_t i = 4; i + 4 < rows.size(); ++i) {
    if (rows[i] < 20.0 || rows[i] > 940.0) continue;
    ++tally.strips;
    if (!found[i]) continue;
    ++tally.found;
    const double slope = (rows[i + 4] - rows[i - 4]) / (8 * skyline::kStrip_px);
    const double off_px = (found[i]->at_px - rows[i]) / std::hypot(1.0, slope);
    tally.off2_px2 += off_px * off_px;
    if (std::abs(off_px) > 5.0) ++tally.far;
  }
}

// One picture, in a direction that the station takes for another by `wrong_rad`.
void look(Site& site, double azimuth_rad, double wrong_rad, std::mt19937_64& generator,
          skyline::SeenHorizon& seen, Tally& tally) {
  const auto at = site.truth->skyline(azimuth_rad);
  const double elevation_rad = at ? at->elevation_rad : 0.0;
  cv::Mat gray, noise(site.camera.height_px, site.camera.width_px, CV_16S), noisy;
  site.panorama->draw(R_enu_cam(azimuth_rad, elevation_rad), gray);
  cv::theRNG().state = generator();
  cv::randn(noise, 0.0, 2.0);
  gray.convertTo(noisy, CV_16S);
  noisy += noise;
  noisy.convertTo(gray, CV_8U);
  const skyline::PictureView believed{R_enu_cam(azimuth_rad + wrong_rad, elevation_rad),
                                      site.camera};
  const skyline::PictureView actual{R_enu_cam(azimuth_rad, elevation_rad), site.camera};
  const auto found = skyline::find_skyline(gray, skyline::expected_rows(*site.known, believed));
  score(found, true_rows(site, actual), tally);
  seen.add(skyline::directions(found, believed));
}

skyline::SkylineHeading sweep(Site& site, double wrong_rad, std::mt19937_64& generator,
                              skyline::SeenHorizon& seen, Tally& tally) {
  for (int i = 0; i < 36; ++i) look(site, radians(10.0 * i), wrong_rad, generator, seen, tally);
  return skyline::skyline_heading(seen.places(), *site.known, site.place_sd_m)
      .value_or(skyline::SkylineHeading{0.0, 9.9});
}

void print(const char* what, const skyline::SkylineHeading& heading) {
  std::printf("  %s %+.4f +- %.4f (%.1f)", what, degrees(heading.error_rad),
              degrees(heading.sd_rad), heading.error_rad / heading.sd_rad);
}

// The largest error of the heading, over its sigma, while more pictures with the right heading are
// added.
double worst_of_more(Site& site, int pictures, std::mt19937_64& generator,
                     skyline::SeenHorizon& seen, Tally& tally) {
  std::uniform_real_distribution<double> azimuth_rad(0.0, 2.0 * kPi);
  double worst = 0.0;
  for (int picture = 0; picture < pictures; ++picture) {
    look(site, azimuth_rad(generator), 0.0, generator, seen, tally);
    if (picture % 10 != 0) continue;
    const auto heading = skyline::skyline_heading(seen.places(), *site.known, site.place_sd_m);
    if (heading) worst = std::max(worst, std::abs(heading->error_rad / heading->sd_rad));
  }
  return worst;
}

void run(const Options& options) {
  const land::TerrainFolder folder = land::read_terrain_folder(options.folder);
  Tally tally;
  double nees = 0.0;
  for (int i = 0; i < options.sites; ++i) {
    const unsigned seed = options.seed * 1000 + static_cast<unsigned>(i);
    Site site = make_site(folder, options, seed);
    std::mt19937_64 generator(seed);
    skyline::SeenHorizon wrong, right;
    std::printf("site %d:", i);
    print("wrong", sweep(site, radians(options.wrong_deg), generator, wrong, tally));
    const auto with_right = sweep(site, 0.0, generator, right, tally);
    print("right", with_right);
    nees += std::pow(with_right.error_rad / with_right.sd_rad, 2) / options.sites;
    if (options.pictures > 0) {
      std::printf("  worst of all %.1f",
                  worst_of_more(site, options.pictures, generator, right, tally));
    }
    std::printf("  (%.3f found, %.4f of them far off, %.2f px)\n",
                static_cast<double>(tally.found) / tally.strips,
                static_cast<double>(tally.far) / tally.found,
                std::sqrt(tally.off2_px2 / tally.found));
    std::fflush(stdout);
  }
  std::printf("NEES of the right headings %.2f\n", nees);
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app("Headings by the skyline in rendered pictures.", "ols-bench-skyline");
  app.add_option("--land", options.folder, "Folder of ols-land import")->required();
  app.add_option("--sites", options.sites);
  app.add_option("--wrong", options.wrong_deg, "Error of the wrong heading [deg]");
  app.add_option("--length", options.length_m, "Wavelength of the land's errors [m]");
  app.add_option("--pictures", options.pictures, "More pictures at each site");
  app.add_option("--seed", options.seed);
  return bench::run_program(app, argc, argv, [&] { run(options); });
}
