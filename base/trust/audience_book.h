// The boot of each station, from its verified statuses: what a command to it must name. Pure.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>

namespace ols::trust {

class AudienceBook {
 public:
  // A status was heard. `fresh`: its stamp agrees with this host's clock. Of a station whose fresh
  // statuses were heard within kPreferred_s the others do not count: they are recordings.
  void hear(std::string_view station, std::int64_t boot_id, bool fresh, double now_s);
  static constexpr double kPreferred_s = 5.0;

  // 0: not known.
  std::int64_t boot_of(std::string_view station) const;

 private:
  struct Heard {
    std::int64_t boot_id = 0;
    double fresh_s = -1e9;  // when the last fresh status was heard
  };

  std::map<std::string, Heard, std::less<>> stations_;  // enrolled ones
};

}  // namespace ols::trust
