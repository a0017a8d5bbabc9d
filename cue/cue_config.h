// The contents of ols-cue's configuration file: docs/configuration.md.
#pragma once

#include <deque>
#include <string>
#include <vector>

#include "base/trust/trust_config.h"
#include "cue/live_cues.h"

namespace ols::config {
struct Section;
}
namespace ols::cues {

enum class Format { kCot, kAircraftJson, kSbs, kJson, kSapient };

struct InputConfig {
  Format format = Format::kCot;
  std::string from;                      // see parse_source()
  double poll_s = 1.0;                   // interval of reading; only for a file or a web address
  std::vector<std::string> types{"a-"};  // only for CoT events
  InputRules rules;
};

struct CueConfig {
  std::string lcm_url = "udpm://239.255.76.67:7667?ttl=0";
  std::string geoid = "egm96_15.gtx";
  std::string status_file;
  int most = 32;
  std::deque<InputConfig> inputs;  // a deque, because the configuration's table refers to its
                                   // elements
  trust::TrustConfig trust;
};

config::Section cue_section(CueConfig& config);  // the whole file
// Adds an input, and returns the section of its table [[input]].
config::Section input_section(CueConfig& config);
// Throws ConfigError.
CueConfig load_cue_config(const std::string& path);
// Parses a text instead of a file. Errors show `name` instead of the path.
CueConfig parse_cue_config(const std::string& text, const std::string& name);
const char* to_string(Format format);

}  // namespace ols::cues
