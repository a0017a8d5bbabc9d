// The boot id of each station, from its verified statuses. A command must name it. Also decides
// whether a status with an old stamp may be the station's own. Pure.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>

namespace ols::trust {

class StationBoots {
 public:
  // Takes a status. fresh: its stamp agrees with this host's clock. A status that is not fresh is
  // used only if may_be_own().
  void hear(std::string_view station, std::int64_t boot_id, bool fresh, double now_s);
  // Whether a status that is not fresh may be the station's own. It is taken for a recording if
  // fresh statuses of the same boot were received within kPreferred_s, or of another boot within
  // kReboot_s. The reason: a host loses its clock only by booting, and that takes longer than
  // kReboot_s.
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
