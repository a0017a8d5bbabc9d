// Addresses of a camera's services. Pure.
#pragma once

#include <string>

namespace ols::onvif {

// Throws std::invalid_argument unless the address is http:// or https:// with a host, and without
// user and password.
void check_address(const std::string& url);

// The address of a service, made from the configured address and the one that the camera states for
// the service. The host is always the configured one, because a camera behind a router states an
// address of its own network, and because the password may go only to the configured host. The path
// is the one that the camera states. So is the port if the camera states the same host.
std::string service_address(const std::string& configured, const std::string& stated);

// The address of a stream, from the address that the camera states, with the configured host.
// Empty if the camera states no RTSP address.
std::string stream_address(const std::string& configured, const std::string& stated);

// "10.0.0.5"; empty: no such address.
std::string host_of(const std::string& url);

// "http://10.0.0.5:8080/...": for logs.
std::string shown_address(const std::string& url);

}  // namespace ols::onvif
