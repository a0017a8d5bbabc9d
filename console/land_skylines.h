// The skylines of the land from the stations' cameras, for browsers. One takes a second, so no
// request waits for it: a browser has few connections, and its orders need one.
#pragma once

#include <Eigen/Core>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "console/land_task.h"
#include "console/web_api.h"
#include "land/terrain.h"

namespace ols::console {

class LandSkylines {
 public:
  // Without terrain: no land is known.
  LandSkylines(std::string version, std::shared_ptr<const land::Terrain> terrain)
      : version_(std::move(version)), terrain_(std::move(terrain)) {}

  // At once: the skyline, why there is none, or 202 while it is not computed yet.
  struct Answer {
    WebResponse response;
    bool begins = false;  // nobody computes it yet: compute() it, then keep() the result
  };
  Answer answer(const LandTask& task);
  // Takes a second; call it in any thread.
  WebResponse compute(const LandTask& task) const;
  void keep(const LandTask& task, WebResponse response);

  static constexpr double kMoved_m = 1.0;  // a camera that has moved further has another skyline

 private:
  struct Kept {
    Eigen::Vector3d camera_ecef = Eigen::Vector3d::Zero();
    std::optional<WebResponse> response;  // nullopt: being computed
  };
  std::string version_;
  std::shared_ptr<const land::Terrain> terrain_;
  std::map<std::string, Kept> kept_;  // by station
};

}  // namespace ols::console
