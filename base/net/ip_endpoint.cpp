#include "base/net/ip_endpoint.h"

#include <charconv>
#include <cstdint>
#include <stdexcept>

namespace ols {
namespace ip = boost::asio::ip;
namespace {

std::uint16_t parse_port(const std::string& text) {
  std::uint16_t port = 0;
  const char* end = text.data() + text.size();
  const auto result = std::from_chars(text.data(), end, port);
  if (result.ec != std::errc() || result.ptr != end || port == 0) {
    throw std::invalid_argument("the port is not 1..65535");
  }
  return port;
}

}  // namespace

ip::tcp::endpoint parse_endpoint(const std::string& text) {
  const std::size_t colon = text.rfind(':');
  if (colon == std::string::npos) throw std::invalid_argument("is not ADDRESS:PORT");
  std::string host = text.substr(0, colon);
  const bool bracketed = host.size() > 2 && host.front() == '[' && host.back() == ']';
  if (bracketed) host = host.substr(1, host.size() - 2);
  boost::system::error_code bad;
  const ip::address address = ip::make_address(host, bad);
  if (bad || address.is_v6() != bracketed) {
    throw std::invalid_argument("is not an IP address and a port: 10.0.0.11:7790, [fd00::11]:7790");
  }
  if (address.is_unspecified()) {
    throw std::invalid_argument("must be one address of this computer: others look for it there");
  }
  return {address, parse_port(text.substr(colon + 1))};
}

}  // namespace ols
