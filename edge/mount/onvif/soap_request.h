// Makes the requests to an ONVIF camera, as SOAP 1.2 texts. Pure. Sources: ONVIF Core, Media and
// PTZ Service Specifications; OASIS WS-Security UsernameToken Profile 1.0.
#pragma once

#include <cstdint>
#include <string>

#include "edge/mount/driven/drive.h"

namespace ols::onvif {

struct Request {
  std::string action;  // "http://www.onvif.org/ver20/ptz/wsdl/GetStatus"
  std::string body;    // content of the SOAP body
  // For example "GetStatus".
  std::string name() const { return action.substr(action.rfind('/') + 1); }
};

// The login for a camera. Must never be written into a log.
struct Credentials {
  std::string user, password;
};

using mount::Vector;

Request get_system_date_and_time();
Request get_device_information();
Request get_capabilities();
Request get_services();
Request get_profiles();
Request get_stream_uri(const std::string& profile);
// The same of the service Media2 (ONVIF profile T).
Request get_media2_profiles();
Request get_media2_stream_uri(const std::string& profile);
Request get_options(const std::string& configuration);
// Asks for a PTZ node. `node`: the token that the PTZ configuration states (Profile::node).
Request get_node(const std::string& node);
Request get_status(const std::string& profile);
Request stop(const std::string& profile);
// `timeout_s`: the camera must stop by itself after this time unless the move is ordered again.
Request continuous_move(const std::string& profile, const Vector& velocity, double timeout_s);
Request absolute_move(const std::string& profile, const Vector& position);

// A login for one request (UsernameToken). `nonce`: bytes that were never used before.
// `created_utc_s`: the present time by the camera's clock.
struct Token {
  Credentials credentials;
  std::string nonce;
  std::int64_t created_utc_s = 0;
};
// Base64(SHA-1(nonce + created + password)).
std::string password_digest(const std::string& nonce, const std::string& created,
                            const std::string& password);
std::string envelope(const Request& request);
std::string envelope(const Request& request, const Token& token);

}  // namespace ols::onvif
