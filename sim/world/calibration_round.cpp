#include "sim/world/calibration_round.h"

#include <erfa.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <random>
#include <sstream>
#include <stdexcept>
#include <vector>

#include "sim/world/unit_truth.h"

namespace ols::sim {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr std::uint64_t kRoundTag = 12000;
constexpr std::int64_t kUtime_us = 1'699'990'000'000'000;  // some hours before the scenario
constexpr double kEarth_m = 6371000.0;

// Where the unit stands: whole counts, reached from these sides.
struct Stop {
  std::int64_t pan = 0, tilt = 0;
  int side_pan = 1, side_tilt = 1;
};

class Round {
 public:
  Round(const World& world, std::size_t station)
      : station_(world.stations()[station]),
        count_rad_(radians(world.ptu_unit_config().resolution_arcsec / 3600.0)),
        mechanics_(station_.unit, count_rad_),
        generator_(derived_seed(world.seed(), kRoundTag + station)) {
    references_.precision(15);
    references_ << "landmark,latitude_deg,longitude_deg,height_m,sd_m,utime_us,ra_deg,dec_deg\n";
  }

  void see_stars();
  void see_landmarks();
  CalibrationRound take() const { return {observations_.str(), references_.str()}; }

 private:
  double normal(double sd) { return sd * normal_(generator_); }
  double within(double least, double greatest) {
    return std::uniform_real_distribution<double>(least, greatest)(generator_);
  }
  int side() { return within(0.0, 1.0) < 0.5 ? -1 : 1; }
  Stop stop_near(double pan_deg, double tilt_deg) {
    return {std::llround(radians(pan_deg) / count_rad_),
            std::llround(radians(tilt_deg) / count_rad_), side(), side()};
  }
  Eigen::Isometry3d camera_at(const Stop& stop) const {
    const PanTilt counted{static_cast<double>(stop.pan) * count_rad_,
                          static_cast<double>(stop.tilt) * count_rad_};
    return camera_on(station_.truth.chain, station_.unit.trunnion_rad,
                     mechanics_.shafts_from(counted, stop.side_pan, stop.side_tilt));
  }
  void note(const char* kind, const Stop& stop, const Vector2d& pixel, double sd_px,
            const std::string& reference, std::int64_t utime_us);
  void refer_star(const std::string& name, const Vector3d& ray_enu, std::int64_t utime_us);
  void refer_landmark(const std::string& name, const Vector3d& place_enu, double sd_m);
  void see_landmark(const std::string& name, const Vector3d& place_enu, double refraction_k);

  const StationTruth& station_;
  double count_rad_;
  UnitMechanics mechanics_;
  std::mt19937_64 generator_;
  std::normal_distribution<double> normal_;
  std::ostringstream observations_, references_;
  int pose_ = 0;
};

void Round::note(const char* kind, const Stop& stop, const Vector2d& pixel, double sd_px,
                 const std::string& reference, std::int64_t utime_us) {
  const double x_px = pixel.x() + normal(sd_px);
  const double y_px = pixel.y() + normal(sd_px);
  const nlohmann::ordered_json observation = {{"kind", kind},
                                              {"pose", pose_},
                                              {"utime_us", utime_us},
                                              {"pan_counts", stop.pan},
                                              {"tilt_counts", stop.tilt},
                                              {"approach_pan", stop.side_pan},
                                              {"approach_tilt", stop.side_tilt},
                                              {"x_px", x_px},
                                              {"y_px", y_px},
                                              {"sd_px", sd_px},
                                              {"reference", reference}};
  observations_ << observation.dump() << '\n';
}

// The star that appears there: ERFA's own inverse. The air is not quite what the barometer says.
void Round::refer_star(const std::string& name, const Vector3d& ray_enu, std::int64_t utime_us) {
  constexpr double kUnixEpoch_jd = 2440587.5, kDay_us = 86400e6;
  const double azimuth = std::atan2(ray_enu.x(), ray_enu.y());
  const double zenith = std::acos(std::clamp(ray_enu.normalized().z(), -1.0, 1.0));
  const Geodetic& place = station_.truth.position;
  double ra = 0.0, dec = 0.0;
  const int status =
      eraAtoc13("A", azimuth, zenith, kUnixEpoch_jd, static_cast<double>(utime_us) / kDay_us,
                kRoundUt1MinusUtc_s, place.longitude_rad, place.latitude_rad, place.height_m, 0.0,
                0.0, 1.003 * kRoundPressure_hPa, kRoundTemperature_degC, 0.5, 0.55, &ra, &dec);
  if (status < 0) throw std::logic_error("a star's instant is outside of the calendar");
  references_ << name << ",,,,,," << degrees(ra) << ',' << degrees(dec) << '\n';
}

void Round::see_stars() {
  constexpr int kFrames = 24, kStars = 12;
  constexpr double kStarSd_px = 0.3, kFrame_s = 3.0;
  const CameraIntrinsics& camera = station_.truth.camera;
  for (int frame = 0; frame < kFrames; ++frame) {
    ++pose_;
    // All around, low and high, in unequal steps: at equal ones the worm looks like an
    // eccentricity.
    const double pan_deg = -150.0 + 300.0 * frame / (kFrames - 1) + within(-6.0, 6.0);
    const double tilt_deg = frame % 2 == 0 ? within(13.0, 17.5) : within(26.0, 30.0);
    const Stop stop = stop_near(std::clamp(pan_deg, -156.0, 156.0), tilt_deg);
    const Eigen::Isometry3d pose = camera_at(stop);
    const auto utime_us = kUtime_us + std::llround(1e6 * kFrame_s * frame);
    for (int star = 0; star < kStars; ++star) {
      const Vector2d pixel(within(20.0, camera.width_px - 20.0),
                           within(20.0, camera.height_px - 20.0));
      const auto ray_cam = unproject(camera, pixel);
      if (!ray_cam) continue;
      const std::string name = "star" + std::to_string(frame) + "-" + std::to_string(star);
      refer_star(name, pose.linear() * *ray_cam, utime_us);
      note("star", stop, pixel, kStarSd_px, name, utime_us);
    }
  }
}

void Round::refer_landmark(const std::string& name, const Vector3d& place_enu, double sd_m) {
  Vector3d told_enu = place_enu;
  for (double& axis : told_enu) axis += normal(sd_m);
  const Geodetic told = geodetic_from_ecef(LocalFrame(station_.truth.position).to_ecef(told_enu));
  references_ << name << ',' << degrees(told.latitude_rad) << ',' << degrees(told.longitude_rad)
              << ',' << told.height_m << ',' << sd_m << ",,,\n";
}

void Round::see_landmark(const std::string& name, const Vector3d& place_enu, double refraction_k) {
  constexpr double kMarkSd_px = 0.5;
  const double distance_m = place_enu.norm();
  const Vector3d lifted =
      place_enu + Vector3d(0.0, 0.0, refraction_k * distance_m * distance_m / (2.0 * kEarth_m));
  // Roughly at it, as a person drives: by the configuration's own pose.
  const auto angles =
      aim_at(station_.nominal, LocalFrame(station_.truth.position).to_ecef(place_enu));
  if (!angles) return;
  ++pose_;
  const Stop stop = stop_near(degrees(angles->pan_rad), degrees(angles->tilt_rad));
  const Vector3d p_cam = camera_at(stop).inverse() * lifted;
  const auto pixel = project(station_.truth.camera, p_cam);
  if (!pixel) return;
  note("landmark", stop, *pixel, kMarkSd_px, name, kUtime_us + 1'000'000LL * pose_);
}

// Five surveyed by RTK, twice each from other sides; the last one has moved a metre since.
void Round::see_landmarks() {
  constexpr int kLandmarks = 5;
  constexpr double kRtkSd_m = 0.02, kMoved_m = 1.0;
  std::vector<std::pair<std::string, Vector3d>> places;
  for (int i = 0; i < kLandmarks; ++i) {
    const double azimuth = station_.nominal.chain.heading_rad + radians(-120.0 + 55.0 * i);
    const double distance_m = within(400.0, 1500.0);
    const Vector3d place(distance_m * std::sin(azimuth), distance_m * std::cos(azimuth),
                         distance_m * std::tan(radians(within(0.0, 6.0))));
    places.emplace_back("landmark" + std::to_string(i), place);
    refer_landmark(places.back().first, place, kRtkSd_m);
  }
  Vector3d& moved = places.back().second;
  moved += kMoved_m * Vector3d(moved.y(), -moved.x(), 0.0).normalized();
  const double refraction_k = 0.13 + normal(0.2);
  for (int again = 0; again < 2; ++again) {
    for (const auto& [name, place] : places) {
      see_landmark(name, place, refraction_k + normal(0.05));
    }
  }
}

}  // namespace

CalibrationRound calibration_round(const World& world, std::size_t station) {
  Round round(world, station);
  round.see_stars();
  round.see_landmarks();
  return round.take();
}

}  // namespace ols::sim
