// Which viewer controls which station. A viewer keeps control until it gives control up, until
// another viewer takes control, or until it has given no command for `timeout_s`. Pure.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "conditions/refusal.h"

namespace ols::console {

struct Holder {
  std::uint64_t viewer = 0;
  std::string name;
  double until_s = 0.0;  // monotonic
};

class ControlLeases {
 public:
  explicit ControlLeases(double timeout_s) : timeout_s_(timeout_s) {}

  // Call for each command of a viewer: takes or prolongs control. If another viewer has control,
  // returns this as the reason to refuse the command; otherwise empty.
  Outcome use(const std::string& station, std::uint64_t viewer, const std::string& name,
              double now_s);
  void take(const std::string& station, std::uint64_t viewer, const std::string& name,
            double now_s);
  void give_up(const std::string& station, std::uint64_t viewer);
  void leave(std::uint64_t viewer);  // gives up control of all stations

  // The viewer that controls the station; 0: nobody does.
  std::uint64_t holder(const std::string& station, double now_s) const;

  // The stations whose holder has changed since the last call, each with its present holder;
  // nullopt: nobody.
  std::vector<std::pair<std::string, std::optional<Holder>>> changes(double now_s);

 private:
  void set(const std::string& station, std::uint64_t viewer, const std::string& name, double now_s);

  double timeout_s_;
  std::map<std::string, Holder> holders_;
  std::vector<std::string> changed_;
};

}  // namespace ols::console
