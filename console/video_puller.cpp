#include "console/video_puller.h"

#include <boost/asio/executor_work_guard.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/post.hpp>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <thread>
#include <utility>

#include "base/ip_endpoint.h"
#include "base/ip_networks.h"
#include "console/messages_pictures.h"

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

  // --- of the pulling thread

  void follow(const std::map<std::string, std::string>& addresses) {
    std::erase_if(links, [&](auto& pulled) {
      const auto wanted = addresses.find(pulled.first);
      const bool stays = wanted != addresses.end() && wanted->second == pulled.second.address;
      if (!stays) pulled.second.link->end();
      return !stays;
    });
    for (const auto& [station, address] : addresses) {
      if (!links.contains(station)) begin(station, address);
    }
  }

  void begin(const std::string& station, const std::string& address) {
    std::optional<asio::ip::tcp::endpoint> endpoint;
    try {
      endpoint = parse_endpoint(address);
    } catch (const std::invalid_argument&) {
      return;  // a forged status
    }
    if (!networks.contain(endpoint->address())) return;
    const auto link = std::make_shared<VideoLink>(io, *endpoint, wish,
                                                  [this, station](std::vector<std::uint8_t> bytes) {
                                                    return keep(station, video_picture_from(bytes));
                                                  });
    links[station] = {address, link};
    link->begin();
  }

  std::optional<std::int64_t> keep(const std::string& station, std::optional<Picture> picture) {
    if (!picture || picture->station != station) return std::nullopt;
    const std::int64_t utime_us = picture->header.at("utime_us");
    const std::lock_guard lock(mutex);
    newest[station] = std::move(*picture);
    return utime_us;
  }

  const IpNetworks networks;
  const VideoWish wish;
  asio::io_context io{1};
  asio::executor_work_guard<asio::io_context::executor_type> work;
  std::map<std::string, Pulled> links;

  std::mutex mutex;
  std::map<std::string, Picture> newest;

  std::jthread thread;  // last: it uses the rest
};

VideoPuller::VideoPuller(const std::vector<std::string>& networks, const VideoWish& wish)
    : impl_(std::make_unique<Impl>(networks, wish)) {}

VideoPuller::~VideoPuller() { impl_->io.stop(); }

void VideoPuller::watch(const std::map<std::string, std::string>& addresses) {
  if (addresses == watched_) return;
  watched_ = addresses;
  asio::post(impl_->io, [impl = impl_.get(), addresses] { impl->follow(addresses); });
}

std::vector<Picture> VideoPuller::take() {
  std::map<std::string, Picture> taken;
  {
    const std::lock_guard lock(impl_->mutex);
    taken.swap(impl_->newest);
  }
  std::vector<Picture> pictures;
  for (auto& [station, picture] : taken) pictures.push_back(std::move(picture));
  return pictures;
}

}  // namespace ols::console
