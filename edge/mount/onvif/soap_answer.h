// Parses the answers of an ONVIF camera. Pure. Elements are found by their local names, because
// cameras differ in their prefixes and some do not declare them. Only the five entities of XML are
// expanded; document types are ignored. If a value is missing, not a finite number, or absurdly
// large, an AnswerError names it.
#pragma once

#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "edge/mount/driven/drive.h"

namespace ols::onvif {

// For example "GetStatus: no Position".
struct AnswerError : std::runtime_error {
  using std::runtime_error::runtime_error;
};
// Thrown if the camera refuses a request; contains the camera's reason on one line.
struct SoapFault : AnswerError {
  SoapFault(const std::string& words, bool refuses_login)
      : AnswerError(words), not_authorized(refuses_login) {}
  bool not_authorized;
};

using mount::Space;
using mount::Span;

// The camera may offer several coordinate spaces for a move. Only the first of each kind is used:
// it is the camera's default.
struct PtzOptions : mount::Moves {
  std::optional<Space> relative;
  std::optional<Span> zoom;     // of absolute moves
  std::optional<Span> timeout;  // [s] of continuous moves
};

struct Profile {
  std::string token, configuration;  // `configuration`: token of its PTZ part; empty: none
  std::string node;                  // token of that part's node; empty: not stated
  std::string encoding;              // of its video, such as "H264"; empty: not stated
  // Size and rate of its pictures; 0: not stated.
  int width_px = 0, height_px = 0;
  double frame_rate_hz = 0.0;
};

struct Services {
  std::string media, ptz;  // addresses; empty if there is no such service
};

struct PtzStatus : mount::Vector {
  std::optional<double> zoom;  // 0..1
  std::optional<bool> moving;  // whether pan or tilt moves
};

// UTC since 1970 by the camera's clock, to the second; nullopt if the camera does not state it.
std::optional<std::int64_t> date_and_time(const std::string& answer);
std::string device_information(const std::string& answer);  // maker and model
Services services(const std::string& answer);
std::vector<Profile> profiles(const std::string& answer);
std::string stream_uri(const std::string& answer);
PtzOptions options(const std::string& answer);
// The same of a node, which states no time-outs.
PtzOptions node_options(const std::string& answer);
PtzStatus status(const std::string& answer);
// Checks the answer to a request that returns no data, such as "Stop".
void check_done(const std::string& answer, const std::string& request);

}  // namespace ols::onvif
