#include "base/net/ip_networks.h"

#include <algorithm>
#include <cstdint>
#include <stdexcept>

namespace ols {
namespace ip = boost::asio::ip;
namespace {

bool contains(const ip::network_v4& network, const ip::address_v4& address) {
  const std::uint32_t mask = network.netmask().to_uint();
  return (address.to_uint() & mask) == (network.address().to_uint() & mask);
}

bool contains(const ip::network_v6& network, const ip::address_v6& address) {
  return ip::network_v6(address, network.prefix_length()).canonical() == network.canonical();
}

}  // namespace

IpNetworks::IpNetworks(const std::vector<std::string>& networks) {
  for (const std::string& text : networks) {
    boost::system::error_code bad_v4, bad_v6;
    const ip::network_v4 v4 = ip::make_network_v4(text, bad_v4);
    const ip::network_v6 v6 = ip::make_network_v6(text, bad_v6);
    if (bad_v4 && bad_v6)
      throw std::invalid_argument('"' + text + "\" is not a network: 10.0.0.0/24");
    if (!bad_v4) v4_.push_back(v4);
    if (!bad_v6) v6_.push_back(v6);
  }
}

bool IpNetworks::contain(const ip::address& asked) const {
  const auto has = [](const auto& address) {
    return [&address](const auto& network) { return contains(network, address); };
  };
  if (asked.is_v4()) return std::ranges::any_of(v4_, has(asked.to_v4()));
  // A socket for both families shows an IPv4 peer as a mapped address.
  if (asked.to_v6().is_v4_mapped()) {
    return std::ranges::any_of(v4_, has(ip::make_address_v4(ip::v4_mapped, asked.to_v6())));
  }
  return std::ranges::any_of(v6_, has(asked.to_v6()));
}

}  // namespace ols
