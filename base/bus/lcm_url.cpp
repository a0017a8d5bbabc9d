#include "base/bus/lcm_url.h"

#include <arpa/inet.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <stdexcept>
#include <string_view>
#include <system_error>

namespace ols {
namespace {

constexpr std::string_view kMulticast = "udpm://", kInProcess = "memq://";
constexpr int kLargestBuffer = 1 << 30;  // [byte]

int number(std::string_view text, int least, int greatest, const std::string& what) {
  int value = 0;
  const auto parsed = std::from_chars(text.data(), text.data() + text.size(), value);
  if (parsed.ec != std::errc() || parsed.ptr != text.data() + text.size() || value < least ||
      value > greatest) {
    throw std::invalid_argument("\"" + std::string(text) + "\" is not " + what);
  }
  return value;
}

sockaddr_in group_of(std::string_view place) {
  const std::size_t colon = place.find(':');
  const std::string given(place.substr(0, colon));
  const std::string address = given.empty() ? "239.255.76.67" : given;
  sockaddr_in group{};
  group.sin_family = AF_INET;
  group.sin_port = htons(7667);
  if (colon != std::string_view::npos) {
    group.sin_port =
        htons(static_cast<std::uint16_t>(number(place.substr(colon + 1), 1, 65535, "a port")));
  }
  if (inet_pton(AF_INET, address.c_str(), &group.sin_addr) != 1 ||
      !IN_MULTICAST(ntohl(group.sin_addr.s_addr))) {
    throw std::invalid_argument("\"" + address + "\" is not an IPv4 multicast address");
  }
  return group;
}

void set_option(BusAddress& address, std::string_view option) {
  const std::size_t equals = option.find('=');
  const std::string_view name = option.substr(0, equals);
  const std::string_view value =
      equals == std::string_view::npos ? std::string_view() : option.substr(equals + 1);
  if (name == "ttl") {
    address.ttl = number(value, 0, 255, "a ttl (0 to 255)");
  } else if (name == "recv_buf_size") {
    address.receive_buffer_bytes = number(value, 1, kLargestBuffer, "a number of bytes");
  } else {
    throw std::invalid_argument("\"" + std::string(name) +
                                "\" is not an option of an LCM URL (ttl, recv_buf_size)");
  }
}

}  // namespace

BusAddress parse_lcm_url(const std::string& url) {
  BusAddress address;
  if (url.starts_with(kInProcess)) {
    address.name = url.substr(kInProcess.size());
    return address;
  }
  if (!url.starts_with(kMulticast)) {
    throw std::invalid_argument("\"" + url +
                                "\" is not the URL of a bus (udpm://ADDRESS:PORT?ttl=0)");
  }
  std::string_view rest = std::string_view(url).substr(kMulticast.size());
  const std::size_t question = rest.find('?');
  address.group = group_of(rest.substr(0, question));
  if (question == std::string_view::npos) return address;
  rest.remove_prefix(question + 1);
  while (!rest.empty()) {
    const std::size_t end = std::min(rest.find('&'), rest.size());
    set_option(address, rest.substr(0, end));
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return address;
}

std::string lcm_url_problem(const std::string& url) {
  try {
    parse_lcm_url(url);
    return "";
  } catch (const std::invalid_argument& problem) {
    return problem.what();
  }
}

std::string default_lcm_url(const std::string& bus_env) {
  const bool is_of_site = ::access(bus_env.c_str(), F_OK) == 0;
  return std::string("udpm://239.255.76.67:7667?ttl=") + (is_of_site ? "1" : "0");
}

}  // namespace ols
