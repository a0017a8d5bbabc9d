// The boot id of each station, from its verified statuses and replies; a command to the station
// must name it. Also decides whether a status with a wrong stamp may come from the station itself,
// or is a recording. Pure.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>

namespace ols::trust {

class StationBoots {
 public:
  // Takes a status or a reply. fresh: its stamp agrees with this host's clock. A message that is
  // not fresh is used only if may_be_own() is true.
  void hear(std::string_view station, std::int64_t boot_id, bool fresh, double now_s);
  // Whether a status that is not fresh may come from the station itself. It counts as a recording
  // if a fresh status of the same boot was received within the last kPreferred_s, or a fresh status
  // of another boot within the last kReboot_s. The reason: a host loses its clock only when it
  // boots, and that takes longer than kReboot_s.
  bool may_be_own(std::string_view station, std::int64_t boot_id, double now_s) const;
  static constexpr double kPreferred_s = 5.0, kReboot_s = 20.0;

  // The boot id; 0: not known.
  std::int64_t boot_of(std::string_view station) const;

 private:
  struct Heard {
    std::int64_t boot_id = 0;
    double fresh_s = -1e9;  // when the last fresh status was received
    std::int64_t fresh_boot_id = 0;
  };

  std::map<std::string, Heard, std::less<>> stations_;  // enrolled stations
};

}  // namespace ols::trust
