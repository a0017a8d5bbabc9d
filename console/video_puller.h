// Pulls the pictures of the stations that somebody looks at, once each, in a thread of its own; of
// each station only the newest is kept.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "console/heard.h"
#include "console/video_link.h"

namespace ols::console {

class VideoPuller {
 public:
  // A station is asked only if its address lies in one of these networks: addresses come over the
  // bus, where anybody may write. Throws std::invalid_argument.
  VideoPuller(const std::vector<std::string>& networks, const VideoWish& wish);
  ~VideoPuller();
  VideoPuller(const VideoPuller&) = delete;
  VideoPuller& operator=(const VideoPuller&) = delete;

  // From now on these stations, by their addresses ("10.0.0.11:7790"), and no others.
  void watch(const std::map<std::string, std::string>& addresses);
  // The newest picture of each station since the last call.
  std::vector<Picture> take();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
  std::map<std::string, std::string> watched_;
};

}  // namespace ols::console
