#include "cue/source.h"

#include <algorithm>
#include <stdexcept>

#include "export/address.h"

namespace ols::cues {
namespace {

constexpr std::string_view kHttp = "http://";

Source web_source(const std::string& text) {
  const std::string rest = text.substr(kHttp.size());
  const auto slash = rest.find('/');
  if (slash == std::string::npos) throw std::invalid_argument("names no path on its server");
  std::string host = rest.substr(0, slash);
  const bool has_port =
      host.find(':', host.find(']') == std::string::npos ? 0 : host.find(']')) != std::string::npos;
  if (!has_port) host += ":80";
  // A host and its port are the same everywhere.
  const exports::Address address = exports::parse_address("tcp://" + host);
  Source source{Carrier::kHttp, address.host, address.port, rest.substr(slash), ""};
  const bool is_plain =
      std::ranges::all_of(source.path, [](unsigned char c) { return c > ' ' && c < 127; });
  if (!is_plain)
    throw std::invalid_argument("its path has a character that is not allowed in an address");
  return source;
}

}  // namespace

Source parse_source(const std::string& text) {
  if (text.starts_with(kHttp)) return web_source(text);
  const bool is_known =
      text.starts_with("udp://") || text.starts_with("tcp://") || text.starts_with("file://");
  if (!is_known) {
    throw std::invalid_argument("must begin with udp://, tcp://, file:// or http://");
  }
  const exports::Address address = exports::parse_address(text);
  const Carrier carrier = address.scheme == exports::Scheme::kUdp   ? Carrier::kUdp
                          : address.scheme == exports::Scheme::kTcp ? Carrier::kTcp
                                                                    : Carrier::kFile;
  return {carrier, address.host, address.port, address.path, address.interface};
}

}  // namespace ols::cues
