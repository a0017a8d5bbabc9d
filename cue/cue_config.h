// What ols-cue's configuration file holds: docs/configuration.md.
#pragma once

#include <deque>
#include <string>
#include <vector>

#include "base/trust/trust_config.h"
#include "cue/cue_desk.h"

namespace ols::config {
struct Section;
}
namespace ols::cues {

enum class Format { kCot, kAircraftJson, kSbs, kJson, kSapient };

struct InputConfig {
  Format format = Format::kCot;
  std::string from;                      // parse_source()
  double poll_s = 1.0;                   // of a file or a web address
  std::vector<std::string> types{"a-"};  // of CoT's events
  InputRules rules;
};

struct CueConfig {
  std::string lcm_url = "udpm://239.255.76.67:7667?ttl=0";
  std::string geoid = "egm96_15.gtx";
  std::string status_file;
  int most = 32;
  std::deque<InputConfig> inputs;  // whose places stay, as the configuration's table refers to them
  trust::TrustConfig trust;
};

config::Section cue_section(CueConfig& config);  // the whole file
// Of a new input: a table of the array.
config::Section input_section(CueConfig& config);
// Throws ConfigError.
CueConfig load_cue_config(const std::string& path);
// The same from text, `name` standing for the path in errors.
CueConfig parse_cue_config(const std::string& text, const std::string& name);
const char* to_string(Format format);

}  // namespace ols::cues
