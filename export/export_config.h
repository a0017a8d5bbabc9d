// The contents of ols-export's configuration file: docs/configuration.md.
#pragma once

#include <deque>
#include <string>

#include "base/trust/trust_config.h"
#include "export/address.h"
#include "export/asterix/categories.h"
#include "export/files/courageous.h"
#include "export/gate.h"
#include "export/mqtt/mqtt_settings.h"
#include "export/sapient/sapient_node.h"
#include "export/tak/cot_event.h"

namespace ols::config {
struct Section;
}
namespace ols::exports {

enum class Format {
  kCot,
  kCotProtobuf,
  kGeoJson,
  kKml,
  kGpx,
  kCourageous,
  kMqtt,
  kAsterix,
  kSapient
};

struct OutputConfig {
  std::string name;
  Format format = Format::kCot;
  std::string to;  // parse_address()
  GateConfig gate;
  std::string ca, certificate, key;  // PEM files
  std::string user, password_file;   // login at an MQTT broker
};

struct ExportConfig {
  std::string lcm_url = "udpm://239.255.76.67:7667?ttl=0";
  std::string site = "ols";
  std::string geoid = "egm96_15.gtx";
  bool has_own_geoid = false;  // whether the file states the geoid; if not, the site's settings may
                               // state it
  std::string status_file;
  double max_age_s = 5.0;
  double history_min = 10.0;  // length of the tracks in a file [min]
  std::deque<OutputConfig>
      outputs;  // a deque, because the configuration's table refers to its elements
  CotSettings cot;
  MqttSettings mqtt;
  AsterixSettings asterix;
  CourageousSettings courageous;
  SapientSettings sapient;  // its field `site` is not used; the site is above
  trust::TrustConfig trust;
};

config::Section export_section(ExportConfig& config);  // the whole file
// Adds an output, and returns the section of its table [[output]].
config::Section output_section(ExportConfig& config);
// Throws ConfigError.
ExportConfig load_export_config(const std::string& path);
// Parses a text instead of a file. Errors show `name` instead of the path.
ExportConfig parse_export_config(const std::string& text, const std::string& name);

// Whether the format needs a geoid, because its heights are above sea level.
bool needs_geoid(Format format);
const char* to_string(Format format);
// The format with this name, for a command line. Throws std::invalid_argument for an unknown name.
Format format_from(const std::string& name);

}  // namespace ols::exports
