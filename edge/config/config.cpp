#include "edge/config/config.h"

#include <algorithm>
#include <cctype>
#include <stdexcept>
#include <string>

#include "base/config/config_common.h"
#include "edge/config/config_units.h"
#include "edge/sensors/pose_estimator_config.h"

namespace ols::station {
namespace {

using config::Row;
using config::Section;

void check_id(const std::string& id) {
  const bool valid = !id.empty() && id.size() <= 32 && std::ranges::all_of(id, [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '-' || c == '_';
  });
  if (!valid) throw std::invalid_argument("must be 1 to 32 letters, digits, - or _");
}

Row angle(const char* key, double& field_rad, double limit_deg, const char* sentence) {
  return config::number(key, field_rad, {-limit_deg, limit_deg}, in_degrees(), sentence);
}

Row angle_sd(const char* key, double& field_rad, const char* sentence) {
  return config::number(key, field_rad, {0.0, 90.0}, in_degrees(), sentence);
}

Section pose_section(StationSettings& settings) {
  constexpr const char* kFromGnss = "required without [gnss]";
  constexpr const char* kFromInclinometer = "by [inclinometer], or level";
  StationGeometry& g = settings.station.geometry;
  sensors::PoseEstimator::Config& pose = settings.pose;
  return {"pose",
          "The survey of GROUND; it overrides GNSS and inclinometer, which then only check it.",
          {config::number("latitude_deg", g.position.latitude_rad, {-90.0, 90.0}, in_degrees(),
                          "WGS84 latitude.")
               .default_is(kFromGnss),
           config::number("longitude_deg", g.position.longitude_rad, {-180.0, 360.0}, in_degrees(),
                          "WGS84 longitude, east positive.")
               .default_is(kFromGnss),
           config::number("height_m", g.position.height_m, {-1000.0, 100000.0}, "m",
                          "Height above the ellipsoid, not above mean sea level.")
               .default_is(kFromGnss),
           angle("heading_deg", g.chain.heading_rad, 360.0,
                 "Direction of the PTU's zero pan, clockwise from true north.")
               .required(),
           angle("tilt_x_deg", g.chain.tilt_x_rad, 90.0,
                 "Inclination of ORIGIN about X, right side down positive.")
               .default_is(kFromInclinometer),
           angle("tilt_y_deg", g.chain.tilt_y_rad, 90.0,
                 "Inclination of ORIGIN about Y, nose down positive.")
               .default_is(kFromInclinometer),
           angle_sd("level_sd_deg", pose.level_sd_rad,
                    "1-sigma of a tilt that is neither surveyed nor measured."),
           config::number("alarm_sigma", pose.alarm_sigma, {1.0, 100.0}, "sigma",
                          "A sensor reading further from the pose is not believed.")}};
}

Section chain_section(ChainParameters& c) {
  constexpr double kMaxLength_m = 100.0;
  const auto lever = [](const char* key, Eigen::Vector3d& field, const char* sentence) {
    return config::numbers(key, {field.data(), 3}, {-kMaxLength_m, kMaxLength_m}, "m", sentence);
  };
  return {
      "chain",
      "The kinematic chain of eq. (1); X forward, Y left, Z up.",
      {lever("ground_to_origin_m", c.ground_to_origin_m, "ORIGIN from GROUND: east, north, up."),
       lever("origin_to_azi_m", c.origin_to_azi_m, "Crossing of the PTU's axes from its base."),
       lever("azi_to_ele_m", c.azi_to_ele_m, "Tilt axis from the pan axis."),
       lever("ele_to_focus_m", c.ele_to_focus_m, "Camera mounting from the tilt axis."),
       lever("focus_to_camera_m", c.focus_to_camera_m,
             "Camera's centre of projection from its mounting."),
       angle("mount_z_deg", c.mount_z_rad, 180.0, "Rotation of the camera on the PTU about Z."),
       angle("mount_x_deg", c.mount_x_rad, 180.0, "Rotation of the camera on the PTU about X."),
       angle("mount_y_deg", c.mount_y_rad, 180.0, "Rotation of the camera on the PTU about Y."),
       config::one_of("pan_sign", c.pan_sign, {1, -1}, "",
                      "1: the unit counts pan to the left, -1: to the right."),
       config::one_of("tilt_sign", c.tilt_sign, {1, -1}, "",
                      "1: the unit counts tilt upwards, -1: downwards."),
       angle("pan_zero_deg", c.pan_zero_rad, 360.0,
             "Shaft angle of the pan axis at reported zero: shaft = sign * reported + zero."),
       angle("tilt_zero_deg", c.tilt_zero_rad, 360.0,
             "Shaft angle of the tilt axis at reported zero.")}};
}

Section lens_section(StationSettings& settings) {
  CameraIntrinsics& lens = settings.station.geometry.camera;
  const auto term = [](const char* key, double& field, double limit, const char* sentence) {
    return config::number(key, field, {-limit, limit}, "", sentence);
  };
  return {
      "lens",
      "The camera's calibration, in OpenCV's models or a polynomial.",
      {config::word("model", lens.model, lens_model_words(),
                    "pinhole: OpenCV's; fisheye: OpenCV's; polynomial: the radius is theta (1 + k1 "
                    "theta + k2 theta^2 + k3 theta^3 + k4 theta^4), theta being the angle off the "
                    "axis. The last two are for wide cameras without a motor."),
       config::number("fx_px", lens.fx_px, {1.0, 1e7}, "px", "Focal length along x.").required(),
       config::number("fy_px", lens.fy_px, {1.0, 1e7}, "px", "Focal length along y.").required(),
       config::number("cx_px", lens.cx_px, {-1e5, 1e5}, "px", "Principal point, x.")
           .default_is("middle of the image"),
       config::number("cy_px", lens.cy_px, {-1e5, 1e5}, "px", "Principal point, y.")
           .default_is("middle of the image"),
       config::number("skew", lens.skew, {-1e5, 1e5}, "px", "Skew of the pixel axes."),
       term("k1", lens.k1, 1e3, "Radial distortion, second order."),
       term("k2", lens.k2, 1e6, "Radial distortion, fourth order."),
       term("p1", lens.p1, 1e3, "Tangential distortion."),
       term("p2", lens.p2, 1e3, "Tangential distortion."),
       term("k3", lens.k3, 1e9, "Radial distortion, sixth order."),
       term("k4", lens.k4, 1e9, "Fourth term of a fisheye or polynomial.")},
      {},
      [&settings, &lens](ConfigTable& table) {
        lens.width_px = settings.camera->config().width_px;
        lens.height_px = settings.camera->config().height_px;
        if (!table.has("cx_px")) lens.cx_px = (lens.width_px - 1) / 2.0;
        if (!table.has("cy_px")) lens.cy_px = (lens.height_px - 1) / 2.0;
        const std::string foreign = foreign_coefficients(lens);
        if (!foreign.empty()) throw table.error("model", "has no " + foreign);
      }};
}

// Only a person can say how well the heading and the camera's mounting are known; a zero by default
// would make every position overconfident.
Section calibration_section(StationSettings& settings) {
  CalibrationSd& sd = settings.station.geometry.sd;
  return {"calibration",
          "Which calibration this is.",
          {config::integer("id", settings.calibration_id, 0, INT64_MAX, "",
                           "Its number, stated in every bearing."),
           config::number("view_check_s", settings.view_check_s, {0.0, 1e6}, "s",
                          "A station with `folder` that is idle for so long looks at its reference "
                          "views; 0: never."),
           config::text("folder", settings.calibration_folder,
                        "Folder of `ols-calibrate adjust`: instrument and setup from there, not "
                        "from [pose], [chain], [lens] and id; empty: none.")},
          {{"sd",
            "1-sigma of the errors that the calibration left; they stay from frame to frame.",
            {angle_sd("heading_deg", sd.heading_rad,
                      "Of the heading: 0.5 by a good compass, 0.01 by a sighted landmark.")
                 .required(),
             angle_sd("tilt_deg", sd.tilt_rad, "Of each of the two tilts."),
             angle_sd("mount_deg", sd.mount_rad,
                      "Of the camera's rotation on the PTU, across the optical axis.")
                 .required(),
             angle_sd("mount_roll_deg", sd.mount_roll_rad,
                      "Of the camera's rotation on the PTU, about the optical axis."),
             config::number("position_m", sd.position_m, {0.0, 1e5}, "m",
                            "Of the position, each of east, north, up.")}}}};
}

Section serials_section(InstrumentSerials& serials) {
  return {"serials",
          "Serial numbers of the parts; a calibration of others is refused.",
          {config::text("camera", serials.camera, "Of the camera."),
           config::text("lens", serials.lens, "Of the lens."),
           config::text("ptu", serials.ptu, "Of the pan-tilt unit.")}};
}

Section clock_section(clock::ClockWatch::Config& clock) {
  return {"clock",
          "The clock of the station's computer.",
          {config::number("sd_s", clock.assumed_sd_s, {0.0, 1e4}, "s",
                          "1-sigma of UTC where no time service states one."),
           config::number("distrust_s", clock.distrust_s, {0.0, 1e5}, "s",
                          "A step that no time service confirms is distrusted for this long."),
           config::number("drift_per_s", clock.drift_per_s, {0.0, 1e-2}, "s/s",
                          "Drift of the clock without its time service.")}};
}

Section land_section(StationSettings& settings) {
  return {"land",
          "The land around the site (docs/land.md).",
          {config::text("folder", settings.land_folder,
                        "Folder that `ols-land import` has made, as the fusion has it: the skyline "
                        "in the pictures checks the heading. Empty: no land is known.")}};
}

Section watchdog_section(StationSettings& settings) {
  HostConfig& host = settings.host;
  return {"watchdog",
          "Alarms of the station's own computer.",
          {config::text("disk_folder", host.disk_folder, "Folder whose file system is watched.")
               .default_is("the recorder's folder, or \"/\""),
           config::number("disk_alarm_bytes", host.disk_alarm_bytes, {0.0, 1e15}, "byte",
                          "Less free space raises an alarm."),
           config::number("cpu_alarm_degC", host.cpu_alarm_degC, {0.0, 200.0}, "degC",
                          "A higher processor temperature raises an alarm.")},
          {},
          [&settings](ConfigTable& table) {
            const std::string& recordings = settings.recorder.folder;
            if (!table.has("disk_folder") && !recordings.empty())
              settings.host.disk_folder = recordings;
          }};
}

Section logic_section(StationConfig& station) {
  return {"logic",
          "How the station designates, tracks, loses and finds a target.",
          {config::number("designation_sd_px", station.designation_sd_px, {0.0, 100.0}, "px",
                          "1-sigma of a designated box's centre on the target."),
           config::number("tracking_belief", station.tracking_belief, {0.0, 1.0}, "",
                          "Minimum belief of the tracker to count as tracking."),
           config::number("coast_s", station.coast_s, {0.0, 60.0}, "s",
                          "Time on the motion model after the last believed frame."),
           config::flag("acquire_by_slew", station.acquire_by_slew,
                        "A slewed station without a target searches for one."),
           config::number("own_target_s", station.own_target_s, {0.0, 3600.0}, "s",
                          "A slewed station with a lost target searches for that one for this long "
                          "first."),
           config::number("unacquired_alarm_s", station.unacquired_alarm_s, {1.0, 3600.0}, "s",
                          "Slewed for this long without finding a target raises an alarm."),
           config::number("slew_lease_max_s", station.slew_lease_max_s, {0.1, 5.0}, "s",
                          "Slews with a longer lease are refused."),
           config::number("max_age_s", station.max_age_s, {0.1, 10.0}, "s",
                          "Older frames are not tracked, older bearings not sent."),
           config::number("target_acceleration_deg_s2", station.motion.acceleration_sd_rad_s2,
                          {0.0, 90.0}, in_degrees("deg/s^2"),
                          "1-sigma of the target's angular acceleration, in the motion model.")}};
}

Section detector_section(DetectionConfig& detection) {
  return {"detector",
          "Finds what flies or moves without a designation, and sends bearings of it.",
          {config::flag("enabled", detection.enabled, "Whether the station looks by itself."),
           config::number("rate_hz", detection.rate_hz, {4.0, 20.0}, "1/s",
                          "Maximum rate of the images that it looks at."),
           config::number("false_alarms_per_hour", detection.detector.tracklets.false_an_hour,
                          {1e-3, 1000.0}, "1/h",
                          "How many confirmed objects may be none; fewer are confirmed later."),
           config::integer("max_bearings", detection.max_bearings, 1, 16, "",
                           "Maximum number of bearings of an image, the likeliest objects.")}};
}

Section watch_section(WatchConfig& watch) {
  auto middle = std::make_shared<AzimuthElevation>();
  return {
      "watch",
      "Where the station looks while nobody wants its unit.",
      {config::number("azimuth_deg", middle->azimuth_rad, {-360.0, 360.0}, in_degrees(),
                      "Middle of its field of regard, clockwise from true north; both or none.")
           .default_is("the unit stays where it was left"),
       config::number("elevation_deg", middle->elevation_rad, {-90.0, 90.0}, in_degrees(),
                      "The same, above the horizon."),
       config::numbers("size_deg", {watch.size_rad.data(), 2}, {0.0, 360.0}, in_degrees(),
                       "Width and height of the field; what is larger than the picture is looked "
                       "at picture by picture."),
       config::number("stay_s", watch.stay_s, {0.5, 3600.0}, "s",
                      "Time at each picture; up to 10 s while the detector sees an object.")},
      {},
      [&watch, middle](ConfigTable& table) {
        const bool either = table.has("azimuth_deg"), other = table.has("elevation_deg");
        if (either != other)
          throw table.error(either ? "elevation_deg" : "azimuth_deg", "is missing");
        if (either) watch.middle = *middle;
      }};
}

Section mount_section(ChosenMount& mount) {
  Section section = mount.section("mount", "What carries the camera.");
  section.former_name = "ptu";
  return section;
}

// What is not surveyed comes from the sensors. Without a surveyed tilt and an inclinometer the head
// is taken as roughly level, unless [calibration.sd] states how well it was levelled.
void use_survey(ConfigTable& root, StationSettings& settings) {
  ConfigTable& pose = root.table("pose");
  const StationGeometry& geometry = settings.station.geometry;
  sensors::PoseEstimator::Config& estimator = settings.pose;
  bool any_place = !settings.gnss->is_configured();
  for (const char* key : {"latitude_deg", "longitude_deg", "height_m"})
    any_place = any_place || pose.has(key);
  if (any_place) {
    for (const char* key : {"latitude_deg", "longitude_deg", "height_m"})
      if (!pose.has(key)) throw pose.error(key, "is missing");
    estimator.surveyed_position = geometry.position;
    estimator.surveyed_position_sd_m = geometry.sd.position_m;
  }
  const bool levelled = !settings.inclinometer->is_configured() &&
                        root.table("calibration").table("sd").has("tilt_deg");
  if (pose.has("tilt_x_deg") || pose.has("tilt_y_deg") || levelled) {
    estimator.surveyed_tilt_rad =
        Eigen::Vector2d(geometry.chain.tilt_x_rad, geometry.chain.tilt_y_rad);
    estimator.surveyed_tilt_sd_rad = geometry.sd.tilt_rad;
  }
}

// The tracker of a station that follows by itself, and its calibration, are for one focal length.
void use_lens(ConfigTable& root, StationSettings& settings) {
  lens::LensMotorConfig& lens = settings.lens;
  if (lens.device.empty()) return;
  ConfigTable& section = root.table("lens_motor");
  if (!settings.station.overview) throw section.error("device", "needs kind = \"overview\"");
  if (!settings.calibration_folder.empty()) {
    throw section.error("device", "[calibration] folder is of a lens that does not zoom");
  }
  for (ZoomPoint& point : lens.points) {
    point.camera.width_px = settings.camera->config().width_px;
    point.camera.height_px = settings.camera->config().height_px;
  }
  settings.station.zoom.emplace(ZoomTable(lens.points), lens.position_sd);
}

void check_mount(const ConfigTable& root, const StationSettings& settings) {
  if (settings.station.overview && !settings.mount->traits().moves) {
    throw root.error("kind", "an overview station is driven by a person: its mount must move");
  }
  if (settings.station.watch.middle && !settings.mount->traits().moves) {
    throw root.error("watch", "is for a mount that moves");
  }
  // The image's motion with the mount is predicted as that of a pinhole.
  if (settings.station.geometry.camera.model != LensModel::kPinhole &&
      settings.mount->traits().moves) {
    throw root.error("lens", "a fisheye or polynomial is for a camera whose mount is \"fixed\"");
  }
}

// A setting of one part that is also an input of another.
void pass_on(StationSettings& settings) {
  StationConfig& station = settings.station;
  sensors::set_sensors(settings.pose, settings.inclinometer->config(), settings.gnss->config());
  const bool sees_colour = settings.tracker.mode == tracker::TrackerMode::kFull;
  settings.keep_raw = sees_colour || !settings.recorder.folder.empty();
  station.search_sd_px = std::min(station.search_sd_px, max_search_sd_px(station));
  const mount::Traits mount = settings.mount->traits();
  station.angles = mount.angles;
  station.limits = mount.limits;
  station.moves = mount.moves;
  station.homing_allowed = mount.may_home;
  station.rearm_over_bus = settings.gpio.rearm_over_bus;
}

}  // namespace

Section station_section(StationSettings& s) {
  return {
      "",
      "",
      {config::text("id", s.id, "Name of the station, part of the names of its channels.", check_id)
           .required(),
       config::word("kind", s.station.overview, {{"tracking", false}, {"overview", true}},
                    "tracking: follows by itself and by slews; overview: driven by a person, with "
                    "a zoom lens."),
       config::bus_url(s.lcm_url),
       config::text("state_folder", s.state_folder,
                    "Folder of the state that survives a restart; it must exist.")
           .default_is("$STATE_DIRECTORY"),
       config::number("status_interval_s", s.status_interval_s, {0.05, 60.0}, "s",
                      "Interval of the status messages."),
       config::number("preview_interval_s", s.preview_interval_s, {0.0, 60.0}, "s",
                      "Interval of the preview images; 0: none."),
       config::integer("tracker_seed", s.tracker_seed, 0, INT64_MAX, "",
                       "Seed of the tracker's random numbers.")},
      {pose_section(s),
       chain_section(s.station.geometry.chain),
       calibration_section(s),
       serials_section(s.serials),
       s.camera.section("camera", "The camera."),
       lens_section(s),
       mount_section(s.mount),
       lens::lens_motor_section(s.lens),
       tracker::tracker_section(s.tracker),
       detector_section(s.station.detection),
       watch_section(s.station.watch),
       logic_section(s.station),
       s.inclinometer.section("inclinometer", "The inclinometer."),
       s.gnss.section("gnss", "The GNSS receiver."),
       gpio::gpio_section(s.gpio),
       recorder::recorder_section(s.recorder),
       video::video_section(s.video),
       clock_section(s.clock),
       land_section(s),
       watchdog_section(s),
       trust::trust_section(s.trust)},
      [&s](ConfigTable& root) {
        use_survey(root, s);
        use_lens(root, s);
        check_mount(root, s);
        pass_on(s);
      }};
}

StationSettings load_station_settings(const std::string& path) {
  return load_station_settings(path, {});
}

}  // namespace ols::station
