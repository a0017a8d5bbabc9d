// Fetches the pictures of the watched videos from the stations, in its own thread. Only the newest
// picture of each video is kept; for H.264, also the units that are needed to decode it.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "console/received.h"
#include "console/video_link.h"

namespace ols::console {

class VideoPuller {
 public:
  // `networks`: connects only to addresses in these networks, because the addresses come over the
  // bus, where anybody may write. Throws std::invalid_argument if a network is not valid.
  VideoPuller(const std::vector<std::string>& networks, const VideoWish& wish);
  ~VideoPuller();
  VideoPuller(const VideoPuller&) = delete;
  VideoPuller& operator=(const VideoPuller&) = delete;

  // From now on, fetches these videos and no others.
  void watch(const WatchedVideos& videos);
  // The pictures since the last call: of JPEG, the newest of each station; of H.264, all units,
  // oldest first.
  std::vector<Picture> take();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
  WatchedVideos watched_;
};

}  // namespace ols::console
