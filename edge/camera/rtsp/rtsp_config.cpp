#include "edge/camera/rtsp/rtsp_config.h"

#include <glib.h>

#include <algorithm>
#include <iterator>
#include <regex>
#include <stdexcept>
#include <string_view>

#include "edge/device/certificate_key.h"

namespace ols::camera {
namespace {

// Position behind "rtsp://"; 0: no such address.
std::size_t host_at(const std::string& url) {
  for (const std::string scheme : {"rtsp://", "rtsps://"}) {
    if (url.starts_with(scheme) && url.size() > scheme.size()) return scheme.size();
  }
  return 0;
}

// For cameras that want user and password in the path or after it.
constexpr std::string_view kUser = "{user}", kPassword = "{password}";

// A configuration may be read by everybody.
void check_no_password(const std::string& url) {
  if (without_password(url) != url)
    throw std::invalid_argument(
        "must not contain a password: write {password} in its place, and set user and "
        "password_file");
}

void check_url(const std::string& url) {
  const std::size_t host = host_at(url);
  if (host == 0) throw std::invalid_argument("must be rtsp://HOST/... or rtsps://HOST/...");
  const std::string address = url.substr(host, url.find_first_of("/?#", host) - host);
  // A password with a slash in it leaves "user:pass" as host and port.
  const std::string port = address.substr(address.find_last_of(":]") + 1);
  const bool has_port = address.find(':') != std::string::npos;
  if (address.find('@') != std::string::npos ||
      (has_port && port.find_first_not_of("0123456789") != std::string::npos)) {
    throw std::invalid_argument(
        "must not name user and password: they belong in user and password_file");
  }
  check_no_password(url);
}

bool names_login(const std::string& url) {
  return url.find(kUser) != std::string::npos || url.find(kPassword) != std::string::npos;
}

void replace(std::string& url, std::string_view word, const std::string& value) {
  gchar* const escaped = g_uri_escape_string(value.c_str(), nullptr, FALSE);
  const std::string text = escaped;
  g_free(escaped);
  for (std::size_t at = 0; (at = url.find(word, at)) != std::string::npos; at += text.size())
    url.replace(at, word.size(), text);
}

void check(ConfigTable& table, const RtspConfig& c) {
  if (c.pixel_format != "Mono8" && c.pixel_format != "BGR8")
    throw table.error("pixel_format", "an RTSP camera has Mono8 or BGR8");
  if (c.user.empty() != c.password_file.empty())
    throw table.error(c.user.empty() ? "password_file" : "user",
                      "user and password_file need each other");
  if (c.user.empty() && names_login(c.url))
    throw table.error("url", "{user} and {password} need user and password_file");
  if (c.url.starts_with("rtsps:") && c.transport == RtspTransport::kUdp)
    throw table.error("transport", "rtsps:// needs tcp");
  if (!c.pinned_key.empty() && !c.url.starts_with("rtsps:"))
    throw table.error("pinned_key", "only rtsps:// has a certificate");
}

}  // namespace

std::string shown_url(const std::string& url) {
  const std::size_t path = url.find_first_of("/?#", host_at(url));
  return path == std::string::npos ? url : url.substr(0, path) + "/...";
}

std::string without_password(const std::string& url) {
  static const std::regex password("((?:pass(?:w(?:or)?d)?|pwd)=)[^&?/]+", std::regex::icase);
  return std::regex_replace(url, password, "$1" + std::string(kPassword));
}

std::string filled_url(const RtspConfig& config, const std::string& password) {
  std::string url = config.url;
  replace(url, kUser, config.user);
  replace(url, kPassword, password);
  return url;
}

config::Section rtsp_section(RtspConfig& c) {
  using config::number;
  std::vector<config::Row> rows{
      config::text(
          "url", c.url,
          "Address of the stream, rtsp:// or rtsps://, without user and password. If the camera "
          "wants them in the path: {user} and {password} are replaced.",
          check_url)
          .required(),
      config::text("user", c.user, "User name at the camera; empty: none."),
      config::text("password_file", c.password_file,
                   "File whose first line is that user's password; only the station may be able "
                   "to read it."),
      config::text("pinned_key", c.pinned_key,
                   "Public key of an rtsps camera whose certificate is its own: sha256// and the "
                   "key's hash; empty: an authority that this system trusts must have signed it.",
                   device::check_pinned_key),
      config::word("transport", c.transport,
                   {{"tcp", RtspTransport::kTcp}, {"udp", RtspTransport::kUdp}},
                   "TCP loses no packets; UDP does not wait for lost ones.")};
  std::ranges::move(picture_rows(c), std::back_inserter(rows));
  std::vector<config::Row> more{
      number("delay_s", c.clock.delay_s, {0.0, 10.0}, "s",
             "From mid-exposure to the arrival of a picture; used where the camera sends no "
             "credible sender reports."),
      number("delay_sd_s", c.clock.delay_sd_s, {1e-4, 10.0}, "s",
             "1-sigma of delay_s; reports that imply a delay beyond five of it are not believed."),
      number("report_delay_s", c.clock.report_delay_s, {-1.0, 10.0}, "s",
             "From mid-exposure to the instant that the camera's sender reports give."),
      number("report_sd_s", c.clock.report_sd_s, {1e-5, 10.0}, "s",
             "1-sigma of report_delay_s and of the camera's own UTC together."),
      number("row_readout_s", c.row_readout_s, {0.0, 0.5}, "s",
             "Rolling shutter: from the exposure of the first row to that of the last; 0: all rows "
             "at once."),
      number("frozen_s", c.frozen_s, {0.0, 3600.0}, "s",
             "A picture that stays the same to the last bit for so long is not used, and the "
             "camera is connected anew; 0: never.")};
  std::ranges::move(more, std::back_inserter(rows));
  return {"camera", "", rows, {}, [&c](ConfigTable& table) { check(table, c); }};
}

}  // namespace ols::camera
