#include "console/video_puller.h"

#include <algorithm>
#include <boost/asio/executor_work_guard.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/post.hpp>
#include <iterator>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <thread>
#include <utility>

#include "base/net/ip_endpoint.h"
#include "base/net/ip_networks.h"
#include "console/messages_pictures.h"
#include "console/unit_chain.h"

namespace ols::console {
namespace asio = boost::asio;

struct VideoPuller::Impl {
  struct Pulled {
    std::string address;
    std::shared_ptr<VideoLink> link;
  };

  Impl(const std::vector<std::string>& of, const VideoWish& video_wish)
      : networks(of), wish(video_wish), work(asio::make_work_guard(io)) {
    thread = std::jthread([this] { io.run(); });
  }

  // --- used by the pulling thread only

  void follow(const WatchedVideos& addresses) {
    std::erase_if(links, [&](auto& pulled) {
      const auto wanted = addresses.find(pulled.first);
      const bool stays = wanted != addresses.end() && wanted->second == pulled.second.address;
      if (!stays) pulled.second.link->end();
      return !stays;
    });
    for (const auto& [video, address] : addresses) {
      if (!links.contains(video)) begin(video, address);
    }
  }

  void begin(const WatchedVideo& video, const std::string& address) {
    std::optional<asio::ip::tcp::endpoint> endpoint;
    try {
      endpoint = parse_endpoint(address);
    } catch (const std::invalid_argument&) {
      return;  // a forged status
    }
    if (!networks.contain(endpoint->address())) return;
    VideoWish of_link = wish;
    of_link.codec = video.codec;
    const auto link = std::make_shared<VideoLink>(
        io, *endpoint, of_link, [this, video](std::vector<std::uint8_t> bytes) {
          return keep(video, video_picture_from(bytes, video.codec));
        });
    links[video] = {address, link};
    link->begin();
  }

  std::optional<std::int64_t> keep(const WatchedVideo& video, std::optional<Picture> picture) {
    if (!picture || picture->station != video.station) return std::nullopt;
    const std::int64_t utime_us = picture->header.at("utime_us");
    const std::lock_guard lock(mutex);
    std::vector<Picture>& kept = newest[video];
    const bool is_full = kept.size() >= UnitChain::kMostUnits;
    if (video.codec == Codec::kJpeg || is_full) kept.clear();
    // The next frames cannot be decoded without these: a new connection begins with a key frame.
    if (video.codec == Codec::kH264 && is_full) return std::nullopt;
    kept.push_back(std::move(*picture));
    return utime_us;
  }

  const IpNetworks networks;
  const VideoWish wish;
  asio::io_context io{1};
  asio::executor_work_guard<asio::io_context::executor_type> work;
  std::map<WatchedVideo, Pulled> links;

  std::mutex mutex;
  std::map<WatchedVideo, std::vector<Picture>> newest;

  std::jthread thread;  // last: it uses the rest
};

VideoPuller::VideoPuller(const std::vector<std::string>& networks, const VideoWish& wish)
    : impl_(std::make_unique<Impl>(networks, wish)) {}

VideoPuller::~VideoPuller() { impl_->io.stop(); }

void VideoPuller::watch(const WatchedVideos& videos) {
  if (videos == watched_) return;
  watched_ = videos;
  asio::post(impl_->io, [impl = impl_.get(), videos] { impl->follow(videos); });
}

std::vector<Picture> VideoPuller::take() {
  std::map<WatchedVideo, std::vector<Picture>> taken;
  {
    const std::lock_guard lock(impl_->mutex);
    taken.swap(impl_->newest);
  }
  std::vector<Picture> pictures;
  for (auto& [video, newest] : taken) std::ranges::move(newest, std::back_inserter(pictures));
  return pictures;
}

}  // namespace ols::console
