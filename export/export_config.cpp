#include "export/export_config.h"

#include <algorithm>
#include <cctype>
#include <span>
#include <stdexcept>

#include "base/config/config_common.h"
#include "export/sapient/identifiers.h"

namespace ols::exports {
namespace {

struct FormatRow {
  Format format;
  const char* name;
  bool needs_geoid;
  std::vector<Scheme> schemes;
};

const std::vector<FormatRow>& formats() {
  static const std::vector<FormatRow> kFormats{
      {Format::kCot, "cot", false, {Scheme::kUdp, Scheme::kTcp, Scheme::kTls}},
      {Format::kCotProtobuf, "cot-protobuf", false, {Scheme::kUdp, Scheme::kTcp, Scheme::kTls}},
      {Format::kGeoJson, "geojson", false, {Scheme::kFile}},
      {Format::kKml, "kml", true, {Scheme::kFile}},
      {Format::kGpx, "gpx", true, {Scheme::kFile}},
      {Format::kCourageous, "courageous", true, {Scheme::kFile}},
      {Format::kMqtt, "mqtt", false, {Scheme::kMqtt, Scheme::kMqtts}},
      {Format::kAsterix, "asterix", false, {Scheme::kUdp}},
      {Format::kSapient, "sapient", false, {Scheme::kTcp, Scheme::kTls}}};
  return kFormats;
}

const FormatRow& row_of(Format format) {
  return *std::ranges::find(formats(), format, &FormatRow::format);
}

void check_topic(const std::string& topic) {
  const bool is_good = !topic.empty() && topic.size() <= 200 && !topic.ends_with('/') &&
                       topic.find_first_of("+#\"\\ ") == std::string::npos;
  if (!is_good) throw std::invalid_argument("is not a prefix of MQTT topics");
}

// An event's type goes into XML as it is.
void check_cot_type(const std::string& type) {
  const bool is_good =
      !type.empty() && type.size() <= 60 &&
      std::ranges::all_of(type, [](unsigned char c) { return std::isalnum(c) != 0 || c == '-'; });
  if (!is_good) throw std::invalid_argument("is not a type of events such as a-u-A");
}

void check_output(const OutputConfig& output, ConfigTable& table) {
  try {
    const Address address = parse_address(output.to);
    const FormatRow& format = row_of(output.format);
    if (std::ranges::find(format.schemes, address.scheme) == format.schemes.end()) {
      throw std::invalid_argument(std::string("the format ") + format.name + " cannot be sent to " +
                                  to_string(address.scheme) + "://");
    }
  } catch (const std::invalid_argument& bad) {
    throw table.error("to", bad.what());
  }
  config::check_area(output.gate.area_deg, "area_deg", table);
  if (output.certificate.empty() != output.key.empty()) {
    throw table.error(output.key.empty() ? "certificate" : "key",
                      "certificate and key belong together");
  }
  if (output.user.empty() && !output.password_file.empty()) {
    throw table.error("user", "a password belongs to a user");
  }
}

config::Section outputs_section(ExportConfig& config) {
  return {"output", "A receiver; there is none by default.",     {}, {},
          {},       [&config] { return output_section(config); }};
}

config::Section cot_section(CotSettings& c) {
  return {
      "cot",
      "Cursor on Target.",
      {config::text(
           "target_type", c.target_type,
           "Type of a target's events. If it is only a-…-A, that of a drone has -M-F-Q added.",
           check_cot_type),
       config::text("station_type", c.station_type, "Type of a station's events.", check_cot_type),
       config::number("stale_s", c.stale_s, {1.0, 3600.0}, "s",
                      "Clients fade an object after this long without news."),
       config::number("line_m", c.line_m, {10.0, 1e6}, "m", "How far lines and cones are drawn.")}};
}

config::Section mqtt_section(MqttSettings& h) {
  return {
      "mqtt",
      "MQTT with Home Assistant's discovery.",
      {config::text("prefix", h.prefix, "Prefix of the topics, before the name of the site.",
                    check_topic),
       config::text("discovery_prefix", h.discovery_prefix,
                    "Home Assistant's own prefix of discovery.", check_topic),
       config::number(
           "stale_s", h.stale_s, {0.0, 3600.0}, "s",
           "Home Assistant shows an entity as unavailable after this long without news; 0: never."),
       config::integer("slots", h.slots, 1, 64, "",
                       "Number of targets that have entities at the same time.")}};
}

config::Section asterix_section(AsterixSettings& a) {
  return {"asterix",
          "ASTERIX: CAT062, 063, 065 and 015.",
          {config::integer("sac", a.sac, 0, 255, "", "System area code, from EUROCONTROL's list."),
           config::integer("sic", a.sic, 0, 255, "", "Our own system identification code."),
           config::texts("stations", a.stations,
                         "Stations whose state and lines are sent; their identification codes "
                         "follow ours in this order.")},
          {},
          [&a](ConfigTable& table) {
            if (a.sic + static_cast<int>(a.stations.size()) > 255) {
              throw table.error("stations", "more than there are identification codes after sic");
            }
          }};
}

config::Section courageous_section(CourageousSettings& c) {
  constexpr const char* kOfStation = "that of a station";
  return {
      "courageous",
      "COURAGEOUS: the place of the system, which the format demands.",
      {config::number("latitude_deg", c.latitude_deg, {-90.0, 90.0}, "deg", "Latitude, WGS84.")
           .default_is(kOfStation),
       config::number("longitude_deg", c.longitude_deg, {-180.0, 180.0}, "deg", "Longitude, WGS84.")
           .default_is(kOfStation),
       config::number("height_above_sea_m", c.height_above_sea_m, {-1000.0, 10000.0}, "m",
                      "Height above the sea.")
           .default_is(kOfStation)},
      {},
      [&c](ConfigTable& table) {
        const bool any = table.has("latitude_deg") || table.has("longitude_deg") ||
                         table.has("height_above_sea_m");
        if (any && !c.has_place()) {
          throw table.error("latitude_deg",
                            "this, longitude_deg and height_above_sea_m belong "
                            "together");
        }
      }};
}

// This format demands the system's place: without one, the file would never be written.
void check_places(const ExportConfig& config, ConfigTable& root) {
  for (const OutputConfig& output : config.outputs) {
    if (output.format != Format::kCourageous || config.courageous.has_place()) continue;
    if (output.gate.stations || output.gate.lines) continue;
    throw root.error("output", "\"" + output.name +
                                   "\": courageous demands the place of the system: send stations, "
                                   "or state it in [courageous]");
  }
}

void check_node(const std::string& id) {
  if (!id.empty() && !is_uuid(id)) {
    throw std::invalid_argument("is not a UUID of version 4 in lower case");
  }
}

config::Section sapient_section(SapientSettings& s) {
  return {"sapient",
          "SAPIENT, BSI Flex 335 v2.0.",
          {config::text("node_id", s.node_id,
                        "UUID by which others know this site; empty: computed from its name.",
                        check_node),
           config::number("status_s", s.status_s, {1.0, 60.0}, "s",
                          "Interval of the reports of the stations' state.")}};
}

void check_names(const ExportConfig& config, ConfigTable& root) {
  std::vector<std::string> names;
  for (const OutputConfig& output : config.outputs) names.push_back(output.name);
  config::check_distinct(names, "output", root);
}

}  // namespace

config::Section output_section(ExportConfig& config) {
  OutputConfig& o = config.outputs.emplace_back();
  return {
      "",
      "",
      {config::text("name", o.name, "Name of the output in status and log.", config::word_up_to(40))
           .required_with_section(),
       config::word("format", o.format, config::words_of(formats(), &FormatRow::format),
                    "Format (docs/exports.md).")
           .required_with_section(),
       config::text("to", o.to,
                    "udp://ADDRESS:PORT?ttl=1&interface=ADDRESS, tcp://HOST:PORT, tls://HOST:PORT, "
                    "mqtt://HOST, mqtts://HOST or file:///PATH.",
                    config::not_empty)
           .required_with_section(),
       config::number("rate_hz", o.gate.rate_hz, {0.01, 100.0}, "Hz",
                      "Maximum rate of each object; of a file: how often it is written."),
       config::flag("targets", o.gate.targets, "Sends targets."),
       config::flag("tentative", o.gate.tentative,
                    "Sends also targets that are not confirmed yet."),
       config::flag("stations", o.gate.stations, "Sends stations."),
       config::flag("lines", o.gate.lines,
                    "Sends the stations' lines of sight to what they follow."),
       config::numbers("area_deg", std::span<double>(o.gate.area_deg), {-180.0, 180.0}, "deg",
                       "South, west, north, east: objects outside are not sent."),
       config::text("ca", o.ca,
                    "PEM file with the authority of the receiver's certificate; empty: the "
                    "system's authorities."),
       config::text("certificate", o.certificate,
                    "PEM file with our own certificate for the receiver; empty: none."),
       config::text("key", o.key, "PEM file with its private key."),
       config::text("user", o.user, "User name for an MQTT broker; empty: none."),
       config::text("password_file", o.password_file,
                    "File whose first line is that user's password.")},
      {},
      [&o](ConfigTable& table) { check_output(o, table); }};
}

config::Section export_section(ExportConfig& c) {
  return {
      "",
      "",
      {config::bus_url(c.lcm_url),
       config::text("site", c.site, "Name of the site; the names of objects begin with it.",
                    config::word_up_to(40)),
       config::text("geoid", c.geoid,
                    "Grid of the geoid, by its name in PROJ's folders or by its path; needed "
                    "for formats with heights above sea level.",
                    config::not_empty),
       config::status_file(c.status_file),
       config::number("max_age_s", c.max_age_s, {0.1, 3600.0}, "s",
                      "Older data, by this host's clock, are not sent."),
       config::number("history_min", c.history_min, {0.0, 1440.0}, "min",
                      "How far back the tracks in a file go.")},
      {outputs_section(c), cot_section(c.cot), mqtt_section(c.mqtt), asterix_section(c.asterix),
       courageous_section(c.courageous), sapient_section(c.sapient), trust::trust_section(c.trust)},
      [&c](ConfigTable& root) {
        c.has_own_geoid = root.has("geoid");
        check_names(c, root);
        check_places(c, root);
      }};
}

ExportConfig load_export_config(const std::string& path) {
  return config::load(path, export_section);
}

ExportConfig parse_export_config(const std::string& text, const std::string& name) {
  return config::parse(text, name, export_section);
}

bool needs_geoid(Format format) { return row_of(format).needs_geoid; }
const char* to_string(Format format) { return row_of(format).name; }

Format format_from(const std::string& name) {
  const auto row = std::ranges::find(formats(), name, &FormatRow::name);
  if (row != formats().end()) return row->format;
  std::string all;
  for (const FormatRow& known : formats()) {
    all.append(all.empty() ? "" : ", ").append(known.name);
  }
  throw std::invalid_argument("\"" + name + "\" is not a format: " + all);
}

}  // namespace ols::exports
