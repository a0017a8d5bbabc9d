// A list of networks that decides whether an address is allowed. Pure.
#pragma once

#include <boost/asio/ip/address.hpp>
#include <boost/asio/ip/network_v4.hpp>
#include <boost/asio/ip/network_v6.hpp>
#include <string>
#include <vector>

namespace ols {

class IpNetworks {
 public:
  // Networks such as "10.0.0.0/24". Throws std::invalid_argument.
  explicit IpNetworks(const std::vector<std::string>& networks);
  bool contain(const boost::asio::ip::address& address) const;

 private:
  std::vector<boost::asio::ip::network_v4> v4_;
  std::vector<boost::asio::ip::network_v6> v6_;
};

}  // namespace ols
