#include "edge/mount/onvif/service_address.h"

#include <algorithm>
#include <stdexcept>

namespace ols::onvif {
namespace {

struct Parts {
  std::string scheme, host, port, path;  // "http://", "10.0.0.5", ":8080", "/onvif/..."
};

bool is_port(const std::string& text) {
  return text.size() > 1 && text.size() <= 6 && text[0] == ':' &&
         std::all_of(text.begin() + 1, text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

// Without a scheme, it is no such address.
Parts parts_of(const std::string& url) {
  Parts parts;
  for (const std::string scheme : {"http://", "https://", "rtsp://", "rtsps://"}) {
    if (!url.starts_with(scheme)) continue;
    const std::size_t path = std::min(url.find_first_of("/?#", scheme.size()), url.size());
    const std::string authority = url.substr(scheme.size(), path - scheme.size());
    const std::size_t after_brackets = authority.find(']');  // of IPv6
    const std::size_t colon =
        std::min(authority.find(':', after_brackets == std::string::npos ? 0 : after_brackets),
                 authority.size());
    parts = {scheme, authority.substr(0, colon), authority.substr(colon), url.substr(path)};
    if (parts.host.empty() || (!parts.port.empty() && !is_port(parts.port))) parts = {};
  }
  return parts;
}

}  // namespace

void check_address(const std::string& url) {
  if (url.find('@') != std::string::npos)
    throw std::invalid_argument(
        "must not name user and password: they belong in user and password_file");
  if (!parts_of(url).scheme.starts_with("http"))
    throw std::invalid_argument("must be http://HOST/... or https://HOST/...");
}

std::string service_address(const std::string& configured, const std::string& stated) {
  const Parts known = parts_of(configured), said = parts_of(stated);
  if (said.path.empty() || !said.scheme.starts_with("http")) return configured;
  const bool same = said.scheme == known.scheme && said.host == known.host;
  return known.scheme + known.host + (same ? said.port : known.port) + said.path;
}

std::string stream_address(const std::string& configured, const std::string& stated) {
  // User and password before the host are left out: the station has its own.
  const std::size_t at = stated.find('@'), path = stated.find('/', stated.find("//") + 2);
  const std::string scheme = stated.substr(0, std::min(stated.find("//") + 2, stated.size()));
  const Parts said = parts_of(at < path ? scheme + stated.substr(at + 1) : stated);
  if (!said.scheme.starts_with("rtsp")) return {};
  return said.scheme + parts_of(configured).host + said.port + said.path;
}

std::string host_of(const std::string& url) { return parts_of(url).host; }

std::string shown_address(const std::string& url) {
  const Parts parts = parts_of(url);
  return parts.scheme + parts.host + parts.port + "/...";
}

}  // namespace ols::onvif
