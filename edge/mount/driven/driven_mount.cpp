#include "edge/mount/driven/driven_mount.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <utility>

#include "base/process/clocks.h"
#include "conditions/alarms.h"
#include "geometry/angles.h"

namespace ols::mount {
namespace {

constexpr double kFirstPause_s = 0.2, kMaxPause_s = 5.0;
constexpr double kNoAngles_s = 1.0;  // without a position: an alarm

std::string quality_of(const PositionIntake& intake) {
  std::array<char, 120> text{};
  std::snprintf(text.data(), text.size(), ", answers in %.0f ms, positions +-%.3g deg",
                1e3 * intake.round_trip_s(), degrees(intake.sd_rad()));
  return text.data();
}

}  // namespace

Traits driven_traits(const DriveConfig& config) {
  Traits traits;
  traits.may_home = false;
  traits.limits = config.limits;
  traits.angles.step_rad = kVirtualCount_rad;
  // A mount that renews its position less often than it is polled leaves gaps.
  traits.angles.max_gap_s = std::max(1.0, 5.0 * config.poll_s);
  traits.angles.max_extrapolation_s = std::max(0.4, 2.0 * config.poll_s + config.positions.delay_s);
  return traits;
}

void SharedDrive::pause(double seconds, const std::stop_token& stop) {
  std::unique_lock lock(mutex);
  wake.wait_for(lock, stop, std::chrono::duration<double>(seconds), [] { return false; });
}

DrivenMount::DrivenMount(const DriveConfig& config, std::unique_ptr<MountSession> session)
    : shared_(config),
      session_(std::move(session)),
      thread_({"ptu", "is being connected", kFirstPause_s, kMaxPause_s, alarm::ptu_no_connection}) {
  thread_.start([this](const std::stop_token& stop) {
    const struct Lost {
      SharedDrive& shared;
      ~Lost() {
        const std::lock_guard lock(shared.mutex);
        shared.drive.lost();
      }
    } lost{shared_};
    session_->run(shared_, thread_, stop);
  });
}

DrivenMount::~DrivenMount() { session_->interrupt(); }

bool DrivenMount::ready() const {
  return shared_.usable && !shared_.fault && shared_.drive.has_position() && thread_.link().is_open;
}

void DrivenMount::set_goal(const std::optional<Goal>& goal) {
  const std::lock_guard lock(shared_.mutex);
  shared_.drive.set_goal(ready() ? goal : std::nullopt);
}

std::vector<AngleSample> DrivenMount::take_samples() {
  const std::lock_guard lock(shared_.mutex);
  auto samples = shared_.drive.take_samples();
  if (!ready()) samples.clear();
  return samples;
}

void DrivenMount::see(const SeenTurn& turn) {
  const std::lock_guard lock(shared_.mutex);
  shared_.drive.see(turn);
}

std::optional<Limits> DrivenMount::limits() const {
  const std::lock_guard lock(shared_.mutex);
  return ready() ? std::optional(shared_.drive.limits()) : std::nullopt;
}

void DrivenMount::emergency_halt() {
  {
    const std::lock_guard lock(shared_.mutex);
    shared_.drive.emergency_halt();
    shared_.wake.notify_all();
  }
  session_->interrupt();
}

void DrivenMount::clear_emergency() {
  const std::lock_guard lock(shared_.mutex);
  shared_.drive.clear_emergency();
}

Reference DrivenMount::reference() const {
  const std::lock_guard lock(shared_.mutex);
  return ready() ? Reference::kTrusted : Reference::kUnknown;
}

device::DeviceReport DrivenMount::report() const {
  device::DeviceReport report = thread_.report();
  const double now_s = clock_monotonic_s();
  const std::lock_guard lock(shared_.mutex);
  const Drive& drive = shared_.drive;
  report.serial = shared_.serial;
  report.last_good_s = drive.last_position_s();
  report.errors += shared_.errors;
  if (!shared_.last_error.empty()) report.last_error = shared_.last_error;
  for (Alarm& alarm : drive.alarms(now_s)) report.alarms.push_back(std::move(alarm));
  if (shared_.fault) {
    report.state = device::DeviceState::kFault;
    report.alarms = {*shared_.fault};
    report.text = shared_.fault->text;
  } else if (report.state == device::DeviceState::kOk) {
    report.text = shared_.words + quality_of(drive.intake());
    if (now_s - report.last_good_s.value_or(0.0) > kNoAngles_s)
      report.alarms.push_back(alarm::ptu_no_angles());
    for (const Alarm& alarm : shared_.alarms) report.alarms.push_back(alarm);
    if (!ready()) report.state = device::DeviceState::kFault;
  }
  report.readings = {{"ptu_round_trip_s", drive.intake().round_trip_s()},
                     {"ptu_position_sd_deg", degrees(drive.intake().sd_rad())}};
  if (drive.intake().interval_s() > 0.0)
    report.readings["ptu_interval_s"] = drive.intake().interval_s();
  const Drive::Counters& seen = drive.counters();
  report.counters = {{"ptu_requests", shared_.orders},
                     {"ptu_errors", shared_.errors},
                     {"ptu_emergencies", seen.emergencies},
                     {"ptu_stops_repeated", seen.stops_repeated},
                     {"ptu_unordered_motions", seen.unordered_motions},
                     {"ptu_moved_unconnected", seen.moved_unconnected},
                     {"ptu_unordered_in_picture", seen.unordered_in_picture},
                     {"ptu_orders_ignored", seen.orders_ignored},
                     {"ptu_port_failures", thread_.link().failures}};
  report.counters.insert(shared_.counters.begin(), shared_.counters.end());
  return report;
}

}  // namespace ols::mount
