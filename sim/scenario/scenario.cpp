#include "sim/scenario/scenario.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <memory>
#include <stdexcept>
#include <utility>

#include "edge/config/config_units.h"
#include "sim/scenario/scenario_places.h"
#include "sim/scenario/scenario_relief.h"
#include "sim/scenario/scenario_trajectory.h"

namespace ols::sim {
namespace {

using config::Row;
using config::Section;

// Values without a configuration row: the optics as data sheets state them.
struct Optics {
  double focal_length_mm = 50.0, pixel_um = 3.75;
  LensModel model = LensModel::kPinhole;
  std::array<double, 5> distortion{};
  double k4 = 0.0;
};

Row angle(const char* key, double& field_rad, config::Range range_deg, const char* sentence) {
  return config::number(key, field_rad, range_deg, station::in_degrees(), sentence);
}

Section site_section(Geodetic& origin) {
  return {"site",
          "Origin of the site's east-north-up frame.",
          {angle("latitude_deg", origin.latitude_rad, {-90, 90}, "WGS84 latitude.").required(),
           angle("longitude_deg", origin.longitude_rad, {-180, 180}, "WGS84 longitude.").required(),
           config::number("height_m", origin.height_m, {-1000, 9000}, "m",
                          "Height above the ellipsoid.")
               .required()}};
}

void use_lens(ConfigTable& table, const Optics& optics, CameraIntrinsics& c) {
  c.model = optics.model;
  c.fx_px = c.fy_px = optics.focal_length_mm * 1e3 / optics.pixel_um;
  c.k1 = optics.distortion[0], c.k2 = optics.distortion[1];
  c.p1 = optics.distortion[2], c.p2 = optics.distortion[3], c.k3 = optics.distortion[4];
  c.k4 = optics.k4;
  const std::string foreign = foreign_coefficients(c);
  if (!foreign.empty()) throw table.error("lens", "has no " + foreign);
  for (const double x : {-0.5, c.width_px - 0.5}) {
    for (const double y : {-0.5, c.height_px - 0.5}) {
      if (!unproject(c, {x, y}))
        throw table.error("distortion", "leaves a corner without an image");
    }
  }
}

void centre(ConfigTable& table, CameraIntrinsics& c) {
  const auto place = [&table](const char* key, double& field, int size) {
    if (!table.has(key)) field = 0.5 * (size - 1);
    if (field > size) throw table.error(key, "is outside of the image");
  };
  place("cx_px", c.cx_px, c.width_px);
  place("cy_px", c.cy_px, c.height_px);
}

std::vector<Row> lens_rows(Optics& optics) {
  return {
      config::number("focal_length_mm", optics.focal_length_mm, {1, 1000}, "mm", "Focal length."),
      config::word("lens", optics.model, station::lens_model_words(),
                   "The model of the lens; all but the pinhole only for stations that stand "
                   "still."),
      config::numbers("distortion", optics.distortion, {-10, 10}, "", "k1, k2, p1, p2, k3."),
      config::number("k4", optics.k4, {-10, 10}, "", "Fourth term of a fisheye or polynomial.")};
}

Section camera_section(Scenario& s) {
  constexpr config::Range kPixels{0, 2048};
  CameraIntrinsics& c = s.camera;
  auto optics = std::make_shared<Optics>();
  std::vector<Row> rows{
      config::integer("width_px", c.width_px, 64, 2048, "px", "Width of the image."),
      config::integer("height_px", c.height_px, 64, 2048, "px", "Height of the image."),
      config::number("pixel_um", optics->pixel_um, {1, 20}, "um", "Pixel pitch."),
      config::number("cx_px", c.cx_px, kPixels, "px", "Principal point, x.")
          .default_is("middle of the image"),
      config::number("cy_px", c.cy_px, kPixels, "px", "Principal point, y.")
          .default_is("middle of the image"),
      config::number("frame_rate_hz", s.frame_rate_hz, {1, 60}, "Hz", "Frame rate."),
      config::number("exposure_ms", s.exposure_s, {0.01, 100}, config::kMilliseconds,
                     "Exposure time."),
      config::number("readout_ms", s.readout_s, {0, 100}, config::kMilliseconds,
                     "From the end of the exposure to the first packet.")};
  std::ranges::move(lens_rows(*optics), std::back_inserter(rows));
  return {"camera", "The camera of every station.", rows, {}, [&s, optics](ConfigTable& table) {
            s.px_per_mm = 1e3 / optics->pixel_um;
            centre(table, s.camera);
            use_lens(table, *optics, s.camera);
          }};
}

Section ptu_section(PtuScenario& p) {
  return {"ptu",
          "The pan-tilt unit of every station.",
          {config::integer("baud", p.baud, 600, 115200, "baud", "Rate of the serial line."),
           config::number("poll_interval_ms", p.poll_interval_s, {5, 1000}, config::kMilliseconds,
                          "Interval of the station's polls."),
           config::flag("home_at_power_up", p.home_at_power_up,
                        "Whether it homes first, for about 20 s, without answering.")}};
}

Section onvif_section(OnvifScenario& o) {
  constexpr const char *kSpeed = "deg/s", *kAcceleration = "deg/s^2";
  return {"onvif",
          "The ONVIF PTZ camera of every station with mount = \"onvif\".",
          {config::integer("port", o.port, 1, 65535, "", "TCP port of its device service."),
           config::number("max_speed_deg_s", o.max_speed_rad_s, {1, 360},
                          station::in_degrees(kSpeed), "Maximum speed of each axis."),
           config::number("acceleration_deg_s2", o.acceleration_rad_s2, {1, 3600},
                          station::in_degrees(kAcceleration), "Acceleration of each axis."),
           config::number("command_delay_ms", o.command_delay_s, {0, 2000}, config::kMilliseconds,
                          "From the arrival of a command to the motion."),
           angle("repeatability_deg", o.repeatability_rad, {0, 5},
                 "1-sigma by which a move misses a position; it is not reported."),
           config::number("boot_s", o.boot_s, {0, 600}, "s", "Duration of a reboot.")}};
}

Section inclinometer_section(InclinometerScenario& i) {
  return {"inclinometer",
          "The inclinometer of every station.",
          {config::flag("on", i.on, "Whether there is one."),
           angle("zero_sd_deg", i.zero_sd_rad, {0, 5}, "1-sigma of the zero of each axis."),
           angle("noise_sd_deg", i.noise_sd_rad, {0, 5}, "1-sigma of the noise.")}};
}

Section gnss_section(GnssScenario& g) {
  return {"gnss",
          "The GNSS receiver of every station.",
          {config::flag("on", g.on, "Whether there is one."),
           config::number("sd_m", g.sd_m, {1e-3, 100}, "m",
                          "1-sigma of each of east and north; of up half as much again."),
           config::numbers("ground_to_antenna_enu_m", {g.ground_to_antenna_enu_m.data(), 3},
                           {-100, 100}, "m", "Antenna from GROUND: east, north, up."),
           config::integer("gpsd_port", g.gpsd_port, 1024, 65000, "",
                           "Port of the first station's gpsd; the others follow.")}};
}

Section landscape_section(Landscape& l) {
  return {
      "landscape",
      "What stands around the site.",
      {angle("ridge_mean_deg", l.ridge_mean_rad, {-10, 40}, "Mean elevation of the ridge."),
       angle("ridge_relief_deg", l.ridge_relief_rad, {0, 30}, "Its maximum deviation from that."),
       config::number("cloudiness", l.cloudiness, {0, 2}, "", "0: clear sky."),
       config::number("haze", l.haze, {0, 1}, "", "Share of air light before the slopes."),
       config::integer("seed", l.seed, 0, 1 << 30, "", "Seed of its shapes."),
       config::flag("sun", l.sun, "Whether the sun shows, where it really stands.")}};
}

Section error_section(const char* name, const char* sentence, Errors::Switch& error,
                      const std::vector<Row>& rows = {}) {
  std::vector<Row> all{config::flag("on", error.on, "Whether there is this error.")};
  all.insert(all.end(), rows.begin(), rows.end());
  return {name, sentence, all};
}

std::vector<Section> pose_errors(Errors& e) {
  return {
      error_section("heading", "What calibration left of the heading.", e.heading,
                    {angle("sd_deg", e.heading.sd_rad, {0, 5}, "1-sigma.")}),
      error_section("tilt", "What calibration left of the tilt.", e.tilt,
                    {angle("sd_deg", e.tilt.sd_rad, {0, 5}, "1-sigma of each axis.")}),
      error_section("mounting", "What calibration left of the camera's mounting.", e.mounting,
                    {angle("sd_deg", e.mounting.sd_rad, {0, 5}, "1-sigma across the optical axis."),
                     angle("roll_sd_deg", e.mounting.roll_sd_rad, {0, 5},
                           "1-sigma about the optical axis.")}),
      error_section("position", "What the survey left of the position.", e.position,
                    {config::number("sd_m", e.position.sd_m, {0, 100}, "m",
                                    "1-sigma of each of east, north, up.")}),
      error_section(
          "designation", "Where on the target the operator's box is, in the lockstep simulation.",
          e.designation,
          {config::number("sd_px", e.designation.sd_px, {0, 100}, "px", "1-sigma of each axis.")})};
}

std::vector<Section> image_errors(Errors& e) {
  return {error_section("distortion", "What calibration left of the distortion.", e.distortion,
                        {config::number("residual_k1_sd", e.distortion.residual_k1_sd, {0, 10}, "",
                                        "1-sigma of k1.")}),
          error_section(
              "noise", "Noise of the pixels.", e.noise,
              {config::number("sd_gray", e.noise.sd_gray, {0, 30}, "gray level", "1-sigma.")}),
          error_section("motion_blur", "Blur by the motion during the exposure.", e.motion_blur),
          error_section("brightness", "Uneven brightness.", e.brightness,
                        {config::number("vignetting", e.brightness.vignetting, {0, 0.9}, "",
                                        "Share of the light that is missing in the corners."),
                         config::number("gain_sd", e.brightness.gain_sd, {0, 0.3}, "",
                                        "1-sigma from station to station.")})};
}

std::vector<Row> message_rows(Errors::Messages& m) {
  return {config::number("lost", m.lost, {0, 1}, "", "Probability of a loss."),
          config::number("doubled", m.doubled, {0, 1}, "", "Probability of a duplicate."),
          config::number("late", m.late, {0, 1}, "", "Probability of a late message."),
          config::number("delay_ms", m.delay_s, {0, 1e4}, config::kMilliseconds,
                         "Delay of every message."),
          config::number("late_ms", m.late_s, {0, 1e5}, config::kMilliseconds,
                         "Further delay of a late message.")};
}

std::vector<Section> device_errors(Errors& e) {
  return {
      error_section("encoder", "Steps of the PTU's encoders.", e.encoder,
                    {config::number("step_arcsec", e.encoder.step_arcsec, {0.1, 1000}, "arcsec",
                                    "One step.")}),
      error_section(
          "clock", "Errors of the stations' clocks.", e.clock,
          {config::number("sd_ms", e.clock.sd_s, {0, 1e4}, config::kMilliseconds, "1-sigma.")}),
      error_section("ptu_reply", "Jitter of the PTU's replies.", e.ptu_reply,
                    {config::number("jitter_ms", e.ptu_reply.jitter_s, {0, 100},
                                    config::kMilliseconds, "Uniform, plus or minus.")}),
      error_section("messages", "The network between stations and fusion.", e.messages,
                    message_rows(e.messages)),
      error_section("frames", "Frames that the camera loses.", e.frames,
                    {config::number("lost", e.frames.lost, {0, 1}, "", "Probability of a loss.")})};
}

Section errors_section(Errors& e) {
  Section section{"errors", "The errors of a real site, each with a switch."};
  for (auto* part : {pose_errors, image_errors, device_errors})
    std::ranges::move(part(e), std::back_inserter(section.sections));
  return section;
}

Section unit_errors_section(UnitErrorsScenario& u) {
  return {"unit_errors",
          "What is wrong with every station's pan-tilt unit and camera, drawn from the seed.",
          {config::word("size", u.size,
                        {{"none", UnitErrors::kNone},
                         {"workshop", UnitErrors::kWorkshop},
                         {"new", UnitErrors::kNew}},
                        "none, left by a workshop's calibration, or of a unit that nobody has "
                        "measured."),
           config::number("wave_arcsec", u.wave_arcsec, {0, 1000}, "arcsec",
                          "Amplitude of the waves of the microsteps."),
           config::number("second_worm_arcsec", u.second_worm_arcsec, {0, 1000}, "arcsec",
                          "Amplitude of the worms' second harmonic."),
           config::number("jitter_arcsec", u.jitter_arcsec, {0, 1000}, "arcsec",
                          "1-sigma of each angle, new at each count.")}};
}

template <class T>
void check_id(ConfigTable& table, const std::vector<T>& all, const char* what) {
  const std::string& id = all.back().id;
  if (std::ranges::count(all, id, &T::id) > 1)
    throw table.error("id", std::string("is used by two ") + what);
}

void check_word(const std::string& id) {
  if (id.empty() || id.find_first_of("/ ") != std::string::npos)
    throw std::invalid_argument("must be a word");
}

std::vector<Row> station_rows(StationScenario& station) {
  ChainParameters& c = station.chain;
  return {
      config::text("id", station.id, "Its name.", check_word).required(),
      config::numbers("position_enu_m", {station.p_enu.data(), 3}, {-kFar_m, kFar_m}, "m",
                      "GROUND in the site's frame: east, north, up."),
      angle("heading_deg", c.heading_rad, {-360, 360},
            "Direction of the PTU's zero pan, clockwise from true north."),
      config::word("kind", station.overview, {{"tracking", false}, {"overview", true}},
                   "tracking, or overview: driven by a person."),
      config::text("camera_address", station.camera_address, "IPv4 address of its camera.")
          .required(),
      config::word("camera", station.rtsp, {{"gige", false}, {"rtsp", true}},
                   "GigE Vision, or video by RTSP (live only)."),
      config::word(
          "mount", station.mount,
          {{"ptu", MountModel::kPtu},
           {"onvif", MountModel::kOnvif},
           {"indi", MountModel::kIndi},
           {"external", MountModel::kExternal}},
          "A pan-tilt unit, that of an ONVIF PTZ camera, or, live only: an equatorial telescope "
          "mount behind an INDI server; a mount of another program, which publishes its angles as "
          "truth_ptu_t on OLS_SIM_ANGLES_<station>."),
      config::text("ptu_line", station.ptu_line, "Name of the PTU's serial line.")
          .default_is("ID.ptu"),
      config::text("ptu_device", station.ptu_device,
                   "Serial device of a real PTU in place of the simulated one; empty: none.")};
}

// The same sensor behind another lens.
void use_own_lens(ConfigTable& table, Optics optics, const Scenario& s, StationScenario& station) {
  if (!table.has("focal_length_mm")) {
    for (const char* key : {"lens", "distortion", "k4"}) {
      if (table.has(key)) throw table.error(key, "of a lens without focal_length_mm");
    }
    return;
  }
  if (!station.zoom.is_fixed()) throw table.error("focal_length_mm", "of a lens with zoom_mm");
  optics.pixel_um = 1e3 / s.px_per_mm;
  station.camera = s.camera;
  use_lens(table, optics, *station.camera);
}

Section station_section(Scenario& scenario) {
  Section section{"station", "A station."};
  section.append = [&scenario] {
    struct Keys {
      StationScenario station;
      Optics optics;
      std::array<double, 2> tilt_xy_rad{};
      std::array<double, 3> mount_zxy_rad{};
      std::array<double, 2> fixed_rad{}, watch_rad{};
    };
    auto keys = std::make_shared<Keys>();
    auto rows = station_rows(keys->station);
    rows.push_back(config::numbers("tilt_xy_deg", keys->tilt_xy_rad, {-90, 90},
                                   station::in_degrees(), "Inclination about X and Y."));
    rows.push_back(config::numbers("mount_zxy_deg", keys->mount_zxy_rad, {-45, 45},
                                   station::in_degrees(),
                                   "Rotation of the camera on the PTU about Z, X, Y."));
    rows.push_back(config::numbers("fixed_pan_tilt_deg", keys->fixed_rad, {-180, 180},
                                   station::in_degrees(),
                                   "Angles at which its camera stands still, without a PTU.")
                       .default_is("a PTU"));
    rows.push_back(config::numbers("watch_deg", keys->watch_rad, {-360, 360}, station::in_degrees(),
                                   "Azimuth and elevation at which it looks while it is idle.")
                       .default_is("where it was left"));
    rows.push_back(config::numbers("watch_size_deg", {keys->station.watch_size_rad.data(), 2},
                                   {0, 360}, station::in_degrees(),
                                   "Width and height of what it looks at there."));
    std::ranges::move(zoom_rows(keys->station.zoom), std::back_inserter(rows));
    for (Row& row : lens_rows(keys->optics)) {
      rows.push_back(std::move(row).default_is("that of [camera]"));
    }
    return Section{"", "", rows, {}, [keys, &scenario](ConfigTable& table) {
                     StationScenario& s = keys->station;
                     const std::string problem = zoom_problem(s.zoom, s.overview);
                     if (!problem.empty()) throw table.error("zoom_mm", problem);
                     ChainParameters& c = s.chain;
                     c.tilt_x_rad = keys->tilt_xy_rad[0], c.tilt_y_rad = keys->tilt_xy_rad[1];
                     c.mount_z_rad = keys->mount_zxy_rad[0];
                     c.mount_x_rad = keys->mount_zxy_rad[1];
                     c.mount_y_rad = keys->mount_zxy_rad[2];
                     if (table.has("fixed_pan_tilt_deg")) {
                       if (s.mount != MountModel::kPtu)
                         throw table.error("mount", "of a camera that stands still");
                       s.fixed = PanTilt{keys->fixed_rad[0], keys->fixed_rad[1]};
                     }
                     if (table.has("watch_deg")) {
                       s.watch = AzimuthElevation{keys->watch_rad[0], keys->watch_rad[1]};
                     }
                     if (!table.has("ptu_line")) s.ptu_line = s.id + ".ptu";
                     use_own_lens(table, keys->optics, scenario, s);
                     if (scenario.camera_of(s).model != LensModel::kPinhole && !s.fixed)
                       throw table.error("fixed_pan_tilt_deg",
                                         "is missing: such a lens stands still");
                     scenario.stations.push_back(s);
                     check_id(table, scenario.stations, "stations");
                   }};
  };
  return section;
}

Section target_section(Scenario& s, const std::string& folder) {
  Section section{"target", "A target."};
  section.append = [&s, folder] {
    auto target = std::make_shared<TargetScenario>();
    return Section{
        "",
        "",
        {config::text("id", target->id, "Its name, a word.").default_is("its number, from 1"),
         config::word("kind", target->shape,
                      {{"drone", FlyerShape::kDrone},
                       {"bird", FlyerShape::kBird},
                       {"aircraft", FlyerShape::kAircraft}},
                      "How it looks: a multicopter, a bird that beats its wings, an aeroplane."),
         config::number("span_m", target->span_m, {0.05, 100}, "m",
                        "From rotor tip to rotor tip, or from wing tip to wing tip."),
         config::number("brightness", target->brightness, {0, 2}, "",
                        "0: black, 1: as bright as the sky.")},
        {trajectory_section(target->trajectory, {s.origin, folder})},
        [target, &s](ConfigTable& table) {
          s.targets.push_back(*target);
          std::string& id = s.targets.back().id;
          if (id.empty()) id = std::to_string(s.targets.size());
          check_id(table, s.targets, "targets");
        }};
  };
  return section;
}

void check_fault(ConfigTable& table, const Fault& fault, const Scenario& s) {
  const FaultProblem problem = check(fault);
  if (!problem.key.empty()) throw table.error(problem.key, problem.what);
  if (!fault.station.empty() &&
      std::ranges::count(s.stations, fault.station, &StationScenario::id) == 0)
    throw table.error("station", "names an unknown station");
}

Section fault_section(Scenario& s) {
  Section section{"fault", "A fault of the simulated devices."};
  section.append = [&s] {
    Fault& fault = s.faults.emplace_back();
    return Section{
        "",
        "",
        {config::text("kind", fault.kind, "Its kind, for example ptu-line-cut.").required(),
         config::text("station", fault.station, "Where; empty: at all stations."),
         config::number("at_s", fault.at_s, {0.0, 1e9}, "s", "Begin, from the start.").required(),
         config::number("for_s", fault.for_s, {0.0, 1e9}, "s", "Duration.")
             .default_is("to the end"),
         config::number("value", fault.value, {-1e9, 1e9}, "", "What the kind takes.")
             .default_is("by kind")},
        {},
        [&fault, &s](ConfigTable& table) { check_fault(table, fault, s); }};
  };
  return section;
}

Scenario read_scenario(ConfigFile& file, const std::string& folder) {
  Scenario scenario;
  config::read(scenario_section(scenario, folder), file.root());
  return scenario;
}

}  // namespace

Section scenario_section(Scenario& s, const std::string& folder) {
  return {"",
          "",
          {config::text("name", s.name, "Its name.").required()},
          {site_section(s.origin),
           camera_section(s),
           ptu_section(s.ptu),
           onvif_section(s.onvif),
           inclinometer_section(s.inclinometer),
           gnss_section(s.gnss),
           {"detector",
            "The stations' detectors.",
            {config::flag("on", s.detector_on,
                          "Whether they look by themselves: each takes a part of a processor.")}},
           {"gpio",
            "The emergency stop input of every station.",
            {config::flag("on", s.gpio.on, "Whether there is one.")}},
           landscape_section(s.landscape),
           errors_section(s.errors),
           unit_errors_section(s.unit_errors),
           stationing_section(s.stationing),
           relief_section(s.relief),
           station_section(s),
           target_section(s, folder),
           mark_section(s.marks),
           boards_section(s.boards),
           fault_section(s)},
          [&s](ConfigTable& root) {
            if (s.stations.empty()) throw root.error("station", "at least one is needed");
            if (s.targets.empty()) throw root.error("target", "at least one is needed");
          }};
}

void switch_off(Errors& e, const std::string& name) {
  const std::pair<const char*, Errors::Switch*> switches[] = {{"heading", &e.heading},
                                                              {"tilt", &e.tilt},
                                                              {"mounting", &e.mounting},
                                                              {"position", &e.position},
                                                              {"designation", &e.designation},
                                                              {"encoder", &e.encoder},
                                                              {"distortion", &e.distortion},
                                                              {"noise", &e.noise},
                                                              {"motion_blur", &e.motion_blur},
                                                              {"brightness", &e.brightness},
                                                              {"clock", &e.clock},
                                                              {"ptu_reply", &e.ptu_reply},
                                                              {"messages", &e.messages},
                                                              {"frames", &e.frames}};
  std::string known;
  for (const auto& [known_name, error] : switches) {
    if (name == known_name) {
      error->on = false;
      return;
    }
    known += std::string(known.empty() ? "" : ", ") + known_name;
  }
  throw std::invalid_argument("unknown error '" + name + "'; known ones: " + known);
}

void keep_target(Scenario& scenario, const std::string& id) {
  const auto found = std::ranges::find(scenario.targets, id, &TargetScenario::id);
  if (found == scenario.targets.end()) {
    throw std::invalid_argument(scenario.name + " has no target '" + id + "'");
  }
  scenario.targets = {*found};
}

Scenario load_scenario(const std::string& path) {
  ConfigFile file(path);
  const std::size_t slash = path.rfind('/');
  return read_scenario(file, slash == std::string::npos ? "." : path.substr(0, slash));
}

Scenario parse_scenario(const std::string& text, const std::string& name,
                        const std::string& folder) {
  ConfigFile file(text, name);
  return read_scenario(file, folder);
}

}  // namespace ols::sim
