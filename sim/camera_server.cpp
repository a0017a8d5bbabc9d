#include "sim/camera_server.h"

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
#include "sim/gige_device.h"
#include "sim/gige_registers.h"
#include "sim/gige_sensor.h"
#include "sim/gige_stream.h"

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

std::int64_t nanoseconds(Clock::time_point time) {
  return std::chrono::nanoseconds(time.time_since_epoch()).count();
}

bool is_timed(Trigger trigger) {
  return trigger == Trigger::kFreerun || trigger == Trigger::kFixedRate;
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
  std::optional<Clock::time_point> next_start(const StreamSettings& settings);
  void expose(const StreamSettings& settings, Clock::time_point start);
  // True when the camera shall end.
  bool wait_until(Clock::time_point time);
  void trigger(Trigger source);
  // The camera's clock at an instant: its own, or that of the PTP master.
  std::int64_t device_ns(Clock::time_point time);

  const CameraServerConfig config_;
  const std::function<void(const Exposure&, cv::Mat&)> draw_;
  const in_addr_t address_, mask_;
  const Clock::time_point switched_on_ = Clock::now();
  GigeDevice device_;
  GigeStream stream_;
  std::vector<int> control_;  // the own address first; the others hear broadcasts
  int wake_ = -1;

  // Of the stream thread.
  std::uint64_t frames_ = 0;
  std::optional<Clock::time_point> last_start_;
  cv::Mat gray_;

  std::atomic<std::uint64_t> skipped_ = 0;
  std::atomic<bool> gone_ = false;

  std::mutex mutex_;
  std::condition_variable changed_;
  bool stop_ = false;
  std::optional<std::pair<Trigger, Clock::time_point>> triggered_;

  std::thread control_thread_, stream_thread_;
};

CameraServer::Impl::Impl(const CameraServerConfig& config,
                         std::function<void(const Exposure&, cv::Mat&)> draw)
    : config_(config),
      draw_(std::move(draw)),
      address_(parse_address(config.address)),
      mask_(network_mask(address_)),
      device_({.serial = config.serial,
               .address = address_,
               .width_px = config.width_px,
               .height_px = config.height_px,
               .exposure_s = config.exposure_s,
               .names = config.names,
               .tick_frequency = config.tick_frequency}),
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
  const auto now = Clock::now();
  const Answer answer = device_.handle(gige::Bytes(packet).first(static_cast<std::size_t>(size)),
                                       peer, device_ns(now), seconds(now));
  if (!answer.acknowledgement.empty())
    sendto(control_.front(), answer.acknowledgement.data(), answer.acknowledgement.size(), 0,
           reinterpret_cast<const sockaddr*>(&from), from_size);
  if (answer.resend) stream_.resend(*answer.resend);
  if (answer.trigger) trigger(Trigger::kSoftware);
  { const std::lock_guard lock(mutex_); }
  changed_.notify_all();  // perhaps it said to start
}

bool CameraServer::Impl::wait_until(Clock::time_point time) {
  std::unique_lock lock(mutex_);
  return changed_.wait_until(lock, time, [this] { return stop_; });
}

void CameraServer::Impl::trigger(Trigger source) {
  {
    const std::lock_guard lock(mutex_);
    triggered_ = {source, Clock::now()};
  }
  changed_.notify_all();
}

std::int64_t CameraServer::Impl::device_ns(Clock::time_point time) {
  if (device_.ptp_slave(seconds(time))) {
    const std::int64_t utc_ns = clock_utc_ns() - (nanoseconds(Clock::now()) - nanoseconds(time));
    return utc_ns + std::llround(1e9 * config_.tai_minus_utc_s);
  }
  const auto age_ns = static_cast<double>(nanoseconds(time) - nanoseconds(switched_on_));
  return 1'000'000'000 + std::llround(age_ns * (1.0 + 1e-6 * config_.clock_drift_ppm));
}

// Of the next exposure; nothing when none is known yet. Waits a little for a trigger.
std::optional<Clock::time_point> CameraServer::Impl::next_start(const StreamSettings& settings) {
  const auto period = duration(settings.period_s);
  if (is_timed(settings.trigger)) return last_start_ ? *last_start_ + period : Clock::now();
  std::unique_lock lock(mutex_);
  changed_.wait_for(lock, kHeartbeatCheck, [this] { return stop_ || triggered_; });
  const auto triggered = std::exchange(triggered_, std::nullopt);
  if (!triggered || triggered->first != settings.trigger) return std::nullopt;
  const auto start = triggered->second + duration(settings.trigger_delay_s);
  // As long as it is busy with the last exposure it takes no trigger.
  if (last_start_ && start < *last_start_ + period) return std::nullopt;
  return start;
}

void CameraServer::Impl::run_stream() {
  for (;;) {
    auto settings = device_.streaming(seconds(Clock::now()));
    if (!settings) {
      last_start_.reset();
      std::unique_lock lock(mutex_);
      triggered_.reset();
      if (!stop_) changed_.wait_for(lock, kHeartbeatCheck);
      if (stop_) return;
      continue;
    }
    const auto start = next_start(*settings);
    if (wait_until(start.value_or(Clock::now()))) return;
    if (!start) continue;
    // What is set when the exposure begins is what it is made with.
    settings = device_.streaming(seconds(Clock::now()));
    if (!settings) continue;
    const auto until_drawn = duration(settings->exposure_s + config_.readout_s);
    if (wait_until(*start + until_drawn)) return;
    if (!device_.streaming(seconds(Clock::now()))) continue;
    last_start_ = start;
    expose(*settings, *start);
    const auto period = duration(settings->period_s);
    if (!is_timed(settings->trigger)) continue;
    for (const auto now = Clock::now(); *last_start_ + period + until_drawn + period < now;) {
      *last_start_ += period;
      ++skipped_;
    }
  }
}

void CameraServer::Impl::expose(const StreamSettings& settings, Clock::time_point start) {
  if (gone_) {
    ++frames_;  // the camera goes on behind the cut line until its heartbeat runs out
    return;
  }
  const Exposure exposure{.start_monotonic_ns = nanoseconds(start),
                          .exposure_s = settings.exposure_s,
                          .gain_dB = settings.gain_dB,
                          .frame = frames_};
  const int width = static_cast<int>(settings.width), height = static_cast<int>(settings.height);
  cv::Mat raw = stream_.blank(width, height, gige::picture_type(settings.format));
  if (settings.format == gige::kMono8) {
    draw_(exposure, raw);
  } else {
    gray_.create(height, width, CV_8UC1);
    draw_(exposure, gray_);
    gige::develop(gray_, kTint, settings.format, raw);
  }
  const gige::Picture description{
      .id = static_cast<std::uint16_t>((kFirstId - 1 + frames_) % kFrameIds + 1),
      .stamp = static_cast<std::uint64_t>(device_ns(start)),
      .format = settings.format,
      .width = settings.width,
      .height = settings.height};
  stream_.send(settings, description, raw);
  ++frames_;
}

CameraServer::CameraServer(const CameraServerConfig& config,
                           std::function<void(const Exposure&, cv::Mat&)> draw)
    : impl_(std::make_unique<Impl>(config, std::move(draw))) {}

CameraServer::~CameraServer() = default;

void CameraServer::pulse(int line) {
  constexpr std::array kLines{Trigger::kLine1, Trigger::kLine2, Trigger::kLine3, Trigger::kLine4};
  impl_->trigger(kLines.at(static_cast<std::size_t>(line - 1)));
}

void CameraServer::power_cycle() { impl_->device_.power_cycle(); }

void CameraServer::set_size(int width_px, int height_px) {
  impl_->device_.set_size(width_px, height_px);
}

void CameraServer::set_faults(const CameraFaults& faults) {
  impl_->gone_ = faults.gone;
  impl_->stream_.set_loss(faults.gone ? 1.0 : faults.packet_loss, !faults.no_resend);
  impl_->device_.set_faults(!faults.no_resend, faults.pixel_format);
}

std::uint64_t CameraServer::skipped() const { return impl_->skipped_; }

}  // namespace ols::sim
