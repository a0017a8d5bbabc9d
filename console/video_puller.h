// Pulls the pictures of the stations that somebody looks at, once each and codec, in a thread of
// its own; of each station only the newest is kept, of H.264 what it takes to decode that.
#pragma once

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

  // From now on these, and no others.
  void watch(const WatchedVideos& videos);
  // Since the last call: the newest picture of each station; of H.264 all, the oldest first.
  std::vector<Picture> take();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
  WatchedVideos watched_;
};

}  // namespace ols::console
