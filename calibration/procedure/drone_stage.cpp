#include "calibration/procedure/drone_stage.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "calibration/pictures/landmark_snap.h"
#include "calibration/procedure/learned_heading.h"
#include "calibration/trajectory.h"
#include "conditions/printed.h"
#include "geometry/angles.h"

namespace ols::calibration {
namespace {

constexpr auto kStale_us = static_cast<std::int64_t>(1e6 * kLongestGap_s);
constexpr double kSnap_px = 8.0;   // around where the last sighting puts it
constexpr double kFloor_px = 0.1;  // a drone is no point

std::string where(double azimuth_deg, double elevation_deg) {
  return printed("azimuth %.0f deg, elevation %.0f deg", azimuth_deg, elevation_deg);
}

}  // namespace

std::optional<Eigen::Vector3d> position_at(const Trajectory& trajectory, std::int64_t utime_us,
                                           std::int64_t beyond_us) {
  const auto& points = trajectory.points;
  if (points.empty() || utime_us < points.front().utime_us) return std::nullopt;
  if (utime_us >= points.back().utime_us) {
    if (utime_us > points.back().utime_us + beyond_us) return std::nullopt;
    return points.back().ecef;
  }
  const Motion motion = motion_at(trajectory, static_cast<double>(utime_us));
  if (motion.gap_s > kLongestGap_s) return std::nullopt;
  return motion.ecef;
}

DroneStage::DroneStage(const StationModel& model, DroneOptions options, Positions positions,
                       SunKeepOut::UtcNow now, MayGo may_go, Adviser adviser)
    : model_(model),
      options_(std::move(options)),
      positions_(std::move(positions)),
      now_(std::move(now)),
      may_go_(std::move(may_go)),
      adviser_(std::move(adviser)) {}

// Around the station, near the horizon and high: places that the unit can look at.
std::vector<Place> DroneStage::places() const {
  constexpr double kDistance_m = 200.0;
  const LocalFrame ground(model_.geometry.position);
  const double sd_m = positions_().sd_m;
  std::vector<Place> places;
  for (const double elevation_deg : {3.0, 15.0, 26.0}) {
    for (int azimuth_deg = 0; azimuth_deg < 360; azimuth_deg += 45) {
      const AzimuthElevation there{radians(azimuth_deg), radians(elevation_deg)};
      const Eigen::Vector3d ecef = ground.to_ecef(kDistance_m * enu_from_azimuth_elevation(there));
      const auto angles = aim_at(model_.geometry, ecef);
      if (!angles || !may_go_(*angles)) continue;
      places.push_back({where(azimuth_deg, elevation_deg), ecef, sd_m});
    }
  }
  return places;
}

std::string DroneStage::advice() const {
  if (!adviser_ || observations_.empty()) return {};
  return in_words(adviser_(model_, places()));
}

void DroneStage::ask(const std::string& trouble) {
  const std::string helps = advice();
  question_ = {};
  question_.text = (trouble.empty() ? "" : trouble + ". ") + "Point " +
                   std::to_string(observations_.size() + 1) + " of " +
                   std::to_string(options_.points) + ": let " + options_.name +
                   " hover, then answer sight." + (helps.empty() ? "" : " Most helps: " + helps);
  question_.choices = {"sight", "done"};
}

std::optional<Order> DroneStage::next() {
  if (done_) return std::nullopt;
  if (picture_) judge();
  if (done_) return std::nullopt;
  if (dialog_.question()) return dialog_.question();
  Order order;
  order.step = options_.name + ", point " + std::to_string(observations_.size() + 1);
  if (picture_) {
    order.kind = Order::Kind::kWait;
    return order;
  }
  if (shot_) {
    order.shot = *shot_;
    return order;
  }
  if (question_.choices.empty()) ask("");
  order.kind = Order::Kind::kAsk;
  order.question = question_;
  return order;
}

void DroneStage::sight(std::int64_t now_us) {
  const Trajectory trajectory = positions_();
  const auto place = position_at(trajectory, now_us, kStale_us);
  if (!place) {
    return ask(trajectory.points.empty()
                   ? "No position of it is known"
                   : "Its last position is " +
                         std::to_string((now_us - trajectory.points.back().utime_us) / 1'000'000) +
                         " s old");
  }
  const auto angles = aim_at(model_.geometry, *place);
  Shot shot;
  if (angles)
    shot.angles = {angles->pan_rad + turned_.pan_rad, angles->tilt_rad + turned_.tilt_rad};
  if (!angles || !may_go_(shot.angles)) return ask("The unit cannot look there");
  shot.approach_pan = shot.approach_tilt = observations_.size() % 2 == 0 ? 1 : -1;
  shot_ = shot;
}

void DroneStage::taken(const Taken& picture) {
  shot_.reset();
  picture_ = picture;
}

// A position comes later than the picture of its instant, and only one beyond it makes it known.
void DroneStage::judge() {
  const Trajectory trajectory = positions_();
  const auto place = position_at(trajectory, picture_->utime_us, 0);
  if (!place && now_() < picture_->utime_us + kStale_us) return;
  const Taken picture = *std::exchange(picture_, std::nullopt);
  if (!place) return ask("Its positions have ended before the picture");
  const auto seen = view(model_.geometry, corrected_angles(model_, picture.reading), *place);
  if (!seen) return ask("It has left the picture");
  if (beside_px_) {
    const Snap snap = snap_to_structure(picture.gray, seen->pixel + *beside_px_, kSnap_px);
    if (snap) return confirm(picture, snap.centre_px, std::max(kFloor_px, snap.sd_px));
  }
  dialog_.begin(options_.name, picture);
}

void DroneStage::confirm(const Taken& picture, const Eigen::Vector2d& pixel, double sd_px) {
  observations_.push_back(observation_of(Kind::kDrone, picture, pixel, sd_px, options_.name));
  const auto place = position_at(positions_(), picture.utime_us, 0);
  if (place && !beside_px_) {
    double& heading = model_.geometry.chain.heading_rad;
    heading = learned_heading(model_, picture.reading, pixel, *place).value_or(heading);
  }
  const auto seen = place ? view(model_.geometry, corrected_angles(model_, picture.reading), *place)
                          : std::nullopt;
  if (seen) beside_px_ = pixel - seen->pixel;
  turned_ = {};
  dialog_.end();
  done_ = static_cast<int>(observations_.size()) >= options_.points;
  if (!done_) ask("");
}

void DroneStage::not_taken(const std::string& why) {
  shot_.reset();
  ask("No picture: " + why);
}

void DroneStage::answered(const Answer& answer) {
  if (!dialog_.question()) {
    if (answer.choice == "sight") return sight(answer.utime_us);
    if (answer.choice != "done") return;
    if (observations_.empty()) remark(options_.name + ": not sighted");
    done_ = true;
    return;
  }
  switch (dialog_.answered(answer)) {
    case PointingDialog::Event::kConfirmed:
      return confirm(dialog_.picture(), dialog_.pixel(), std::max(kFloor_px, dialog_.sd_px()));
    case PointingDialog::Event::kTurn:
      turned_ = {turned_.pan_rad + answer.turn.pan_rad, turned_.tilt_rad + answer.turn.tilt_rad};
      dialog_.end();
      return sight(answer.utime_us);
    case PointingDialog::Event::kSkipped:
      dialog_.end();
      turned_ = {};
      return ask("Skipped");
    case PointingDialog::Event::kAsksOn:
      return;
  }
}

double DroneStage::progress() const {
  return done_ ? 1.0 : static_cast<double>(observations_.size()) / options_.points;
}

}  // namespace ols::calibration
