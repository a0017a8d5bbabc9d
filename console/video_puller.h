// Pulls the pictures of the watched stations, once for each codec, in its own thread. Only the
// newest of each station is kept; for H.264, also what is needed to decode it.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "console/received.h"
#include "console/video_link.h"

namespace ols::console {

class VideoPuller {
 public:
  // Connects only to addresses in these networks: addresses come over the bus, where anybody may
  // write. Throws std::invalid_argument.
  VideoPuller(const std::vector<std::string>& networks, const VideoWish& wish);
  ~VideoPuller();
  VideoPuller(const VideoPuller&) = delete;
  VideoPuller& operator=(const VideoPuller&) = delete;

  // From now on pulls only these videos.
  void watch(const WatchedVideos& videos);
  // What has come since the last call: the newest picture of each station; for H.264 all units,
  // oldest first.
  std::vector<Picture> take();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
  WatchedVideos watched_;
};

}  // namespace ols::console
