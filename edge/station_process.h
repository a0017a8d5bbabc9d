// One running station: devices, decisions and bus, in real time.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "base/service_notifier.h"
#include "edge/clock/clock_source.h"
#include "edge/clock/clock_watch.h"
#include "edge/device_set.h"
#include "edge/host_watch.h"
#include "edge/journal.h"
#include "edge/messages_bus.h"
#include "edge/pose_memory.h"
#include "edge/station_memory.h"
#include "edge/trouble_log.h"

namespace ols {

class StationProcess {
 public:
  // Network and devices that are absent are waited for.
  StationProcess(const StationSettings& settings, std::int64_t boot_id);

  // Turns until `ends` says so; tells systemd. Ready is who turns, whatever devices there are.
  void run(const std::function<bool()>& ends);

 private:
  // One turn of the control loop: commands, PTU angles, the newest frame, bearings, the PTU's goal,
  // and now and then a status and a preview. Returns within a few milliseconds, or as long as the
  // tracker takes for a frame.
  void turn();
  ClockPair look_at_clocks();
  void resume_pose(double now_s);
  void resume_hold(double now_s);
  void heed_emergency_stop(double now_s);
  void heed_rearming(double now_s);
  void receive_commands();
  void keep_pose(double now_s);
  void take_frame();
  void take_angles();
  void trigger_camera(double now_s);
  void send_reports(const ClockPair& now);
  StationReport report(const ClockPair& now);
  std::string emergency_alarm() const;
  void add_pose_and_clock(double now_s, StationReport& report) const;
  void add_host(double now_s, StationReport& report);
  void note_troubles(const ClockPair& now, StationReport& report);
  void show(const StationReport& report);
  std::string record(const RecordCommand& command);

  const StationSettings settings_;
  ServiceNotifier service_;
  ClockWatch clock_;
  ClockSource clock_source_;
  PoseEstimator pose_;
  PoseMemory pose_memory_;
  Station station_;
  CommandTurn turn_commands_;
  StationBus bus_;
  HostWatch host_;
  TroubleLog troubles_;
  StationMemory memory_;
  Journal journal_;
  DeviceSet devices_;
  std::optional<Frame> newest_;
  std::int64_t utc_minus_monotonic_us_ = 0;
  bool halted_ = false;  // the PTU refuses to move until it is rearmed
  double pose_due_s_ = 0.0;
  double pose_kept_due_s_ = 0.0;
  double trigger_due_s_ = 0.0;
  double status_due_s_ = 0.0;
  double preview_due_s_ = 0.0;
};

}  // namespace ols
