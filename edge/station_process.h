// One running station: devices, decisions and bus, in real time.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>

#include "edge/camera/aravis_camera.h"
#include "edge/messages_bus.h"
#include "edge/ptu/ptu_thread.h"

namespace ols {

class StationProcess {
 public:
  // Throws BusError. Devices that are absent are waited for.
  StationProcess(const StationSettings& settings, std::int64_t boot_id);

  // One turn of the control loop: commands, PTU angles, the newest frame, bearings, the PTU's goal,
  // and now and then a status and a preview. Returns within a few milliseconds, or as long as the
  // tracker takes for a frame.
  void turn();

 private:
  void send_reports(double now_s);
  StationSnapshot snapshot_with_devices() const;
  void note(const std::string& source, const std::string& what, std::uint64_t number);

  const StationSettings settings_;
  Station station_;
  StationBus bus_;
  AravisCamera camera_;
  PtuThread ptu_;  // the first to end, whatever the camera is waiting for: it halts the unit
  std::optional<Frame> newest_;
  std::map<std::string, std::pair<std::string, std::uint64_t>> noted_;  // by source
  std::string last_error_;                                              // the newest of all sources
  double status_due_s_ = 0.0;
  double preview_due_s_ = 0.0;
};

}  // namespace ols
