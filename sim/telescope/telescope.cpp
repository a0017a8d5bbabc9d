#include "sim/telescope/telescope.h"

#include <algorithm>
#include <pugixml.hpp>
#include <vector>

#include "conditions/printed.h"

namespace ols::sim {
namespace {

constexpr double kHour_rad = kPi / 12.0;
const double kArcSecond_rad = radians(1.0 / 3600.0);
const indi::TrackRate kSidereal{15.041067 * kArcSecond_rad, 0.0};
constexpr double kForEver_s = 1e5;

struct Value {
  std::string name, value;
};

std::string text_of(double value) { return printed("%.12g", value); }

// defNumberVector with defNumber, or setNumberVector with oneNumber; the same for switches.
std::string vector_of(const std::string& device, const std::string& kind, bool defines,
                      const std::string& property, const std::string& state,
                      const std::vector<Value>& values, const std::string& range = "") {
  const std::string verb = defines ? "def" : "set";
  std::string text = "<" + verb + kind + "Vector device=\"" + device + "\" name=\"" + property +
                     "\" state=\"" + state + "\"";
  if (defines) text += " label=\"\" group=\"\" perm=\"rw\" timeout=\"60\" rule=\"OneOfMany\"";
  text += ">\n";
  for (const auto& [name, value] : values) {
    const std::string element = (defines ? "def" : "one") + kind;
    text += "<" + element + " name=\"" + name + "\"" +
            (defines ? " label=\"\" format=\"%g\" " + range : "") + ">" + value + "</" + element +
            ">\n";
  }
  return text + "</" + verb + kind + "Vector>\n";
}

std::string on(bool is) { return is ? "On" : "Off"; }

}  // namespace

Telescope::Telescope(const TelescopeConfig& config, std::uint64_t seed, double time_s)
    : config_(config),
      unit_({.least{radians(-170.0), radians(-89.0)},
             .greatest{radians(170.0), radians(89.0)},
             .max_speed_rad_s = config.max_speed_rad_s,
             .acceleration_rad_s2 = config.acceleration_rad_s2,
             .command_delay_s = 0.02},
            seed, time_s),
      rate_(kSidereal),
      ordered_(kSidereal) {}

void Telescope::halt(double time_s) {
  unit_.stop(time_s);
  tracks_ = slews_ = false;
}

void Telescope::drive(double time_s) {
  slews_ = false;
  unit_.drive(PtzUnit::kPan, -rate_.hour_angle_rad_s, kForEver_s, time_s);
  unit_.drive(PtzUnit::kTilt, rate_.dec_rad_s, kForEver_s, time_s);
}

std::string Telescope::position(const char* verb, double time_s, double utc_s) const {
  const auto seen = unit_.reported(time_s);
  if (!seen) return "";
  const indi::Equatorial sky =
      indi::equatorial_of(indi::Axes::kEquatorial, *seen, config_.observer, utc_s);
  return vector_of(
      config_.device, "Number", std::string(verb) == "def", "EQUATORIAL_EOD_COORD",
      slews_ ? "Busy" : "Ok",
      {{"RA", text_of(sky.ra_rad / kHour_rad)}, {"DEC", text_of(degrees(sky.dec_rad))}},
      "min=\"-90\" max=\"90\" step=\"0\"");
}

std::string Telescope::report(double time_s, double utc_s) {
  if (!connected_) return "";
  if (slews_ && !unit_.moves(time_s)) slews_ = false;
  return position("set", time_s, utc_s);
}

std::string Telescope::properties(double time_s, double utc_s) const {
  const auto switches = [&](const char* name, const std::vector<Value>& values) {
    return vector_of(config_.device, "Switch", true, name, "Idle", values);
  };
  const auto numbers = [&](const char* name, const std::vector<Value>& values, double most) {
    const std::string range = "min=\"" + text_of(-most) + "\" max=\"" + text_of(most) + "\"";
    return vector_of(config_.device, "Number", true, name, "Idle", values, range + " step=\"0\"");
  };
  std::string text =
      switches("CONNECTION", {{"CONNECT", on(connected_)}, {"DISCONNECT", on(!connected_)}});
  if (!connected_) return text;
  text += position("def", time_s, utc_s);
  text += switches("ON_COORD_SET", {{"TRACK", "On"}, {"SLEW", "Off"}, {"SYNC", "Off"}});
  text += switches("TELESCOPE_ABORT_MOTION", {{"ABORT", "Off"}});
  text += switches("TELESCOPE_TRACK_MODE", {{"TRACK_SIDEREAL", "On"}, {"TRACK_CUSTOM", "Off"}});
  text +=
      switches("TELESCOPE_TRACK_STATE", {{"TRACK_ON", on(tracks_)}, {"TRACK_OFF", on(!tracks_)}});
  text += numbers("TELESCOPE_TRACK_RATE",
                  {{"TRACK_RATE_RA", text_of(15.041067)}, {"TRACK_RATE_DE", "0"}},
                  config_.max_speed_rad_s / kArcSecond_rad);
  text += switches("TELESCOPE_PARK", {{"PARK", on(parked_)}, {"UNPARK", on(!parked_)}});
  text += switches("TELESCOPE_PIER_SIDE", {{"PIER_WEST", "Off"}, {"PIER_EAST", "On"}});
  text += numbers("GEOGRAPHIC_COORD",
                  {{"LAT", text_of(degrees(config_.observer.latitude_rad))},
                   {"LONG", text_of(degrees(config_.observer.longitude_rad))},
                   {"ELEV", "0"}},
                  1e4);
  return text + numbers("POLLING_PERIOD", {{"PERIOD_MS", text_of(1e3 * interval_s_)}}, 1e6);
}

std::string Telescope::choose(const std::string& property, const std::string& chosen,
                              double time_s) {
  const auto says = [&](const std::vector<Value>& values, const char* state = "Ok") {
    return vector_of(config_.device, "Switch", false, property, state, values);
  };
  if (property == "TELESCOPE_ABORT_MOTION") {
    if (slews_) halt(time_s);
    return says({{"ABORT", "Off"}});
  }
  if (property == "TELESCOPE_TRACK_MODE") {
    ordered_ = chosen == "TRACK_SIDEREAL" ? kSidereal : ordered_;
    return says({{"TRACK_SIDEREAL", on(chosen == "TRACK_SIDEREAL")},
                 {"TRACK_CUSTOM", on(chosen == "TRACK_CUSTOM")}});
  }
  if (property == "TELESCOPE_TRACK_STATE") {
    const bool tracks = chosen == "TRACK_ON" && !parked_;
    if (tracks && !tracks_) drive(time_s);  // at the rate before: a rate counts while it tracks
    if (!tracks) halt(time_s);
    tracks_ = tracks;
    return says({{"TRACK_ON", on(tracks_)}, {"TRACK_OFF", on(!tracks_)}}, tracks ? "Busy" : "Idle");
  }
  if (property == "TELESCOPE_PARK") {
    parked_ = chosen == "PARK";
    if (parked_) {
      halt(time_s);
      for (const auto axis : {PtzUnit::kPan, PtzUnit::kTilt})
        unit_.go_to(axis, 0.0, config_.max_speed_rad_s, time_s);
    }
    return says({{"PARK", on(parked_)}, {"UNPARK", on(!parked_)}});
  }
  return property == "ON_COORD_SET" ? says({{chosen, "On"}}) : "";
}

std::string Telescope::set(const std::string& property, double first, double second, double time_s,
                           double utc_s) {
  const auto says = [&](const char* state, const std::vector<Value>& values) {
    return vector_of(config_.device, "Number", false, property, state, values);
  };
  if (property == "POLLING_PERIOD") {
    interval_s_ = std::clamp(1e-3 * first, 0.01, 600.0);
    return says("Ok", {{"PERIOD_MS", text_of(first)}});
  }
  if (property == "TELESCOPE_TRACK_RATE") {
    const indi::TrackRate wanted{first * kArcSecond_rad, second * kArcSecond_rad};
    const bool reverses = wanted.hour_angle_rad_s * ordered_.hour_angle_rad_s < 0.0 ||
                          wanted.dec_rad_s * ordered_.dec_rad_s < 0.0;
    if (tracks_ && reverses) return says("Alert", {});
    ordered_ = wanted;
    if (tracks_) {
      rate_ = wanted;
      drive(time_s);
    }
    return says("Ok", {{"TRACK_RATE_RA", text_of(first)}, {"TRACK_RATE_DE", text_of(second)}});
  }
  if (property != "EQUATORIAL_EOD_COORD" || parked_) return "";
  const PanTilt to = indi::axes_of(indi::Axes::kEquatorial, {first * kHour_rad, radians(second)},
                                   config_.observer, utc_s, 0.0);
  halt(time_s);
  slews_ = true;
  unit_.go_to(PtzUnit::kPan, to.pan_rad, config_.max_speed_rad_s, time_s);
  unit_.go_to(PtzUnit::kTilt, to.tilt_rad, config_.max_speed_rad_s, time_s);
  return position("set", time_s, utc_s);
}

std::string Telescope::answer(const std::string& element, double time_s, double utc_s) {
  pugi::xml_document document;
  if (!document.load_buffer(element.data(), element.size())) return "";
  const pugi::xml_node root = document.first_child();
  const std::string verb = root.name(), property = root.attribute("name").value();
  if (verb == "getProperties") return properties(time_s, utc_s);
  if (config_.device != root.attribute("device").value()) return "";
  if (verb == "newSwitchVector") {
    for (const pugi::xml_node one : root.children("oneSwitch")) {
      if (std::string(one.text().get()).find("On") == std::string::npos) continue;
      const std::string chosen = one.attribute("name").value();
      if (property != "CONNECTION") return connected_ ? choose(property, chosen, time_s) : "";
      connected_ = chosen == "CONNECT";
      return vector_of(config_.device, "Switch", false, property, "Ok",
                       {{"CONNECT", on(connected_)}, {"DISCONNECT", on(!connected_)}}) +
             properties(time_s, utc_s);
    }
  }
  if (verb != "newNumberVector" || !connected_) return "";
  const pugi::xml_node first = root.child("oneNumber");
  return set(property, first.text().as_double(), first.next_sibling("oneNumber").text().as_double(),
             time_s, utc_s);
}

}  // namespace ols::sim
