// An IP address with a port, as text. Pure.
#pragma once

#include <boost/asio/ip/tcp.hpp>
#include <string>

namespace ols {

// "10.0.0.11:7790" or "[fd00::11]:7790". Throws std::invalid_argument for anything else, and for a
// wildcard address, because nobody can connect to one.
boost::asio::ip::tcp::endpoint parse_endpoint(const std::string& text);

}  // namespace ols
