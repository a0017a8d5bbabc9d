// The skyline of the land model as each station's camera would see it, for browsers. To compute one
// takes a second. No request waits for that, because a browser has few connections, and needs one
// for its orders.
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
  // `terrain`: null if there is no land model.
  LandSkylines(std::string version, std::shared_ptr<const land::Terrain> terrain)
      : version_(std::move(version)), terrain_(std::move(terrain)) {}

  // Answers at once: with the skyline, with the reason why there is none, or with status 202 while
  // the skyline is being computed.
  struct Answer {
    WebResponse response;
    bool begins = false;  // the caller must call compute(), then keep() with the result
  };
  Answer answer(const LandTask& task);
  // Computes a skyline, which takes a second. Call from any thread.
  WebResponse compute(const LandTask& task) const;
  void keep(const LandTask& task, WebResponse response);

  static constexpr double kMoved_m = 1.0;  // if a camera has moved farther than this, its skyline
                                           // is computed again

 private:
  struct Kept {
    Eigen::Vector3d camera_ecef = Eigen::Vector3d::Zero();
    std::optional<WebResponse> response;  // nullopt: it is being computed
  };
  std::string version_;
  std::shared_ptr<const land::Terrain> terrain_;
  std::map<std::string, Kept> kept_;  // by station
};

}  // namespace ols::console
