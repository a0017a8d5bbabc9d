// What an ONVIF camera answers. Pure. Elements are found by their local names, because cameras
// differ in prefixes and some do not declare theirs. Entities other than the five of XML and
// document types are not expanded. What is missing, or no finite number of a credible size, is
// refused by name.
#pragma once

#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace ols::onvif {

// "GetStatus: no Position"
struct AnswerError : std::runtime_error {
  using std::runtime_error::runtime_error;
};
// The camera refuses: its reason in words, on one line.
struct SoapFault : AnswerError {
  SoapFault(const std::string& words, bool refuses_login)
      : AnswerError(words), not_authorized(refuses_login) {}
  bool not_authorized;
};

struct Span {
  double min = 0.0, max = 0.0;
};

struct Space {
  std::string uri;
  Span x, y;
};

// What a camera can do, in the first space of each kind: the one that it uses if none is named.
struct PtzOptions {
  std::optional<Space> absolute, relative, continuous;
  std::optional<Span> zoom;     // absolute
  std::optional<Span> timeout;  // [s] of continuous moves
};

struct Profile {
  std::string token, configuration;  // the latter of its PTZ; empty: it has none
  std::string encoding;              // of its video: "H264"; empty: it does not say
  // Of its pictures; 0: it does not say.
  int width_px = 0, height_px = 0;
  double frame_rate_hz = 0.0;
};

struct Services {
  std::string media, ptz;  // addresses; empty: it has none
};

struct PtzStatus {
  double x = 0.0, y = 0.0;
  std::optional<double> zoom;  // 0..1
  std::optional<bool> moving;  // of pan and tilt
};

// UTC since 1970 by the camera's clock, to the second; empty: it does not say.
std::optional<std::int64_t> date_and_time(const std::string& answer);
std::string device_information(const std::string& answer);  // maker and model
Services services(const std::string& answer);
std::vector<Profile> profiles(const std::string& answer);
std::string stream_uri(const std::string& answer);
PtzOptions options(const std::string& answer);
PtzStatus status(const std::string& answer);
// Of a request that is answered by nothing but its success: "Stop".
void check_done(const std::string& answer, const std::string& request);

}  // namespace ols::onvif
