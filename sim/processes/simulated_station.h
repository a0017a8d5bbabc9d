// A station's whole process in simulated time: the control loop and the bus of ols-station. The
// simulated PTU and lens exchange bytes with the process, and the simulated camera gives it frames.
// The simulated GPIO lines have the levels of emergency stop and re-arm button.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "edge/camera/frame_statistics.h"
#include "edge/process/station_process.h"
#include "sim/lens/lens_unit.h"
#include "sim/processes/sensors_in_hand.h"
#include "sim/processes/simulated_time.h"
#include "sim/ptu/faults.h"
#include "sim/world/exposed_unit.h"
#include "sim/world/renderer.h"
#include "sim/world/world.h"

namespace ols::sim {

class SimulatedStation {
 public:
  // A picture that the camera has sent, and the truth about it.
  struct Sent {
    std::int64_t utime_us = 0;  // the station's stamp
    ExposureTruth exposure;
    ViewTruth view;
  };

  // Only camera, mount (a FLIR unit), lens, inclinometer, GNSS receiver and GPIO may be configured.
  // A simulated time service reports that the station's clock is synchronised. `world` and `time`
  // must outlive the station.
  SimulatedStation(const World& world, std::size_t index, station::StationSettings settings,
                   SimulatedTime& time);
  ~SimulatedStation();

  // Ends the process and starts it again; camera and unit stay as they are.
  void restart();
  void set_faults(const StationFaults& faults);
  const StationFaults& faults() const { return faults_; }
  PanTilt angles() const;  // of the unit, now
  const std::vector<Sent>& sent() const { return sent_; }

 private:
  class CameraInHand;
  class UnitInHand;
  class LensInHand;
  class GpioInHand;
  station::ChosenDevices chosen(const station::StationSettings& settings);
  void step(double time_s);
  void exchange_bytes();
  void expose(double time_s);

  const World& world_;
  std::size_t index_;
  station::StationSettings settings_;
  FaultyPtuUnit unit_;
  ExposedUnit exposed_;
  std::optional<LensUnit> lens_unit_;  // nullopt: the station has no zoom lens
  std::unique_ptr<Renderer> renderer_;
  StationFaults faults_;
  std::int64_t exposures_ = 0, boots_ = 0, steps_ = 0;
  std::vector<Sent> sent_;
  // Parts of the process.
  CameraInHand* camera_ = nullptr;
  UnitInHand* ptu_ = nullptr;
  LensInHand* lens_ = nullptr;                  // null: not configured
  InclinometerInHand* inclinometer_ = nullptr;  // likewise
  GnssInHand* gnss_ = nullptr;                  // likewise
  GpioInHand* gpio_ = nullptr;                  // likewise
  camera::FrameStatistics statistics_;
  std::unique_ptr<station::StationProcess> process_;
};

}  // namespace ols::sim
