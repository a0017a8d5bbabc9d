#include "tools/sim/camera_server.h"

#include <arpa/inet.h>
#include <ifaddrs.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <ctime>
#include <mutex>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "base/clocks.h"
#include "tools/sim/gige_device.h"
#include "tools/sim/gige_stream.h"

namespace ols::sim {
namespace {

using Clock = std::chrono::steady_clock;  // CLOCK_MONOTONIC

constexpr std::uint16_t kControlPort = 3956;
constexpr auto kHeartbeatCheck = std::chrono::milliseconds(200);
constexpr std::uint64_t kFrameIds = 65535;
constexpr std::uint64_t kFirstId = 65400;  // soon wraps: what cannot stand that shall show early

double seconds(Clock::time_point time) {
  return std::chrono::duration<double>(time.time_since_epoch()).count();
}

Clock::duration duration(double seconds_) {
  return std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds_));
}

in_addr_t parse_address(const std::string& text) {
  in_addr address{};
  if (inet_pton(AF_INET, text.c_str(), &address) != 1)
    throw std::system_error(EINVAL, std::generic_category(), "camera address " + text);
  return address.s_addr;
}

int control_socket(in_addr_t address, bool shared) {
  const int fd = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  if (fd < 0) return -1;
  const int on = shared ? 1 : 0;
  setsockopt(fd, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
  sockaddr_in local{};
  local.sin_family = AF_INET;
  local.sin_addr.s_addr = address;
  local.sin_port = htons(kControlPort);
  if (bind(fd, reinterpret_cast<const sockaddr*>(&local), sizeof local) == 0) return fd;
  const int error = errno;
  close(fd);
  errno = error;
  return -1;
}

// The mask of the network that the interface with this address is on.
in_addr_t network_mask(in_addr_t address) {
  ifaddrs* list = nullptr;
  if (getifaddrs(&list) != 0) return INADDR_BROADCAST;
  in_addr_t found = INADDR_BROADCAST;
  for (const ifaddrs* i = list; i != nullptr; i = i->ifa_next) {
    if (i->ifa_addr == nullptr || i->ifa_addr->sa_family != AF_INET || i->ifa_netmask == nullptr)
      continue;
    const auto own = reinterpret_cast<const sockaddr_in*>(i->ifa_addr)->sin_addr.s_addr;
    const auto mask = reinterpret_cast<const sockaddr_in*>(i->ifa_netmask)->sin_addr.s_addr;
    if ((own & mask) == (address & mask)) found = mask;
  }
  freeifaddrs(list);
  return found;
}

}  // namespace

struct CameraServer::Impl {
  Impl(const CameraServerConfig& config, std::function<void(const Exposure&, cv::Mat&)> draw);
  ~Impl();

  void run_control();
  void receive(int fd);
  void run_stream();
  void expose(const StreamSettings& settings, Clock::time_point start);
  // True when the camera shall end.
  bool wait_until(Clock::time_point time);

  const CameraServerConfig config_;
  const std::function<void(const Exposure&, cv::Mat&)> draw_;
  const in_addr_t address_, mask_;
  GigeDevice device_;
  GigeStream stream_;
  std::vector<int> control_;  // the own address first; the others hear broadcasts
  int wake_ = -1;
  std::uint64_t frames_ = 0;  // of the stream thread
  std::atomic<std::uint64_t> skipped_ = 0;
  std::atomic<bool> gone_ = false;

  std::mutex mutex_;
  std::condition_variable changed_;
  bool stop_ = false;

  std::thread control_thread_, stream_thread_;
};

CameraServer::Impl::Impl(const CameraServerConfig& config,
                         std::function<void(const Exposure&, cv::Mat&)> draw)
    : config_(config),
      draw_(std::move(draw)),
      address_(parse_address(config.address)),
      mask_(network_mask(address_)),
      device_(config.serial, address_, config.width_px, config.height_px, config.exposure_s),
      stream_(address_) {
  const int own = control_socket(address_, false);
  if (own < 0)
    throw std::system_error(errno, std::generic_category(), "camera address " + config.address);
  control_.push_back(own);
  for (const in_addr_t address : {in_addr_t{INADDR_BROADCAST}, address_ | ~mask_}) {
    const int fd = control_socket(address, true);
    if (fd >= 0) control_.push_back(fd);
  }
  wake_ = eventfd(0, EFD_CLOEXEC);
  control_thread_ = std::thread([this] { run_control(); });
  stream_thread_ = std::thread([this] { run_stream(); });
}

CameraServer::Impl::~Impl() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  changed_.notify_all();
  eventfd_write(wake_, 1);
  control_thread_.join();
  stream_thread_.join();
  for (const int fd : control_) close(fd);
  close(wake_);
}

void CameraServer::Impl::run_control() {
  std::vector<pollfd> ready;
  for (const int fd : control_) ready.push_back({.fd = fd, .events = POLLIN, .revents = 0});
  ready.push_back({.fd = wake_, .events = POLLIN, .revents = 0});
  while (poll(ready.data(), ready.size(), -1) >= 0 || errno == EINTR) {
    if (ready.back().revents != 0) return;
    for (const pollfd& entry : ready)
      if (entry.revents != 0) receive(entry.fd);
  }
}

void CameraServer::Impl::receive(int fd) {
  std::array<std::uint8_t, 2048> packet{};
  sockaddr_in from{};
  socklen_t from_size = sizeof from;
  const ssize_t size =
      recvfrom(fd, packet.data(), packet.size(), 0, reinterpret_cast<sockaddr*>(&from), &from_size);
  if (size <= 0 || gone_) return;
  // The host's other interfaces hear broadcasts that a camera on this network would not.
  if ((from.sin_addr.s_addr & mask_) != (address_ & mask_)) return;
  const std::uint64_t peer = std::uint64_t{from.sin_addr.s_addr} << 16 | from.sin_port;
  const Answer answer = device_.handle(gige::Bytes(packet).first(static_cast<std::size_t>(size)),
                                       peer, clock_utc_ns(), seconds(Clock::now()));
  if (!answer.acknowledgement.empty())
    sendto(control_.front(), answer.acknowledgement.data(), answer.acknowledgement.size(), 0,
           reinterpret_cast<const sockaddr*>(&from), from_size);
  if (answer.resend) stream_.resend(*answer.resend);
  { const std::lock_guard lock(mutex_); }
  changed_.notify_all();  // perhaps it said to start
}

bool CameraServer::Impl::wait_until(Clock::time_point time) {
  std::unique_lock lock(mutex_);
  return changed_.wait_until(lock, time, [this] { return stop_; });
}

void CameraServer::Impl::run_stream() {
  std::optional<Clock::time_point> start;  // of the next exposure
  for (;;) {
    const auto settings = device_.streaming(seconds(Clock::now()));
    if (!settings) {
      start.reset();
      std::unique_lock lock(mutex_);
      if (!stop_) changed_.wait_for(lock, kHeartbeatCheck);
      if (stop_) return;
      continue;
    }
    const auto period = duration(settings->period_s);
    const auto until_drawn = duration(settings->exposure_s + config_.readout_s);
    if (!start) start = Clock::now();
    if (wait_until(*start + until_drawn)) return;
    if (!device_.streaming(seconds(Clock::now()))) continue;
    expose(*settings, *start);
    *start += period;
    for (const auto now = Clock::now(); *start + until_drawn + period < now; *start += period)
      ++skipped_;
  }
}

void CameraServer::Impl::expose(const StreamSettings& settings, Clock::time_point start) {
  if (gone_) {
    ++frames_;  // the camera goes on behind the cut line until its heartbeat runs out
    return;
  }
  const auto ago =
      std::chrono::duration_cast<std::chrono::nanoseconds>(Clock::now() - start).count();
  const Exposure exposure{.start_realtime_ns = clock_utc_ns() - ago,
                          .exposure_s = settings.exposure_s,
                          .frame = frames_};
  cv::Mat picture =
      stream_.blank(static_cast<int>(settings.width), static_cast<int>(settings.height));
  draw_(exposure, picture);
  const gige::Picture description{
      .id = static_cast<std::uint16_t>((kFirstId - 1 + frames_) % kFrameIds + 1),
      .stamp = static_cast<std::uint64_t>(exposure.start_realtime_ns),
      .format = settings.format,
      .width = settings.width,
      .height = settings.height};
  stream_.send(settings, description, picture);
  ++frames_;
}

CameraServer::CameraServer(const CameraServerConfig& config,
                           std::function<void(const Exposure&, cv::Mat&)> draw)
    : impl_(std::make_unique<Impl>(config, std::move(draw))) {}

CameraServer::~CameraServer() = default;

void CameraServer::set_size(int width_px, int height_px) {
  impl_->device_.set_size(width_px, height_px);
}

void CameraServer::set_faults(const CameraFaults& faults) {
  impl_->gone_ = faults.gone;
  impl_->stream_.set_loss(faults.packet_loss, !faults.no_resend);
  impl_->device_.set_faults(!faults.no_resend, faults.pixel_format);
}

std::uint64_t CameraServer::skipped() const { return impl_->skipped_; }

}  // namespace ols::sim
