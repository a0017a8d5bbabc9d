// The boot of each station, from its verified statuses: what a command to it must name; and which
// statuses that are not fresh may be its own. Pure.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>

namespace ols::trust {

class AudienceBook {
 public:
  // A status was heard. `fresh`: its stamp agrees with this host's clock. The others count only if
  // they may be the station's own.
  void hear(std::string_view station, std::int64_t boot_id, bool fresh, double now_s);
  // Whether a status that is not fresh may be the station's own: of one whose fresh statuses were
  // heard within kPreferred_s, or within kReboot_s if it is of another boot, it is a recording. A
  // host takes longer to boot, and only that loses its clock.
  bool may_be_own(std::string_view station, std::int64_t boot_id, double now_s) const;
  static constexpr double kPreferred_s = 5.0, kReboot_s = 20.0;

  // 0: not known.
  std::int64_t boot_of(std::string_view station) const;

 private:
  struct Heard {
    std::int64_t boot_id = 0;
    double fresh_s = -1e9;  // when the last fresh status was heard
    std::int64_t fresh_boot_id = 0;
  };

  std::map<std::string, Heard, std::less<>> stations_;  // enrolled ones
};

}  // namespace ols::trust
