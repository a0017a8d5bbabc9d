// A scenario: the site, its stations and targets, and the errors of a real site. Each error can be
// switched off.
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

// The errors of a real site. An error that is switched off has no effect, and the stations'
// configurations state it as zero.
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
    double sd_m = 0.02;  // in each of east, north, up
  } position;
  struct Designation : Switch {  // only in the lockstep simulation
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
    double vignetting = 0.12;  // the corners are darker by this fraction
    double gain_sd = 0.05;     // 1-sigma of the stations' relative gains
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
    double late_s = 0.25;                               // added to the delay of a late message
  } messages;
  struct Frames : Switch {
    double lost = 0.001;
  } frames;
};

// The mount of a station's camera: a pan-tilt unit, an ONVIF PTZ camera, or, in the live simulation
// only, a telescope mount behind an INDI server, or a mount that another program simulates. The
// station's heading and tilt align the telescope mount with the pole.
enum class MountModel { kPtu, kOnvif, kIndi, kExternal };

struct StationScenario {
  std::string id;
  Eigen::Vector3d p_enu =
      Eigen::Vector3d::Zero();  // [m] of GROUND in the site's frame, as surveyed
  ChainParameters chain;        // as calibrated
  // Of a station with a lens of its own; empty: as Scenario::camera.
  std::optional<CameraIntrinsics> camera;
  std::string camera_address;
  bool rtsp = false;      // the camera sends video by RTSP instead of GigE Vision
  std::string ptu_line;   // file name of the pty's link
  bool overview = false;  // an overview station: a person controls it, and it has a zoom lens
  ZoomScenario zoom;
  std::optional<PanTilt> fixed;  // the camera never moves from these angles; empty: it can turn
  // The field that the station watches while nothing else uses its unit: its middle here, its width
  // and height below.
  std::optional<AzimuthElevation> watch;
  Eigen::Vector2d watch_size_rad = Eigen::Vector2d::Zero();
  MountModel mount = MountModel::kPtu;
  // Serial device of a real unit that replaces the simulated one; empty: none.
  std::string ptu_device;
};

struct TargetScenario {
  std::string id;  // a word; by default the target's number, from 1
  std::shared_ptr<const Trajectory> trajectory;
  FlyerShape shape = FlyerShape::kDrone;
  double span_m = 1.0;       // from rotor tip to rotor tip, or from wing tip to wing tip
  double brightness = 0.22;  // 0: black; 1: as bright as the sky
};

// How the stations find their headings: by sighting other stations or landmarks, or not at all.
// With kDrawn, the errors of the headings are drawn at random (errors.heading).
enum class StationingBy { kDrawn, kEachOther, kLandmarks };

// With errors.heading off, the landmarks and the operator's marks are exact.
struct StationingScenario {
  struct Landmark {
    std::string id;
    Eigen::Vector3d p_ecef = Eigen::Vector3d::Zero();  // [m] as in the land register
    double sd_m = 0.1;                                 // of each axis
  };
  StationingBy by = StationingBy::kDrawn;
  double mark_sd_px = 0.5;             // of the pixel that the operator marks, each coordinate
  double each_other_sd_m = 0.05;       // of the point that is sighted on another station, each axis
  double highest_rad = radians(10.0);  // max elevation or depression angle of a sighting
  std::vector<Landmark> landmarks;
};

// The configuration of the stations' PTUs.
struct PtuScenario {
  int baud = 38400;
  double poll_interval_s = 0.025;
  bool home_at_power_up = true;  // the PTU then gives no answers for about twenty seconds
};

// The ONVIF PTZ cameras.
struct OnvifScenario {
  int port = 8080;
  double max_speed_rad_s = radians(60.0), acceleration_rad_s2 = radians(120.0);  // of each axis
  double command_delay_s = 0.08;  // from the arrival of a command to the motion
  // 1-sigma error of a move; the reported position does not show it.
  double repeatability_rad = radians(0.05);
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
  double sd_m = 0.01;  // in each of east and north; the sigma of up is 1.5 times this
  Eigen::Vector3d ground_to_antenna_enu_m{0.1, -0.2, 1.9};
  int gpsd_port = 2950;  // of the first station's gpsd; the other stations use the next ports
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
  double haze = 0.4;  // share of the slopes' brightness that is scattered light of the air
  int seed = 7;
  bool sun = false;  // visible at its true position; only in the live simulation
};

struct Scenario {
  std::string name;
  Geodetic origin;
  CameraIntrinsics camera;        // as calibrated; for every station without a lens of its own
  double px_per_mm = 1e3 / 3.75;  // of the camera's sensor
  double frame_rate_hz = 15.0;
  double exposure_s = 0.002;
  double readout_s = 0.010;
  PtuScenario ptu;
  OnvifScenario onvif;
  InclinometerScenario inclinometer;
  GnssScenario gnss;
  GpioScenario gpio;
  bool detector_on = false;  // the stations' detectors search for objects
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

// Sets how the stations find their headings: `by` is "drawn", "each-other" or "landmarks". Throws
// std::invalid_argument for another word (the message lists these), or if "landmarks" is chosen and
// there are none.
void choose_stationing(StationingScenario& stationing, const std::string& by);

// Removes all targets but this one. Throws std::invalid_argument for an unknown id.
void keep_target(Scenario& scenario, const std::string& id);

// All keys of a scenario file. File names in it are relative to `folder`.
config::Section scenario_section(Scenario& scenario, const std::string& folder);
// Throws ConfigError naming file, line and key.
Scenario load_scenario(const std::string& path);
// The same from the text of a file.
Scenario parse_scenario(const std::string& text, const std::string& name,
                        const std::string& folder);

}  // namespace ols::sim
