#include "edge/station_process.h"

#include <memory>

#include "base/clocks.h"

namespace ols {
namespace {

constexpr double kFrameWait_s = 0.004;

}  // namespace

StationProcess::StationProcess(const StationSettings& settings, std::int64_t boot_id)
    : settings_(settings),
      station_(settings_.station,
               std::make_unique<ParticleFilterTracker>(settings_.tracker, settings_.tracker_seed)),
      bus_(settings_, boot_id, station_),
      camera_(settings_.camera),
      ptu_(settings_.ptu) {}

void StationProcess::turn() {
  bus_.set_time(clock_monotonic_s(), clock_utime_us());
  bus_.receive();
  if (auto frame = camera_.next(kFrameWait_s)) {
    // The angles first: the frame's homography is predicted from them.
    for (const auto& sample : ptu_.take_samples()) station_.on_angles(sample);
    station_.on_frame(*frame);
    newest_ = std::move(frame);
  }
  for (const auto& sample : ptu_.take_samples()) station_.on_angles(sample);
  const double now_s = clock_monotonic_s();
  for (const auto& bearing : station_.step(now_s)) bus_.send(bearing);
  ptu_.set_goal(station_.goal(now_s));
  send_reports(now_s);
}

void StationProcess::send_reports(double now_s) {
  if (now_s >= status_due_s_) {
    status_due_s_ = now_s + settings_.status_interval_s;
    const PtuStatus ptu = ptu_.status();
    if (ptu.state == PtuState::kReady) station_.set_limits(ptu.limits);
    note("camera", camera_.last_error(), 0);
    note("ptu", ptu.last_error, ptu.port_failures + ptu.counters.errors + ptu.counters.timeouts);
    note("command", bus_.last_refusal(), bus_.refusals());
    DeviceReport camera_report;
    camera_report.name = "camera";
    camera_report.state = device_state(camera_.state());
    DeviceReport ptu_report;
    ptu_report.name = "ptu";
    ptu_report.state = device_state(ptu);
    bus_.send_status(snapshot_with_devices(), ptu.limits, {camera_report, ptu_report}, last_error_);
  }
  if (settings_.preview_interval_s > 0.0 && now_s >= preview_due_s_ && newest_) {
    preview_due_s_ = now_s + settings_.preview_interval_s;
    bus_.send_preview(*newest_, station_.snapshot().box);
  }
}

// What has changed since the last look is the newest trouble.
void StationProcess::note(const std::string& source, const std::string& what,
                          std::uint64_t number) {
  const std::pair trouble{what, number};
  if (!what.empty() && noted_[source] != trouble) last_error_ = what;
  noted_[source] = trouble;
}

StationSnapshot StationProcess::snapshot_with_devices() const {
  StationSnapshot snapshot = station_.snapshot();
  const CameraCounters camera = camera_.counters();
  const PtuStatus ptu = ptu_.status();
  const auto put = [&](const char* name, std::uint64_t value) {
    snapshot.counters[name] = static_cast<double>(value);
  };
  put("frames_captured", camera.frames_captured);
  put("frames_lost", camera.frames_lost);
  put("frames_incomplete", camera.frames_incomplete);
  put("frames_late", camera.frames_late);
  put("frames_refused", camera.frames_refused);
  put("camera_reconnects", camera.reconnects);
  put("ptu_requests", ptu.counters.requests);
  put("ptu_replies", ptu.counters.replies);
  put("ptu_timeouts", ptu.counters.timeouts);
  put("ptu_errors", ptu.counters.errors);
  put("ptu_garbled", ptu.counters.garbled);
  put("ptu_restarts", ptu.counters.restarts);
  put("ptu_limit_hits", ptu.counters.limit_hits);
  put("ptu_port_failures", ptu.port_failures);
  return snapshot;
}

}  // namespace ols
