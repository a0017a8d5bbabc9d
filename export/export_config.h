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
  std::string user, password_file;   // of an MQTT broker
};

struct ExportConfig {
  std::string lcm_url = "udpm://239.255.76.67:7667?ttl=0";
  std::string site = "ols";
  std::string geoid = "egm96_15.gtx";
  bool has_own_geoid = false;  // the file states a geoid; otherwise the site's settings may
  std::string status_file;
  double max_age_s = 5.0;
  double history_min = 10.0;  // of tracks in a file [min]
  std::deque<OutputConfig>
      outputs;  // a deque, because the configuration's table refers to its elements
  CotSettings cot;
  MqttSettings mqtt;
  AsterixSettings asterix;
  CourageousSettings courageous;
  SapientSettings sapient;  // without the site, which is above
  trust::TrustConfig trust;
};

config::Section export_section(ExportConfig& config);  // the whole file
// For a new output: a table of the array.
config::Section output_section(ExportConfig& config);
// Throws ConfigError.
ExportConfig load_export_config(const std::string& path);
// The same from text. Errors give `name` instead of the path.
ExportConfig parse_export_config(const std::string& text, const std::string& name);

// Whether the format's heights are above sea level, so that it needs a geoid.
bool needs_geoid(Format format);
const char* to_string(Format format);
// From its name on a command line. Throws std::invalid_argument.
Format format_from(const std::string& name);

}  // namespace ols::exports
