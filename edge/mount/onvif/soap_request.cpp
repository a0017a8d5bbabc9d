#include "edge/mount/onvif/soap_request.h"

#include <sodium.h>

#include <array>
#include <boost/uuid/detail/sha1.hpp>
#include <cmath>
#include <cstdio>
#include <ctime>

namespace ols::onvif {
namespace {

const std::string kDevice = "http://www.onvif.org/ver10/device/wsdl";
const std::string kMedia = "http://www.onvif.org/ver10/media/wsdl";
const std::string kMedia2 = "http://www.onvif.org/ver20/media/wsdl";
const std::string kPtz = "http://www.onvif.org/ver20/ptz/wsdl";

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      default:
        result += c;
    }
  }
  return result;
}

std::string element(const std::string& name, const std::string& content) {
  return "<" + name + ">" + content + "</" + name + ">";
}

Request request(const std::string& service, const std::string& name,
                const std::string& content = {}) {
  return {service + "/" + name,
          "<" + name + " xmlns=\"" + service + "\">" + content + "</" + name + ">"};
}

Request of_profile(const std::string& name, const std::string& profile,
                   const std::string& content = {}) {
  return request(kPtz, name, element("ProfileToken", escaped(profile)) + content);
}

std::string pan_tilt(const Vector& vector) {
  std::array<char, 160> text{};
  std::snprintf(text.data(), text.size(),
                R"(<PanTilt xmlns="http://www.onvif.org/ver10/schema" x="%.6f" y="%.6f"/>)",
                vector.x, vector.y);
  return text.data();
}

// Some cameras do not read fractions of a second, so whole numbers have none.
std::string duration(double seconds) {
  std::array<char, 40> text{};
  std::snprintf(text.data(), text.size(), std::floor(seconds) == seconds ? "PT%.0fS" : "PT%.1fS",
                seconds);
  return text.data();
}

std::string base64(const void* bytes, std::size_t size) {
  std::string text(sodium_base64_ENCODED_LEN(size, sodium_base64_VARIANT_ORIGINAL), '\0');
  sodium_bin2base64(text.data(), text.size(), static_cast<const unsigned char*>(bytes), size,
                    sodium_base64_VARIANT_ORIGINAL);
  text.resize(text.size() - 1);  // the zero at its end
  return text;
}

std::string utc_text(std::int64_t utc_s) {
  const std::time_t time = utc_s;
  std::tm parts{};
  gmtime_r(&time, &parts);
  std::array<char, 40> text{};
  std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", &parts);
  return text.data();
}

std::string security(const Token& token) {
  const std::string schema = "http://docs.oasis-open.org/wss/2004/01/oasis-200401-wss-";
  const std::string created = utc_text(token.created_utc_s);
  const std::string digest = password_digest(token.nonce, created, token.credentials.password);
  return "<w:Security s:mustUnderstand=\"1\" xmlns:w=\"" + schema +
         "wssecurity-secext-1.0.xsd\"><w:UsernameToken>" +
         element("w:Username", escaped(token.credentials.user)) + "<w:Password Type=\"" + schema +
         "username-token-profile-1.0#PasswordDigest\">" + digest +
         "</w:Password><w:Nonce EncodingType=\"" + schema +
         "soap-message-security-1.0#Base64Binary\">" +
         base64(token.nonce.data(), token.nonce.size()) + "</w:Nonce><u:Created xmlns:u=\"" +
         schema + "wssecurity-utility-1.0.xsd\">" + created +
         "</u:Created></w:UsernameToken></w:Security>";
}

std::string enveloped(const std::string& header, const std::string& body) {
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>"
         "<s:Envelope xmlns:s=\"http://www.w3.org/2003/05/soap-envelope\">" +
         header + element("s:Body", body) + "</s:Envelope>";
}

}  // namespace

Request get_system_date_and_time() { return request(kDevice, "GetSystemDateAndTime"); }
Request get_device_information() { return request(kDevice, "GetDeviceInformation"); }
Request get_capabilities() {
  return request(kDevice, "GetCapabilities", element("Category", "All"));
}
Request get_services() {
  return request(kDevice, "GetServices", element("IncludeCapability", "false"));
}
Request get_profiles() { return request(kMedia, "GetProfiles"); }
Request get_stream_uri(const std::string& profile) {
  const std::string schema = " xmlns=\"http://www.onvif.org/ver10/schema\">";
  return request(kMedia, "GetStreamUri",
                 "<StreamSetup><Stream" + schema + "RTP-Unicast</Stream><Transport" + schema +
                     "<Protocol>RTSP</Protocol></Transport></StreamSetup>" +
                     element("ProfileToken", escaped(profile)));
}
Request get_media2_profiles() { return request(kMedia2, "GetProfiles", element("Type", "All")); }
Request get_media2_stream_uri(const std::string& profile) {
  return request(kMedia2, "GetStreamUri",
                 element("Protocol", "RTSP") + element("ProfileToken", escaped(profile)));
}
Request get_options(const std::string& configuration) {
  return request(kPtz, "GetConfigurationOptions",
                 element("ConfigurationToken", escaped(configuration)));
}
Request get_node(const std::string& node) {
  return request(kPtz, "GetNode", element("NodeToken", escaped(node)));
}
Request get_status(const std::string& profile) { return of_profile("GetStatus", profile); }
Request stop(const std::string& profile) {
  return of_profile("Stop", profile, element("PanTilt", "true") + element("Zoom", "true"));
}
Request continuous_move(const std::string& profile, const Vector& velocity, double timeout_s) {
  return of_profile(
      "ContinuousMove", profile,
      element("Velocity", pan_tilt(velocity)) + element("Timeout", duration(timeout_s)));
}
Request absolute_move(const std::string& profile, const Vector& position) {
  return of_profile("AbsoluteMove", profile, element("Position", pan_tilt(position)));
}

std::string password_digest(const std::string& nonce, const std::string& created,
                            const std::string& password) {
  const std::string text = nonce + created + password;
  boost::uuids::detail::sha1 hash;
  hash.process_bytes(text.data(), text.size());
  boost::uuids::detail::sha1::digest_type words{};
  hash.get_digest(words);
  std::string bytes;
  for (const unsigned int word : words) {
    for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(word >> shift & 0xff);
  }
  return base64(bytes.data(), bytes.size());
}

std::string envelope(const Request& request) { return enveloped("", request.body); }
std::string envelope(const Request& request, const Token& token) {
  return enveloped(element("s:Header", security(token)), request.body);
}

}  // namespace ols::onvif
