#include "export/address.h"

#include <algorithm>
#include <array>
#include <boost/asio/ip/address.hpp>
#include <cctype>
#include <charconv>
#include <stdexcept>

namespace ols::exports {
namespace {

struct SchemeRow {
  Scheme scheme;
  const char* name;
  int port;  // the default; 0: there is none
};
constexpr std::array<SchemeRow, 6> kSchemes{{{Scheme::kUdp, "udp", 0},
                                             {Scheme::kTcp, "tcp", 0},
                                             {Scheme::kTls, "tls", 0},
                                             {Scheme::kMqtt, "mqtt", 1883},
                                             {Scheme::kMqtts, "mqtts", 8883},
                                             {Scheme::kFile, "file", 0}}};

int number(const std::string& text, int least, int most, const char* what) {
  int value = 0;
  const auto [end, bad] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (bad != std::errc{} || end != text.data() + text.size() || value < least || value > most) {
    throw std::invalid_argument(std::string(what) + " must be " + std::to_string(least) + " to " +
                                std::to_string(most) + ", not \"" + text + "\"");
  }
  return value;
}

void check_ip(const std::string& text, const char* what) {
  boost::system::error_code bad;
  static_cast<void>(boost::asio::ip::make_address(text, bad));
  if (bad) throw std::invalid_argument(std::string(what) + " must be an IP address: " + text);
}

void check_host(const std::string& host) {
  const bool is_good =
      !host.empty() && host.size() <= 253 && std::ranges::all_of(host, [](unsigned char c) {
        return std::isalnum(c) != 0 || c == '.' || c == '-' || c == '_' || c == ':';
      });
  if (!is_good) throw std::invalid_argument("\"" + host + "\" is not a host");
}

// Takes "HOST[:PORT]" apart.
void set_host(Address& address, const std::string& text, int fallback_port) {
  std::string port;
  if (text.starts_with('[')) {
    const auto end = text.find(']');
    if (end == std::string::npos) throw std::invalid_argument("the bracket is not closed");
    address.host = text.substr(1, end - 1);
    if (end + 1 < text.size() && text[end + 1] == ':') port = text.substr(end + 2);
  } else {
    const auto colon = text.find(':');
    address.host = text.substr(0, colon);
    if (colon != std::string::npos) port = text.substr(colon + 1);
  }
  check_host(address.host);
  if (port.empty() && fallback_port == 0) throw std::invalid_argument("names no port");
  address.port = port.empty() ? fallback_port : number(port, 1, 65535, "the port");
}

// The network that a group's datagrams leave by.
void check_interface(const Address& address) {
  if (address.interface.empty()) return;
  const auto to = boost::asio::ip::make_address(address.host);
  const auto by = boost::asio::ip::make_address(address.interface);
  if (!to.is_v4() || !to.is_multicast() || !by.is_v4())
    throw std::invalid_argument("interface needs an IPv4 group and an IPv4 address");
}

void set_option(Address& address, const std::string& option) {
  const auto equals = option.find('=');
  const std::string name = option.substr(0, equals);
  const std::string value = equals == std::string::npos ? "" : option.substr(equals + 1);
  if (name == "ttl") {
    address.ttl = number(value, 0, 255, "ttl");
  } else if (name == "interface") {
    check_ip(value, "interface");
    address.interface = value;
  } else {
    throw std::invalid_argument("\"" + name + "\" is not an option: ttl, interface");
  }
}

void set_options(Address& address, std::string text) {
  if (address.scheme != Scheme::kUdp) throw std::invalid_argument("only udp has options");
  while (!text.empty()) {
    const auto end = text.find('&');
    set_option(address, text.substr(0, end));
    text = end == std::string::npos ? "" : text.substr(end + 1);
  }
}

}  // namespace

const char* to_string(Scheme scheme) {
  return std::ranges::find(kSchemes, scheme, &SchemeRow::scheme)->name;
}

Address parse_address(const std::string& text) {
  const auto end = text.find("://");
  const auto row = std::ranges::find(kSchemes, text.substr(0, end), &SchemeRow::name);
  if (end == std::string::npos || row == kSchemes.end()) {
    throw std::invalid_argument(
        "must begin with udp://, tcp://, tls://, mqtt://, mqtts:// or file://");
  }
  Address address;
  address.scheme = row->scheme;
  std::string rest = text.substr(end + 3);
  if (address.scheme == Scheme::kFile) {
    if (!rest.starts_with('/') || rest.ends_with('/')) {
      throw std::invalid_argument("must have the absolute path of a file: file:///PATH");
    }
    address.path = rest;
    return address;
  }
  if (const auto query = rest.find('?'); query != std::string::npos) {
    set_options(address, rest.substr(query + 1));
    rest.resize(query);
  }
  set_host(address, rest, row->port);
  if (address.scheme == Scheme::kUdp) {
    check_ip(address.host, "the host of udp");
    check_interface(address);
  }
  return address;
}

}  // namespace ols::exports
