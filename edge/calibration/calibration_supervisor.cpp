#include "edge/calibration/calibration_supervisor.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "calibration/procedure/sun_keep_out.h"

namespace ols::station {

CalibrationSupervisor::CalibrationSupervisor(const StationSettings& configured, UtcNow now)
    : now_(std::move(now)), next_(configured), in_use_(configured) {
  begin();
}

void CalibrationSupervisor::begin() {
  views_.reset();
  doubt_revision_ = 0;
  const StationSettings& now = settings();
  if (!now.station.calibration || now.view_check_s <= 0.0) return;
  ReferenceViews::Config config;
  config.folder = now.state_folder;
  config.station = now.id;
  config.calibration_id = now.calibration_id;
  config.tour.interval_s = now.view_check_s;
  // No filter is on the lens when nobody is there.
  const calibration::SunKeepOut sun(now.station.calibration->model, now_);
  config.sun = [sun](const PanTilt& at, double turned_rad) {
    return !sun.hindrance(at, turned_rad).empty();
  };
  views_ = std::make_unique<ReferenceViews>(config, *now.station.calibration);
}

bool CalibrationSupervisor::refuses(const std::vector<device::DeviceReport>& devices) {
  if (!in_use_.refuses(devices)) return false;
  begin();
  return true;
}

bool CalibrationSupervisor::refuses(const PanTilt& count_rad) {
  if (!in_use_.refuses(count_rad)) return false;
  begin();
  return true;
}

bool CalibrationSupervisor::adopts(double now_s, bool idle,
                                   const std::vector<device::DeviceReport>& devices,
                                   const PanTilt& count_rad) {
  next_.look(now_s);
  const CalibrationFiles* files = next_.waiting();
  if (!files) return false;
  const std::string why = ActiveCalibration::conflict(*files, devices, count_rad);
  if (!why.empty()) {
    next_.refuse(why);
    return false;
  }
  const bool known =
      in_use_.status().state == CalibrationState::kInUse && in_use_.status().id == files->id;
  if (!idle && !known) return false;
  if (!known) in_use_.adopt(*files);
  next_.forget();
  if (!known) begin();
  return !known;
}

void CalibrationSupervisor::set_limits(const mount::Limits& limits) {
  if (views_) views_->set_limits(limits);
}

std::optional<mount::Goal> CalibrationSupervisor::step(const ViewTour::Situation& situation) {
  return views_ ? views_->step(situation) : std::nullopt;
}

void CalibrationSupervisor::see(const camera::Frame& frame) {
  if (views_) views_->see(frame);
}

void CalibrationSupervisor::note_homings(std::uint64_t homings) {
  if (std::exchange(homings_, homings) != homings && views_) views_->request();
}

std::optional<CalibrationSupervisor::Doubt> CalibrationSupervisor::take_doubt() {
  if (!views_) return std::nullopt;
  const DriftWatch& watch = views_->watch();
  if (std::exchange(doubt_revision_, watch.revision()) == watch.revision()) return std::nullopt;
  return Doubt{watch.heading_doubt_rad(), watch.tilt_doubt_rad()};
}

CalibrationStatus CalibrationSupervisor::status() const {
  CalibrationStatus status = in_use_.status();
  const bool doubted = views_ && views_->watch().level() != DriftLevel::kNone;
  if (status.state == CalibrationState::kInUse && doubted) {
    status.state = CalibrationState::kDoubted;
    const DriftWatch& watch = views_->watch();
    status.rms_rad =
        std::hypot(status.rms_rad, std::max(watch.heading_doubt_rad(), watch.tilt_doubt_rad()));
  }
  return status;
}

std::vector<Alarm> CalibrationSupervisor::alarms() const {
  std::vector<Alarm> alarms = in_use_.alarms();
  if (Alarm alarm = next_.alarm(); !alarm.empty()) alarms.push_back(std::move(alarm));
  if (views_) {
    const auto more = views_->alarms();
    alarms.insert(alarms.end(), more.begin(), more.end());
  }
  return alarms;
}

std::map<std::string, double> CalibrationSupervisor::counters() const {
  std::map<std::string, double> counters;
  if (!views_) return counters;
  counters["view_checks"] = static_cast<double>(views_->checks());
  counters["views_unrecognised"] = static_cast<double>(views_->unrecognised());
  counters["views_left_out"] = static_cast<double>(views_->left_out());
  return counters;
}

}  // namespace ols::station
