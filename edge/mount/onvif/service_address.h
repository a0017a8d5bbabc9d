// Addresses of a camera's services. Pure.
#pragma once

#include <string>

namespace ols::onvif {

// Throws std::invalid_argument unless it is http:// or https:// with a host, and without user and
// password.
void check_address(const std::string& url);

// Where a service is, from the address that is configured and the one that the camera states for
// the service. A camera behind a router states an address of its own network, and the password goes
// to the configured host alone: only the path is the camera's, and the port where the host is the
// same.
std::string service_address(const std::string& configured, const std::string& stated);

// Where a stream is, from the address that the camera states: at the configured host, too. Empty:
// it states none of RTSP.
std::string stream_address(const std::string& configured, const std::string& stated);

// "10.0.0.5"; empty: no such address.
std::string host_of(const std::string& url);

// "http://10.0.0.5:8080/...": for logs.
std::string shown_address(const std::string& url);

}  // namespace ols::onvif
