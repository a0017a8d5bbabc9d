// The heading of a station and the skyline of the land, at many sites, as the station compares them
// (SkylineWatch). A site is a place in an imported folder of land. What the camera sees is that
// land with errors of the size and the length that the station assumes, and trees on its crests;
// what the station knows is the folder. Its position and heading have the errors that it states.
//
// At each site: a round with the heading wrong by --wrong, whether that is noticed, and how well
// the heading is found; then --days with the right heading, each under another sky, with --rounds
// of 36 pictures. Then the skyline that it has seen is compared with the true one, with --obstacles
// (masts, houses, trees) that the folder does not have.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <opencv2/core.hpp>
#include <random>
#include <vector>

#include "dev/bench/drawn_skyline.h"
#include "dev/bench/program.h"
#include "dev/bench/true_land.h"
#include "edge/skyline/expected_skyline.h"
#include "edge/skyline/skyline_watch.h"
#include "geometry/angles.h"
#include "geometry/direction.h"
#include "land/column_march.h"
#include "land/terrain_folder.h"
#include "sim/world/panorama.h"

namespace {

using namespace ols;

constexpr int kTrees = 2400, kRound = 36;
constexpr double kInterval_s = 5.0;  // from picture to picture

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
  int sites = 20, days = 0, rounds = 4, obstacles = 0;
  double wrong_deg = 0.1, heading_sd_deg = 0.01, position_sd_m = 0.5;
  double length_m = land::kLowered_m;
  unsigned seed = 1;
};

struct Obstacle {
  double azimuth_rad = 0.0, width_rad = 0.0;
  double high_rad = 0.0;  // above the skyline
};

struct Site {
  CameraIntrinsics camera;
  Geodetic stated;  // the camera's position, with its error
  std::unique_ptr<land::HorizonMap> known, truth;
  std::vector<double> trees_rad;  // around the horizon
  std::vector<Obstacle> obstacles;
  std::mt19937_64 generator;

  double obstacle_rad(double azimuth_rad) const {
    double high_rad = 0.0;
    for (const Obstacle& one : obstacles) {
      const bool is_there = std::abs(wrap_pi(azimuth_rad - one.azimuth_rad)) < 0.5 * one.width_rad;
      if (is_there) high_rad = std::max(high_rad, one.high_rad);
    }
    return high_rad;
  }
  std::optional<double> skyline_rad(double azimuth_rad) const {
    const auto skyline = truth->skyline(azimuth_rad);
    if (!skyline) return std::nullopt;
    const auto tree = static_cast<std::size_t>(wrap_two_pi(azimuth_rad) / (2.0 * kPi) * kTrees);
    return skyline->elevation_rad + std::max(trees_rad[tree % kTrees], obstacle_rad(azimuth_rad));
  }
};

// A station stands where it sees far: on the highest of some places.
Geodetic place_of(const land::TerrainFolder& folder, std::mt19937_64& generator) {
  constexpr double kWithin_rad = radians(0.12);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  Geodetic place;
  std::optional<land::SurfaceHeight> ground;
  for (int i = 0; i < 8; ++i) {
    const double latitude_rad =
        radians(folder.manifest.latitude_deg) + kWithin_rad * uniform(generator);
    const double longitude_rad =
        radians(folder.manifest.longitude_deg) + kWithin_rad * uniform(generator);
    const auto there = folder.terrain->ground(latitude_rad, longitude_rad);
    if (!there || (ground && there->height_m < ground->height_m)) continue;
    ground = there;
    place = {latitude_rad, longitude_rad, 0.0};
  }
  return place;
}

Site make_site(const land::TerrainFolder& folder, const Options& options, unsigned seed) {
  Site site;
  site.generator.seed(seed);
  site.camera = camera_of();
  Geodetic place = place_of(folder, site.generator);
  const bench::TrueLand truth(*folder.terrain, place, 1.0, options.length_m, seed);
  place.height_m = truth.ground(place.latitude_rad, place.longitude_rad)->height_m + 5.0;
  std::normal_distribution<double> normal(0.0, options.position_sd_m);
  const Eigen::Vector3d off_m(normal(site.generator), normal(site.generator),
                              normal(site.generator));
  site.stated = geodetic_from_ecef(LocalFrame(place).to_ecef(off_m));
  site.truth = std::make_unique<land::HorizonMap>(truth, place, kMap);
  site.known = std::make_unique<land::HorizonMap>(*folder.terrain, site.stated, kMap);
  std::uniform_real_distribution<double> tree_m(0.0, 3.0);
  for (int i = 0; i < kTrees; ++i) {
    const auto skyline = site.truth->skyline(2.0 * kPi * i / kTrees);
    const bool wooded = skyline && skyline->distance_m > 1000.0 && skyline->distance_m < 15'000.0;
    site.trees_rad.push_back(wooded ? tree_m(site.generator) / skyline->distance_m : 0.0);
  }
  std::mt19937_64 generator(seed);  // its own: the rest stays as it is without obstacles
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  for (int i = 0; i < options.obstacles; ++i) {
    site.obstacles.push_back({2.0 * kPi * (i + 0.8 * uniform(generator)) / options.obstacles,
                              radians(0.15 + 2.0 * std::pow(uniform(generator), 2)),
                              radians(0.3 + 1.2 * uniform(generator))});
  }
  return site;
}

// Each under its own sky.
std::unique_ptr<sim::Panorama> panorama_of(Site& site, unsigned seed) {
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  sim::Landscape landscape;
  landscape.ridge_mean_rad = radians(-30.0);
  landscape.ridge_relief_rad = 0.0;
  landscape.cloudiness = 1.0 + uniform(site.generator);
  landscape.haze = 0.4 + 0.4 * uniform(site.generator);
  landscape.seed = static_cast<int>(seed);
  auto panorama = std::make_unique<sim::Panorama>(
      landscape, site.camera, sim::slopes_texture(landscape, site.camera), seed);
  panorama->raise(
      [&site](double azimuth_rad) { return site.skyline_rad(azimuth_rad).value_or(-0.5); });
  return panorama;
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

// A station at a site, whose heading is off by `wrong_rad`.
class Watcher {
 public:
  Watcher(Site& site, const land::TerrainFolder& folder, const Options& options, double wrong_rad)
      : site_(site),
        options_(options),
        wrong_rad_(wrong_rad),
        R_ecef_enu_(LocalFrame(site.stated).R_ecef_enu()),
        watch_(folder.terrain, kMap) {}

  void look(sim::Panorama& panorama, double azimuth_rad) {
    const auto at = site_.truth->skyline(azimuth_rad);
    const double elevation_rad = at ? at->elevation_rad : 0.0;
    skyline::StatedPicture picture;
    picture.mid_exposure_s = time_s_ += kInterval_s;
    picture.gray = noisy_picture(panorama, azimuth_rad, elevation_rad);
    const Eigen::Matrix3d R_believed = R_enu_cam(azimuth_rad + wrong_rad_, elevation_rad);
    picture.camera = {ecef_from_geodetic(site_.stated), (R_ecef_enu_ * R_believed).transpose(),
                      site_.camera};
    picture.azimuth_sd_rad = radians(options_.heading_sd_deg);
    picture.position_sd_enu_m.setConstant(options_.position_sd_m);
    watch_.look(picture);
    const skyline::PictureView view{R_believed, site_.camera, picture.azimuth_sd_rad, 0.0};
    const auto rows = bench::drawn_rows(panorama);
    score(skyline::find_skyline(picture.gray, skyline::expected_rows(*site_.known, view)), rows,
          tally_);
    alarms_ += watch_.disagrees() && !disagreed_ ? 1 : 0;
    disagreed_ = watch_.disagrees();
    if (!watch_.heading()) return;
    worst_ = std::max(worst_, std::abs(sigmas()));
  }
  void round(sim::Panorama& panorama, double from_rad) {
    for (int i = 0; i < kRound; ++i) look(panorama, from_rad + 2.0 * kPi * i / kRound);
  }
  // So long that all is forgotten.
  void pause(double seconds) { time_s_ += seconds; }

  // The difference of the headings, over its 1-sigma.
  double sigmas() const { return watch_.heading()->error_rad / watch_.difference_sd_rad(); }
  const skyline::SkylineWatch& watch() const { return watch_; }
  const Tally& tally() const { return tally_; }
  int alarms() const { return alarms_; }  // that have begun
  double worst() const { return worst_; }

 private:
  cv::Mat noisy_picture(sim::Panorama& panorama, double azimuth_rad, double elevation_rad) {
    cv::Mat gray, noise(site_.camera.height_px, site_.camera.width_px, CV_16S), noisy;
    panorama.draw(R_enu_cam(azimuth_rad, elevation_rad), gray);
    cv::theRNG().state = site_.generator();
    cv::randn(noise, 0.0, 2.0);
    gray.convertTo(noisy, CV_16S);
    noisy += noise;
    noisy.convertTo(gray, CV_8U);
    return gray;
  }

  Site& site_;
  const Options& options_;
  double wrong_rad_, time_s_ = 0.0;
  Eigen::Matrix3d R_ecef_enu_;
  skyline::SkylineWatch watch_;
  Tally tally_;
  bool disagreed_ = false;
  int alarms_ = 0;
  double worst_ = 0.0;
};

// What is seen of the skyline, beside the true one.
struct SeenTally {
  int known = 0, seen = 0, raised = 0, wrongly_raised = 0;  // columns
  int obstacles = 0, found = 0;
  // Of the columns that agree with the map: errors, and what is told of them.
  std::vector<double> errors_rad, sds_rad;

  void add(const SeenTally& other) {
    known += other.known;
    seen += other.seen;
    raised += other.raised;
    wrongly_raised += other.wrongly_raised;
    obstacles += other.obstacles;
    found += other.found;
    errors_rad.insert(errors_rad.end(), other.errors_rad.begin(), other.errors_rad.end());
    sds_rad.insert(sds_rad.end(), other.sds_rad.begin(), other.sds_rad.end());
  }
  void print() const {
    std::printf(
        "seen %.3f of the columns; raised %d, wrongly by more than 0.1 deg %d; error of the others "
        "(median) %.4f deg, 1-sigma told %.4f; obstacles found %d of %d\n",
        static_cast<double>(seen) / known, raised, wrongly_raised, degrees(median(errors_rad)),
        degrees(median(sds_rad)), found, obstacles);
  }
  static double median(std::vector<double> values) {
    if (values.empty()) return 0.0;
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::ranges::nth_element(values, middle);
    return *middle;
  }
};

SeenTally tally_of(const Site& site, const land::SeenSkyline& skyline) {
  constexpr double kFar_rad = radians(0.1);
  SeenTally tally;
  for (int column = 0; column < land::SeenSkyline::kColumns; ++column) {
    const double azimuth_rad = land::SeenSkyline::azimuth_rad(column);
    const auto truth_rad = site.skyline_rad(azimuth_rad);
    if (!truth_rad) continue;
    ++tally.known;
    const auto crest = skyline.at(azimuth_rad);
    if (!crest) continue;
    ++tally.seen;
    const double off_rad = crest->elevation_rad - *truth_rad;
    if (crest->disagrees && crest->hides_from_m > 0.0) {
      ++tally.raised;
      tally.wrongly_raised += off_rad > kFar_rad ? 1 : 0;
    } else if (!crest->disagrees) {
      tally.errors_rad.push_back(std::abs(off_rad));
      tally.sds_rad.push_back(crest->sd_rad);
    }
  }
  for (const Obstacle& one : site.obstacles) {
    const auto truth_rad = site.skyline_rad(one.azimuth_rad);
    const auto crest = skyline.at(one.azimuth_rad);
    ++tally.obstacles;
    const bool is_found = truth_rad && crest && crest->hides_from_m > 0.0 &&
                          std::abs(crest->elevation_rad - *truth_rad) < kFar_rad;
    tally.found += is_found ? 1 : 0;
  }
  return tally;
}

struct Sum {
  SeenTally seen;
  int sites = 0, noticed = 0, unfounded = 0;
  double nees = 0.0;
};

void run_site(const land::TerrainFolder& folder, const Options& options, unsigned seed, Sum& sum) {
  Site site = make_site(folder, options, seed);
  auto panorama = panorama_of(site, seed);
  std::normal_distribution<double> normal(0.0, radians(options.heading_sd_deg));
  const double own_rad = normal(site.generator);
  Watcher wrong(site, folder, options, radians(options.wrong_deg));
  wrong.round(*panorama, 0.0);
  Watcher right(site, folder, options, own_rad);
  right.round(*panorama, 0.0);
  if (!wrong.watch().heading() || !right.watch().heading()) {
    std::printf("  too little of the skyline\n");
    return;
  }
  ++sum.sites;
  sum.noticed += wrong.watch().disagrees() ? 1 : 0;
  const auto& found = *right.watch().heading();
  sum.nees += std::pow((found.error_rad - own_rad) / found.sd_rad, 2);
  std::printf("  wrong %+.3f (%.1f sigmas) %s; right off by %+.4f +- %.4f",
              degrees(wrong.watch().heading()->error_rad), wrong.sigmas(),
              wrong.watch().disagrees() ? "noticed" : "not noticed",
              degrees(found.error_rad - own_rad), degrees(found.sd_rad));
  if (const auto& height = right.watch().height()) {
    std::printf("; height off by %+.1f +- %.1f m", height->higher_m, height->higher_sd_m);
  }
  if (!right.watch().disagrees() && !right.watch().alarm().empty()) {
    std::printf(": %s", right.watch().alarm().text.c_str());
  }
  // An obstacle counts only after several pictures.
  for (int seen = 1; options.obstacles > 0 && seen < skyline::SkylineWatch::kPictures; ++seen) {
    right.round(*panorama, 0.0);
  }
  for (int day = 0; day < options.days; ++day) {
    if (day > 0) panorama = panorama_of(site, seed + 1000 * static_cast<unsigned>(day));
    for (int round = 0; round < options.rounds; ++round) {
      right.pause(86400.0 / options.rounds - kRound * kInterval_s);
      right.round(*panorama, 0.1 * round);
    }
  }
  sum.unfounded += right.alarms();
  const SeenTally seen = tally_of(site, right.watch().hiding().crests);
  sum.seen.add(seen);
  const Tally& tally = right.tally();
  std::printf("; alarms %d, worst %.1f sigmas (%.3f found, %.4f of them far off, %.2f px)\n",
              right.alarms(), right.worst(), static_cast<double>(tally.found) / tally.strips,
              static_cast<double>(tally.far) / tally.found,
              std::sqrt(tally.off2_px2 / tally.found));
  std::printf("    ");
  seen.print();
}

void run(const Options& options) {
  const land::TerrainFolder folder = land::read_terrain_folder(options.folder);
  Sum sum;
  for (int i = 0; i < options.sites; ++i) {
    const unsigned seed = options.seed * 1000 + static_cast<unsigned>(i);
    std::printf("site %d (seed %u):", i, seed);
    run_site(folder, options, seed, sum);
    std::fflush(stdout);
  }
  std::printf("noticed %d of %d; alarms with the right heading: %d in %d days each; NEES %.2f\n",
              sum.noticed, sum.sites, sum.unfounded, options.days, sum.nees / sum.sites);
  sum.seen.print();
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app("Headings by the skyline in rendered pictures.", "ols-bench-skyline");
  app.add_option("--land", options.folder, "Folder of ols-land import")->required();
  app.add_option("--sites", options.sites);
  app.add_option("--wrong", options.wrong_deg, "Error of the wrong heading [deg]");
  app.add_option("--heading-sd", options.heading_sd_deg, "1-sigma of headings, as stated [deg]");
  app.add_option("--position-sd", options.position_sd_m, "The same of positions, each axis [m]");
  app.add_option("--length", options.length_m, "Over which the land's errors are alike [m]");
  app.add_option("--days", options.days, "With the right heading, at each site");
  app.add_option("--rounds", options.rounds, "Of 36 pictures, a day");
  app.add_option("--obstacles", options.obstacles, "That the folder does not have, at each site");
  app.add_option("--seed", options.seed);
  return bench::run_program(app, argc, argv, [&] { run(options); });
}
