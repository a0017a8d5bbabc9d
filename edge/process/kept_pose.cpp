#include "edge/process/kept_pose.h"

#include "base/process/clocks.h"
#include "conditions/alarms.h"

namespace ols::station {
namespace {

constexpr double kInterval_s = 0.1;
constexpr double kKept_s = 10.0;  // interval of saving

std::string pose_file(const StationSettings& settings) {
  if (settings.state_folder.empty()) return {};
  return settings.state_folder + "/" + settings.id + ".pose";
}

}  // namespace

KeptPose::KeptPose(const StationSettings& settings, double now_s)
    : estimator_(settings.pose), store_(pose_file(settings)) {
  sensors::PersistedPose known = store_.found();
  if (!settings.gnss->is_configured()) known.position.reset();
  if (!settings.inclinometer->is_configured()) known.tilt.reset();
  estimator_.resume(known, now_s, clock_utime_us());
}

std::optional<sensors::StationPose> KeptPose::look(DeviceSet& devices, double now_s) {
  if (now_s < due_s_) return std::nullopt;
  due_s_ = now_s + kInterval_s;
  devices.feed(estimator_);
  if (now_s >= kept_due_s_) {
    kept_due_s_ = now_s + kKept_s;
    store_.keep(estimator_.to_persist(now_s, clock_utime_us()));
  }
  return estimator_.pose(now_s);
}

std::vector<Alarm> KeptPose::alarms(double now_s) const {
  auto alarms = estimator_.alarms(now_s);
  if (estimator_.pose(now_s).position_source == sensors::PoseSource::kNone) {
    alarms.push_back(alarm::no_position());
  }
  if (const Alarm trouble = store_.trouble(); !trouble.empty()) {
    alarms.push_back(trouble);
  }
  return alarms;
}

}  // namespace ols::station
