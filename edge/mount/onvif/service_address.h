// Functions for the addresses (URLs) of a camera's services. Pure.
#pragma once

#include <string>

namespace ols::onvif {

// Throws std::invalid_argument unless the address is http:// or https:// with a host, and contains
// no user and password.
void check_address(const std::string& url);

// The address to use for a service, from the configured address and the address that the camera
// states. The host is always the configured one: a camera behind a router states an address of its
// own network, and the password may go only to the configured host. The path is the stated one. The
// port is the stated one if the stated scheme and host are the configured ones; otherwise it is the
// configured port.
std::string service_address(const std::string& configured, const std::string& stated);

// The address to use for a stream: the address that the camera states, with the configured host and
// without user and password. Empty if the camera does not state an RTSP address.
std::string stream_address(const std::string& configured, const std::string& stated);

// The host in an address, for example "10.0.0.5"; empty if `url` is not an address.
std::string host_of(const std::string& url);

// The address in a form for logs: "http://10.0.0.5:8080/...".
std::string shown_address(const std::string& url);

}  // namespace ols::onvif
