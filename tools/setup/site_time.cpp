#include "tools/setup/site_time.h"

#include <sstream>
#include <string_view>

namespace ols::setup {
namespace {

// Four tags of eight bytes, of texts that no message of the bus begins with.
std::string time_key(const trust::SiteKey& site) {
  std::string hex;
  for (const std::string_view part :
       {"OLS-time-v1/0", "OLS-time-v1/1", "OLS-time-v1/2", "OLS-time-v1/3"}) {
    hex += trust::to_hex(
        trust::site_tag(site, {reinterpret_cast<const std::uint8_t*>(part.data()), part.size()}));
  }
  return hex;
}

}  // namespace

std::string chrony_file(const std::vector<std::string>& neighbours) {
  std::string text =
      "# The hosts of the site keep each other's time. A receiver (ols-gnss.conf) goes first: its\n"
      "# stratum is lower. Without any, one of them leads (orphan), so that all agree at least.\n";
  for (const std::string& address : neighbours) {
    text +=
        "server " + address + " iburst minpoll 4 maxpoll 6 key " + std::to_string(kTimeKey) + "\n";
  }
  text += "local stratum 10 orphan\n";
  for (const char* network : {"10.0.0.0/8", "172.16.0.0/12", "192.168.0.0/16", "169.254.0.0/16"}) {
    text += std::string("allow ") + network + "\n";
  }
  return text;
}

std::string receiver_chrony_file() {
  return "# Time from the GNSS receiver, by gpsd. The sentences only number the pulses: they are "
         "late by\n"
         "# tens to hundreds of milliseconds. A pulse on a GPIO: "
         "/usr/share/ols/examples/chrony-gnss.conf.\n"
         "refclock SHM 0 refid NMEA offset 0.1 delay 0.4 noselect\n"
         "refclock SHM 1 refid PPS precision 1e-6 lock NMEA prefer\n"
         "# A board without a clock of its own starts in the past.\n"
         "makestep 0.1 10\n";
}

std::string with_time_key(const std::string& present, const trust::SiteKey& site) {
  const std::string beginning = std::to_string(kTimeKey) + " ";
  std::istringstream lines(present);
  std::string text;
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with(beginning)) text += line + "\n";
  }
  return text + beginning + "SHA256 HEX:" + time_key(site) + "\n";
}

}  // namespace ols::setup
