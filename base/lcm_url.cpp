#include "base/lcm_url.h"

#include <arpa/inet.h>

#include <charconv>
#include <stdexcept>
#include <string_view>
#include <system_error>

namespace ols {
namespace {

std::uint16_t port_of(const std::string& text) {
  std::uint16_t port = 0;
  const auto parsed = std::from_chars(text.data(), text.data() + text.size(), port);
  if (parsed.ec != std::errc() || parsed.ptr != text.data() + text.size() || port == 0) {
    throw std::invalid_argument("\"" + text + "\" is not a port");
  }
  return port;
}

}  // namespace

std::optional<sockaddr_in> multicast_group(const std::string& url) {
  constexpr std::string_view kMulticast = "udpm://";
  for (const char* other : {"tcpq://", "memq://", "file://", "mpudpm://"}) {
    if (url.starts_with(other)) return std::nullopt;
  }
  if (!url.starts_with(kMulticast)) {
    throw std::invalid_argument("\"" + url + "\" is not an LCM URL (udpm://ADDRESS:PORT?ttl=0)");
  }
  const std::string place = url.substr(kMulticast.size(), url.find('?') - kMulticast.size());
  const std::size_t colon = place.find(':');
  const std::string address =
      colon == 0 || place.empty() ? "239.255.76.67" : place.substr(0, colon);
  sockaddr_in group{};
  group.sin_family = AF_INET;
  group.sin_port = htons(colon == std::string::npos ? 7667 : port_of(place.substr(colon + 1)));
  if (inet_pton(AF_INET, address.c_str(), &group.sin_addr) != 1 ||
      !IN_MULTICAST(ntohl(group.sin_addr.s_addr))) {
    throw std::invalid_argument("\"" + address + "\" is not an IPv4 multicast address");
  }
  return group;
}

std::string read_lcm_url(ConfigTable& table, const std::string& key, const std::string& fallback) {
  std::string url = table.text(key, fallback);
  try {
    multicast_group(url);
  } catch (const std::invalid_argument& problem) {
    throw table.error(key, problem.what());
  }
  return url;
}

}  // namespace ols
