// A scenario: the site, its stations and targets, and the errors of a real site, each with a
// switch.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "geometry/angles.h"
#include "geometry/sight.h"
#include "sim/lens/zoom_truth.h"
#include "sim/scenario/fault_plan.h"
#include "sim/world/boards.h"
#include "sim/world/flyer.h"
#include "sim/world/marks.h"
#include "sim/world/relief.h"
#include "sim/world/trajectory.h"
#include "sim/world/unit_truth.h"

namespace ols::config {
struct Section;
}
namespace ols::sim {

// The errors of a real site. An error that is switched off has no effect, and the stations are told
// that it is zero.
struct Errors {
  struct Switch {
    bool on = true;
  };
  struct Heading : Switch {
    double sd_rad = radians(0.02);
  } heading;
  struct Tilt : Switch {
    double sd_rad = radians(0.01);  // of each axis
  } tilt;
  struct Mounting : Switch {
    double sd_rad = radians(0.01);       // about the axes across the optical axis
    double roll_sd_rad = radians(0.05);  // about the optical axis
  } mounting;
  struct Position : Switch {
    double sd_m = 0.02;  // of each of east, north, up
  } position;
  struct Designation : Switch {  // in the lockstep simulation
    double sd_px = 1.0;          // of the operator's box, each axis
    double stated_sd_px() const { return on ? sd_px : 0.0; }
  } designation;
  struct Encoder : Switch {
    double step_arcsec = 11.5714;
  } encoder;
  struct Distortion : Switch {
    double residual_k1_sd = 0.02;  // error of k1 after calibration
  } distortion;
  struct Noise : Switch {
    double sd_gray = 2.0;
  } noise;
  struct MotionBlur : Switch {
  } motion_blur;
  struct Brightness : Switch {
    double vignetting = 0.12;  // darker by this fraction in the corners
    double gain_sd = 0.05;     // from station to station
  } brightness;
  struct Clock : Switch {
    double sd_s = 0.0005;
  } clock;
  struct PtuReply : Switch {
    double jitter_s = 0.0008;  // uniform +-
  } ptu_reply;
  struct Messages : Switch {  // on the network between stations and fusion
    double lost = 0.005, doubled = 0.005, late = 0.01;  // probabilities
    double delay_s = 0.004;                             // of every message
    double late_s = 0.25;                               // added to a late one
  } messages;
  struct Frames : Switch {
    double lost = 0.001;
  } frames;
};

// What turns a station's camera: a pan-tilt unit, an ONVIF PTZ camera, or (in the live simulation)
// a telescope mount behind an INDI server, aligned with the pole by the station's heading and tilt.
enum class MountModel { kPtu, kOnvif, kIndi };

struct StationScenario {
  std::string id;
  Eigen::Vector3d p_enu =
      Eigen::Vector3d::Zero();             // [m] of GROUND in the site's frame, as surveyed
  ChainParameters chain;                   // as calibrated
  std::optional<CameraIntrinsics> camera;  // with a lens of its own; empty: that of all
  std::string camera_address;
  bool rtsp = false;      // its camera sends video by RTSP instead of GigE Vision
  std::string ptu_line;   // file name of the pty's link
  bool overview = false;  // driven by a person, with a zoom lens
  ZoomScenario zoom;
  std::optional<PanTilt> fixed;  // the camera stands still at these angles; empty: a PTU
  // The field that it watches while nothing else uses its unit: the middle; width and height.
  std::optional<AzimuthElevation> watch;
  Eigen::Vector2d watch_size_rad = Eigen::Vector2d::Zero();
  MountModel mount = MountModel::kPtu;
  std::string ptu_device;  // of a real unit that replaces the simulated one; empty: none
};

struct TargetScenario {
  std::string id;  // a word; by default its number, from 1
  std::shared_ptr<const Trajectory> trajectory;
  FlyerShape shape = FlyerShape::kDrone;
  double span_m = 1.0;       // from rotor tip to rotor tip, or from wing tip to wing tip
  double brightness = 0.22;  // 0 black .. 1 as bright as the sky
};

// How the stations find their headings: not at all (errors.heading draws their errors), by sighting
// other stations, or by sighting landmarks.
enum class StationingBy { kDrawn, kEachOther, kLandmarks };

// With errors.heading off, the landmarks and the operator's marks are exact.
struct StationingScenario {
  struct Landmark {
    std::string id;
    Eigen::Vector3d p_ecef = Eigen::Vector3d::Zero();  // [m] as in the land register
    double sd_m = 0.1;                                 // of each axis
  };
  StationingBy by = StationingBy::kDrawn;
  double mark_sd_px = 0.5;             // of the operator's mark, each coordinate
  double each_other_sd_m = 0.05;       // of the point sighted on another station, each axis
  double highest_rad = radians(10.0);  // max elevation or depression of a sighting
  std::vector<Landmark> landmarks;
};

// The configuration of the stations' PTUs.
struct PtuScenario {
  int baud = 38400;
  double poll_interval_s = 0.025;
  bool home_at_power_up = true;  // about twenty seconds without answers
};

// The ONVIF PTZ cameras.
struct OnvifScenario {
  int port = 8080;
  double max_speed_rad_s = radians(60.0), acceleration_rad_s2 = radians(120.0);  // of each axis
  double command_delay_s = 0.08;             // from a command's arrival to the motion
  double repeatability_rad = radians(0.05);  // 1-sigma by which a move misses a position, unseen
  double boot_s = 20.0;
};

// The inclinometer of every station.
struct InclinometerScenario {
  bool on = true;
  double zero_sd_rad = radians(0.005);  // of each axis
  double noise_sd_rad = radians(0.002);
};

// The GNSS receiver of every station.
struct GnssScenario {
  bool on = true;
  double sd_m = 0.01;  // of each of east and north; up: half as much again
  Eigen::Vector3d ground_to_antenna_enu_m{0.1, -0.2, 1.9};
  int gpsd_port = 2950;  // of the first station's gpsd; the others follow
};

// The emergency stop input of every station.
struct GpioScenario {
  bool on = false;  // false: the stations' configurations have no stop input
};

// The landscape around the site, at infinity.
struct Landscape {
  double ridge_mean_rad = radians(8.0);
  double ridge_relief_rad = radians(6.0);  // the ridge line stays within mean +- relief
  double cloudiness = 1.0;                 // 0: clear sky
  double haze = 0.4;                       // share of air light before the slopes
  int seed = 7;
  bool sun = false;  // visible at its true position; live only
};

struct Scenario {
  std::string name;
  Geodetic origin;
  CameraIntrinsics camera;        // as calibrated, of every station without a lens of its own
  double px_per_mm = 1e3 / 3.75;  // of its sensor
  double frame_rate_hz = 15.0;
  double exposure_s = 0.002;
  double readout_s = 0.010;
  PtuScenario ptu;
  OnvifScenario onvif;
  InclinometerScenario inclinometer;
  GnssScenario gnss;
  GpioScenario gpio;
  bool detector_on = false;  // the stations look for objects by themselves
  Errors errors;
  UnitErrorsScenario unit_errors;
  StationingScenario stationing;
  Landscape landscape;
  ReliefScenario relief;
  std::vector<StationScenario> stations;
  std::vector<TargetScenario> targets;
  std::vector<Mark> marks;
  BoardsScenario boards;
  std::vector<Fault> faults;

  const CameraIntrinsics& camera_of(const StationScenario& station) const {
    return station.camera ? *station.camera : camera;
  }
};

// Switches an error off by its name in the file ("heading", "tilt", ...). Throws
// std::invalid_argument, listing all names, for an unknown one.
void switch_off(Errors& errors, const std::string& name);

// "drawn", "each-other" or "landmarks". Throws std::invalid_argument, with these words, for another
// one, or if there are no landmarks.
void choose_stationing(StationingScenario& stationing, const std::string& by);

// Keeps only this target. Throws std::invalid_argument for an unknown id.
void keep_target(Scenario& scenario, const std::string& id);

// The whole file. Files named in it are relative to `folder`.
config::Section scenario_section(Scenario& scenario, const std::string& folder);
// Throws ConfigError naming file, line and key.
Scenario load_scenario(const std::string& path);
// The same from text.
Scenario parse_scenario(const std::string& text, const std::string& name,
                        const std::string& folder);

}  // namespace ols::sim
