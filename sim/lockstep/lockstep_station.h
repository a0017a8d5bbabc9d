// One station in simulated time: the product's Station, with the mount and the frames of simulated
// devices.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "conditions/alarm.h"
#include "edge/detector/detector_work.h"
#include "edge/frames/sighting_desk.h"
#include "edge/lens/lens_driver.h"
#include "edge/station/station.h"
#include "edge/tracker/tracker_config.h"
#include "sim/lens/lens_unit.h"
#include "sim/lockstep/lockstep_mount.h"
#include "sim/lockstep/lockstep_operator.h"
#include "sim/lockstep/view_tracker.h"
#include "sim/world/exposed_unit.h"
#include "sim/world/renderer.h"
#include "sim/world/world.h"

namespace ols::sim {

// The station's result and the truth for one frame. No notes are taken while the station waits for
// its designation.
struct FrameNote {
  double mid_s = 0.0;  // true time since the scenario's start
  station::StationState state = station::StationState::kIdle;
  double belief = 0.0;
  ViewTruth view;
  bool inside_third = false;  // the target is inside the central third, horizontally and vertically
  std::optional<Eigen::Vector2d> error_px;  // of the measured pixel; only while tracking
  std::optional<cv::Rect2d> box;            // [px] the tracker's box
  std::vector<Alarm> alarms;                // of the station's own logic
};

struct StationRecord {
  std::vector<FrameNote> frames;
  int frames_lost = 0;
  std::map<std::string, double> counters;  // of the station and its PTU driver at the end
};

class LockstepStation {
 public:
  // `renderer` is null without images; `world` must outlive the station.
  LockstepStation(const World& world, std::size_t index, const Fidelity& fidelity,
                  std::unique_ptr<Renderer> renderer,
                  const std::optional<StationCalibration>& calibration = std::nullopt);

  // Advances to this instant of true time; returns the new bearings. Call in steps of about a
  // millisecond.
  std::vector<station::Bearing> advance(double time_s);

  // The station's sightings (counts and pixel) for a bearing that the last advance() returned.
  // `utime_us`: the stamp of the bearing.
  std::vector<station::Sighting> sightings(const station::Bearing& bearing, std::int64_t utime_us) {
    return sightings_.take(bearing, utime_us, station_.pointing());
  }
  station::Refusal slew(station::SlewCommand command, double time_s);
  station::Refusal occlude(station::OcclusionCommand command, double time_s);
  const station::Station& station() const { return station_; }
  // For a caller that gives the station orders between two calls of advance(). The times in these
  // orders must be monotonic_s() of the present instant.
  station::Station& station() { return station_; }
  // The truth about the newest picture.
  const ViewTruth& view() const { return views_.newest(); }
  StationRecord record() const;
  bool designated() const { return operator_.designated(); }
  bool left_alone() const { return operator_.leaves_alone(); }

 private:
  // A simulated zoom lens, and the product's driver of it.
  struct Lens {
    sim::LensUnit unit;
    lens::LensDriver driver;
  };
  // The detector. Its result is available only after some time, as on a real station, where the
  // detector runs in a thread of its own.
  struct Detection {
    detector::PictureDetector detector;
    std::optional<detector::Found> found{};
    double ready_s = 0.0;
  };
  struct Shutter {
    double phase_s = 0.0;  // of the exposures
    std::int64_t next = 0;
  };
  void move_lens(double time_s);
  void expose(double time_s);
  void detect(double time_s);
  void take_note(double mid_s, const ViewTruth& view);
  void operate(double time_s);

  const World& world_;
  std::size_t index_;
  std::unique_ptr<Renderer> renderer_;
  LockstepNoise noise_;
  Shutter shutter_;
  std::unique_ptr<LockstepMount> mount_;
  ExposedUnit exposed_;
  std::optional<Lens> lens_;
  ViewMemory views_;
  station::StationConfig config_;
  station::Station station_;
  std::optional<Detection> detection_;
  LockstepOperator operator_;
  StationRecord record_;
  station::SightingDesk sightings_;
};

}  // namespace ols::sim
