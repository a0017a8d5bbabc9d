#include "edge/skyline/skyline_watch.h"

#include <cmath>
#include <exception>
#include <utility>

#include "conditions/alarms.h"
#include "edge/skyline/seen_crest.h"
#include "geometry/angles.h"

namespace ols::skyline {
namespace {

constexpr double kBegins = 4.0, kEnds = 3.0;  // sigmas
constexpr double kUnder = 3.0;                // sigmas, as HorizonMap has it

double mean_azimuth_sd_rad(const std::vector<SeenPlace>& places) {
  if (places.empty()) return 0.0;
  double sum_rad2 = 0.0;
  for (const SeenPlace& place : places) sum_rad2 += place.azimuth_variance_rad2;
  return std::sqrt(sum_rad2 / static_cast<double>(places.size()));
}

}  // namespace

// At a start, before anything is seen, a change of the setup says nothing of an earlier skyline.
void SkylineWatch::forget() {
  if (!hiding_.crests.empty()) earlier_.reset();
  clear();
}

void SkylineWatch::clear() {
  seen_.clear();
  obstacles_.clear();
  hiding_ = {};
  disagreed_s_.clear();
  heading_.reset();
  height_.reset();
  disagrees_ = height_disagrees_ = false;
}

// Below the ground by more than the map takes, but by no more than the station may err in its
// height: there the map is made for a camera on the ground.
Geodetic SkylineWatch::camera_of_map(const Geodetic& stated, double height_sd_m) const {
  const auto ground = surface_->ground(stated.latitude_rad, stated.longitude_rad);
  if (!ground) return stated;
  const double under_m = ground->height_m - stated.height_m;
  if (under_m < kUnder * ground->sd_m || under_m > kUnder * std::hypot(ground->sd_m, height_sd_m)) {
    return stated;
  }
  Geodetic on_ground = stated;
  on_ground.height_m = ground->height_m;
  return on_ground;
}

bool SkylineWatch::has_map(const StatedPicture& picture) {
  const Eigen::Vector3d& centre_ecef = picture.camera.centre_ecef;
  const double same_m = map_ ? kMoved_m : kAgain_m;
  if (place_ecef_ && (*place_ecef_ - centre_ecef).norm() <= same_m) return map_.has_value();
  clear();
  resume_earlier(picture);
  place_ecef_ = centre_ecef;
  map_.reset();
  why_none_.clear();
  try {
    const Geodetic camera =
        camera_of_map(geodetic_from_ecef(centre_ecef), picture.position_sd_enu_m.z());
    map_.emplace(*surface_, camera, config_);
    model_sd_m_ = surface_->ground(camera.latitude_rad, camera.longitude_rad)->sd_m;
  } catch (const std::exception& reason) {
    why_none_ = reason.what();
  }
  return map_.has_value();
}

// A first fix may have been wrong: the earlier one waits until the station knows its place.
void SkylineWatch::resume_earlier(const StatedPicture& picture) {
  if (!earlier_ || (earlier_->camera_ecef - picture.camera.centre_ecef).norm() > kMoved_m) return;
  hiding_ = *std::exchange(earlier_, std::nullopt);
  for (int sector = 0; sector < land::SeenSkyline::kSectors; ++sector) {
    for (const auto& [column, crest] : hiding_.crests.sector(sector)) {
      if (crest.disagrees) disagreed_s_[column] = picture.mid_exposure_s;
    }
  }
}

// Of the camera in the map: what the station states of its position, the model as a whole, and the
// way from the map's camera.
Eigen::Vector3d SkylineWatch::place_sd_enu_m(const StatedPicture& picture) const {
  const Eigen::Vector3d off_m = LocalFrame(map_->camera()).to_enu(picture.camera.centre_ecef);
  return (picture.position_sd_enu_m.array().square() + off_m.array().square() +
          model_sd_m_ * model_sd_m_)
      .sqrt();
}

void SkylineWatch::look(const StatedPicture& picture) {
  if (!has_map(picture)) return;
  const LocalFrame frame(map_->camera());
  const PictureView view{(picture.camera.R_camera_ecef * frame.R_ecef_enu()).transpose(),
                         picture.camera.intrinsics, picture.azimuth_sd_rad,
                         picture.elevation_sd_rad};
  const Rows expected = expected_rows(*map_, view);
  const Rows found = find_skyline(picture.gray, expected);
  seen_.add(directions(found, view), picture.mid_exposure_s, picture.azimuth_sd_rad);
  compare(picture);
  note_obstacles(picture, view, expected);
}

void SkylineWatch::note_obstacles(const StatedPicture& picture, const PictureView& view,
                                  const Rows& expected) {
  const Rows found = find_skyline(picture.gray, widely_expected(expected, view));
  obstacles_.add(directions(found, view), picture.mid_exposure_s, picture.azimuth_sd_rad);
  for (const SeenPlace& place : obstacles_.places()) {
    if (place.newest_s < picture.mid_exposure_s) continue;
    const auto crest = seen_crest(place, picture.elevation_sd_rad, *map_);
    if (crest) take(place, *crest, picture);
  }
  remove_old(picture.mid_exposure_s);
  compare_height(picture);
}

// Heights above another zero than the land's folder says shift the whole skyline by tens of metres,
// farther than compare() searches.
void SkylineWatch::compare_height(const StatedPicture& newest) {
  constexpr double kUnknown_m = 200.0;
  StationSd sd{std::hypot(kHeadingSd_rad, newest.azimuth_sd_rad),
               std::hypot(kTiltSd_rad, newest.elevation_sd_rad), place_sd_enu_m(newest)};
  stated_height_sd_m_ = std::exchange(sd.place_enu_m.z(), kUnknown_m);
  height_ = skyline_heading(obstacles_.places(), *map_, sd);
  const double limit = height_disagrees_ ? kEnds : kBegins;
  height_disagrees_ = height_ && std::abs(height_->higher_m) >
                                     limit * std::hypot(height_->higher_sd_m, stated_height_sd_m_);
}

void SkylineWatch::take(const SeenPlace& place, const land::SeenCrest& crest,
                        const StatedPicture& picture) {
  const int column = land::SeenSkyline::column_of(place.direction.azimuth_rad);
  if (crest.disagrees) {
    if (place.pictures < kPictures || place.newest_s - place.oldest_s < kApart_s) return;
    disagreed_s_[column] = place.newest_s;
  } else {
    disagreed_s_.erase(column);
  }
  if (hiding_.crests.empty()) {
    hiding_.begun_us = picture.utime_us;
    hiding_.camera_ecef = picture.camera.centre_ecef;
  }
  hiding_.crests.set(column, crest);
}

void SkylineWatch::remove_old(double now_s) {
  std::erase_if(disagreed_s_, [&](const auto& column) {
    const bool is_old = now_s - column.second > kKept_s;
    if (is_old) hiding_.crests.remove(column.first);
    return is_old;
  });
}

void SkylineWatch::compare(const StatedPicture& newest) {
  const auto places = seen_.places();
  stated_sd_rad_ = mean_azimuth_sd_rad(places);
  heading_ =
      skyline_heading(places, *map_,
                      {std::hypot(kHeadingSd_rad, stated_sd_rad_),
                       std::hypot(kTiltSd_rad, newest.elevation_sd_rad), place_sd_enu_m(newest)});
  const double limit = disagrees_ ? kEnds : kBegins;
  disagrees_ = heading_ && std::abs(heading_->error_rad) > limit * difference_sd_rad();
}

double SkylineWatch::difference_sd_rad() const {
  return heading_ ? std::hypot(heading_->sd_rad, stated_sd_rad_) : 0.0;
}

Alarm SkylineWatch::alarm() const {
  if (!why_none_.empty()) return alarm::skyline_not_compared(why_none_);
  if (disagrees_) {
    return alarm::heading_disagrees_with_skyline(degrees(heading_->error_rad),
                                                 degrees(difference_sd_rad()));
  }
  if (!height_disagrees_) return {};
  return alarm::land_height_disagrees(-height_->higher_m, height_->higher_sd_m);
}

}  // namespace ols::skyline
