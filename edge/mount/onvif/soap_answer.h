// Parses the answers of an ONVIF camera. Pure. Elements are found by their local names, because
// cameras use different prefixes, and some cameras do not declare their prefixes. Only the five
// predefined entities of XML are expanded; document types are ignored. If a value is missing, not a
// finite number, or absurdly large, an AnswerError that names the value is thrown.
#pragma once

#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "edge/mount/driven/drive.h"

namespace ols::onvif {

// The text of an AnswerError is, for example, "GetStatus: no Position".
struct AnswerError : std::runtime_error {
  using std::runtime_error::runtime_error;
};
// Thrown if the camera refuses a request; its text contains the camera's reason in one line.
// not_authorized: the camera requires a login, or has refused it.
struct SoapFault : AnswerError {
  SoapFault(const std::string& words, bool refuses_login)
      : AnswerError(words), not_authorized(refuses_login) {}
  bool not_authorized;
};

using mount::Space;
using mount::Span;

// The moves that a camera offers. A camera may offer several coordinate spaces for a move; only the
// first one is used, because it is the camera's default.
struct PtzOptions : mount::Moves {
  std::optional<Space> relative;
  std::optional<Span> zoom;     // range of absolute zoom positions
  std::optional<Span> timeout;  // [s] range of time-outs of continuous moves
};

struct Profile {
  // `configuration`: token of the profile's PTZ configuration; empty if it has none
  std::string token, configuration;
  std::string node;      // token of the PTZ configuration's node; empty if not stated
  std::string encoding;  // encoding of the video, such as "H264"; empty if not stated
  // Size and rate of the video's pictures; 0 if not stated.
  int width_px = 0, height_px = 0;
  double frame_rate_hz = 0.0;
  bool of_media2 = false;  // stated by Media2, which is then asked for the stream, too
};

struct DeviceInformation {
  std::string name;    // maker and model
  std::string serial;  // serial number; many cheap cameras state the same one, such as "0000"
};

struct Services {
  std::string media, ptz, media2{};  // addresses; empty if there is no such service
};

struct PtzStatus : mount::Vector {
  std::optional<double> zoom;  // 0..1
  std::optional<bool> moving;  // whether pan or tilt moves
};

// Time of the camera's clock: UTC since 1970 in whole seconds; nullopt if the camera does not state
// it.
std::optional<std::int64_t> date_and_time(const std::string& answer);
DeviceInformation device_information(const std::string& answer);
Services services(const std::string& answer);
// The answer to GetServices, which lists Media2.
Services listed_services(const std::string& answer);
std::vector<Profile> profiles(const std::string& answer);
std::string stream_uri(const std::string& answer);
// The same of the service Media2.
std::vector<Profile> media2_profiles(const std::string& answer);
std::string media2_stream_uri(const std::string& answer);
PtzOptions options(const std::string& answer);
// The options in the answer to a request for a node, which contains no time-outs.
PtzOptions node_options(const std::string& answer);
PtzStatus status(const std::string& answer);
// Checks the answer to a request that returns no data, such as "Stop".
void check_done(const std::string& answer, const std::string& request);

}  // namespace ols::onvif
