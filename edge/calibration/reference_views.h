// Stores pictures of a calibrated station's reference views (ViewTour), and checks later pictures
// against them. Files and pictures are processed in other threads, so that the control loop never
// waits for them.
#pragma once

#include <cstdint>
#include <functional>
#include <future>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/files/background_file.h"
#include "conditions/alarm.h"
#include "edge/calibration/check_record.h"
#include "edge/calibration/drift_watch.h"
#include "edge/calibration/view_tour.h"
#include "edge/camera/frame.h"
#include "geometry/station_calibration.h"

namespace ols::station {

class ReferenceViews {
 public:
  struct Config {
    std::string
        folder;  // of the persisted state; if empty, pictures and findings are lost at process end
    std::string station;
    std::int64_t calibration_id = 0;
    ViewTour::Config tour;
    DriftWatch::Config drift;
    // Whether the sun is too near to the direction of these reported angles. The second argument:
    // the angle [rad] by which the tripod may have turned since the calibration. If the function is
    // empty, the sun is ignored.
    std::function<bool(const PanTilt&, double)> sun;
  };
  ReferenceViews(const Config& config, const StationCalibration& calibration);
  ReferenceViews(const ReferenceViews&) = delete;  // tour_ holds a pointer to this object

  // Sets the unit's travel limits, once they are known, and starts to read the stored pictures.
  void set_limits(const mount::Limits& limits);
  void request() { tour_.request(); }
  std::optional<mount::Goal> step(const ViewTour::Situation& situation);
  void see(const camera::Frame& frame);

  // Whether the stored pictures have been read. Call it in every cycle of the control loop.
  bool loaded();
  const DriftWatch& watch() const { return watch_; }
  bool stored() const { return stored_ == views(); }
  std::uint64_t checks() const { return tally_.checks; }
  // How often a view was not recognised: night, fog, another scene.
  std::uint64_t unrecognised() const { return tally_.unrecognised; }
  // How often a round left out a view because of the sun.
  std::uint64_t left_out() const { return tally_.left_out; }
  std::vector<Alarm> alarms() const;

 private:
  // The result of processing a picture: its offset from the stored picture of this view. If no
  // picture of the view was stored, the result is the picture itself, which is then stored.
  struct Seen {
    std::optional<ViewOffset> offset;
    cv::Mat picture;
  };
  struct Tally {
    std::uint64_t checks = 0, unrecognised = 0, left_out = 0;
  };
  struct Look {
    std::size_t view = 0;
    bool storing = false;
    std::future<Seen> result;
  };
  std::size_t views() const { return tour_.views().size(); }
  ViewTour::Config tour_config() const;
  double turned_rad() const;
  std::string picture(std::size_t view) const;
  void finish();
  std::vector<ViewOffset> take_looks();

  Config config_;
  StationCalibration calibration_;
  ViewTour tour_;
  DriftWatch watch_;
  BackgroundFile file_;
  std::vector<cv::Mat> pictures_;              // one for each view; empty if none is stored yet
  std::future<std::vector<cv::Mat>> loading_;  // the stored pictures while they are being read
  std::size_t stored_ = 0;
  CheckRecord record_;
  std::vector<Look> looks_;
  std::string unreadable_;
  Tally tally_;
  bool judged_ = true;
  bool astray_ = false;           // the last round did not recognise its stored pictures
  std::optional<PanTilt> count_;  // size of a count [rad]; set once the views are planned
};

}  // namespace ols::station
