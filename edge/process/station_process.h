// A running station: connects devices, decisions (Station) and bus, in real time.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>

#include "base/process/service_notifier.h"
#include "edge/calibration/calibration_supervisor.h"
#include "edge/frames/frame_desk.h"
#include "edge/messages/messages_bus.h"
#include "edge/process/detector_thread.h"
#include "edge/process/device_set.h"
#include "edge/process/host_monitor.h"
#include "edge/process/kept_pose.h"
#include "edge/process/skyline_thread.h"
#include "edge/process/station_clock.h"
#include "edge/process/station_journal.h"
#include "edge/station/persisted_station_state.h"

namespace ols::station {

// The parts that a simulation replaces.
struct Outside {
  OpenDevices open_devices;
  TimeService time_service;
};

class StationProcess {
 public:
  // The network and all devices may be absent. The station then tries periodically to reach them.
  StationProcess(const StationSettings& configured, std::int64_t boot_id,
                 Outside outside = {open_chosen_devices, host_time_service()});

  // Runs until `ends` returns true. Notifies systemd: the station is ready after the first cycle of
  // the control loop, even if devices are absent.
  void run(const std::function<bool()>& ends);

  // One cycle of the control loop. Handles commands, angles, the newest frame, bearings and the
  // mount's goal. At intervals, also sends a status and a preview. A cycle takes a few
  // milliseconds, or as long as the tracker needs for a frame.
  void turn();

 private:
  clock::ClockPair look_at_clocks();
  void resume_hold(double now_s);
  void heed_emergency_stop(double now_s);
  void heed_rearming(double now_s);
  void receive_commands();
  double take_frame();  // returns the time [s] that it waited for a frame
  void show_frame(const camera::Frame& frame);
  bool is_night(double now_s);
  void detect(double now_s);
  void compare_skyline(double now_s);
  void take_zoom();
  void take_angles();
  std::optional<mount::Goal> goal(const StationOutput& output, double now_s);
  void trigger_camera(double now_s);
  void check_calibration(const StationReport& report, double now_s);
  void send_requested_frames(const clock::ClockPair& now);
  void send_reports(const clock::ClockPair& now);
  StationReport report(const clock::ClockPair& now);
  device::DeviceReport software() const;
  Alarm emergency_alarm() const;
  void add_pose_and_clock(double now_s, StationReport& report) const;
  void add_host(double now_s, StationReport& report);
  void show(const StationReport& report);
  std::string record(const recorder::RecordCommand& command);

  const StationSettings& settings() const { return calibration_.settings(); }

  // The monotonic times at which periodic actions are due next.
  struct Due {
    double trigger_s = 0.0, status_s = 0.0, preview_s = 0.0;
  };

  CalibrationSupervisor calibration_;  // also contains the settings
  ServiceNotifier service_;
  StationClock clock_;
  std::optional<KeptPose> pose_;  // always set; replaced when the calibration changes
  Station station_;
  CommandTurn command_turn_;
  StationBus bus_;
  HostMonitor host_;
  PersistedStationState persisted_;
  StationJournal journal_;
  // Declared before the devices and thus destroyed after them: destroying these threads takes time,
  // and the mount must be halted first.
  std::optional<DetectorThread> detector_;  // nullopt if not enabled
  std::optional<SkylineThread> skyline_;    // nullopt if no land is configured
  DeviceSet devices_;
  FrameDesk frames_;
  std::optional<camera::Frame> newest_;
  bool is_night_ = false;
  double night_judged_s_ = -std::numeric_limits<double>::infinity();
  bool halted_ = false;  // the mount refuses to move until the station is re-armed
  Due due_;
};

}  // namespace ols::station
