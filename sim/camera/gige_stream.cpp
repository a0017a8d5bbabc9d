#include "sim/camera/gige_stream.h"

#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/uio.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <ctime>
#include <system_error>

#include "base/process/clocks.h"

namespace ols::sim {
namespace {

constexpr std::size_t kKept = 2;     // frames available for resend
constexpr std::size_t kWaiting = 2;  // max frames waiting to be sent

// Packets due within the first are sent at once: a sleep is no more exact. A sender later than the
// second does not catch up; otherwise the packets would come in unrealistic bursts.
constexpr std::int64_t kGrain_ns = 300'000, kCatchUp_ns = 2'000'000;

void sleep_until(std::int64_t monotonic_ns) {
  const timespec until{.tv_sec = monotonic_ns / 1'000'000'000,
                       .tv_nsec = monotonic_ns % 1'000'000'000};
  while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr) == EINTR) {
  }
}

std::size_t per_packet(const StreamSettings& settings) {
  return static_cast<std::size_t>(settings.packet_size - gige::kUdpOverhead - gige::kHeader);
}

std::size_t bytes(const cv::Mat& picture) { return picture.total() * picture.elemSize(); }

iovec part(const void* data, std::size_t size) {
  return {.iov_base = const_cast<void*>(data), .iov_len = size};  // sendmsg only reads
}

}  // namespace

GigeStream::GigeStream(std::uint32_t address) {
  fd_ = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  sockaddr_in local{};
  local.sin_family = AF_INET;
  local.sin_addr.s_addr = address;
  if (fd_ < 0 || bind(fd_, reinterpret_cast<const sockaddr*>(&local), sizeof local) != 0) {
    const int error = errno;
    if (fd_ >= 0) close(fd_);
    throw std::system_error(error, std::generic_category(), "camera's stream socket");
  }
  thread_ = std::thread([this] { run(); });
}

GigeStream::~GigeStream() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  changed_.notify_all();
  thread_.join();
  close(fd_);
}

cv::Mat GigeStream::blank(int width_px, int height_px, int type) {
  const std::lock_guard lock(mutex_);
  cv::Mat picture;
  if (sent_.size() > kKept + kWaiting) {
    // It has no other owner: resend() works under the lock, and it was sent long ago.
    picture = sent_.front()->picture;
    sent_.pop_front();
  }
  picture.create(height_px, width_px, type);
  return picture;
}

void GigeStream::send_packet(const Sent& sent, std::uint32_t packet, gige::Status status) const {
  const std::size_t total = bytes(sent.picture);
  const std::size_t size = per_packet(sent.settings);
  const std::uint32_t last = gige::payload_packets(total, size) + 1;
  const auto content = packet == 0      ? gige::Content::kLeader
                       : packet >= last ? gige::Content::kTrailer
                                        : gige::Content::kPayload;
  const auto header = gige::stream_header(sent.description.id, content, packet, status);
  const auto leader = gige::leader(sent.description);
  const auto trailer = gige::trailer(sent.description);
  std::array<iovec, 2> parts{part(header.data(), header.size()), {}};
  if (content == gige::Content::kLeader) {
    parts[1] = part(leader.data(), leader.size());
  } else if (content == gige::Content::kTrailer) {
    parts[1] = part(trailer.data(), trailer.size());
  } else {
    const std::size_t offset = (packet - 1) * size;
    parts[1] = part(sent.picture.data + offset, std::min(size, total - offset));
  }
  sockaddr_in to{};
  to.sin_family = AF_INET;
  to.sin_addr.s_addr = sent.settings.address;
  to.sin_port = htons(sent.settings.port);
  msghdr message{};
  message.msg_name = &to;
  message.msg_namelen = sizeof to;
  message.msg_iov = parts.data();
  message.msg_iovlen = status == gige::Status::kSuccess ? 2 : 1;
  // The client must notice what the network loses.
  [[maybe_unused]] const ssize_t result = sendmsg(fd_, &message, MSG_NOSIGNAL);
}

void GigeStream::send(const StreamSettings& settings, const gige::Picture& description,
                      const cv::Mat& picture) {
  const auto sent = std::make_shared<const Sent>(Sent{settings, description, picture});
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return waiting_.size() < kWaiting || stop_; });
  sent_.push_back(sent);
  waiting_.push_back(sent);
  lock.unlock();
  changed_.notify_all();
}

void GigeStream::run() {
  std::unique_lock lock(mutex_);
  for (;;) {
    changed_.wait(lock, [this] { return !waiting_.empty() || stop_; });
    if (stop_) return;
    const auto sent = waiting_.front();
    lock.unlock();
    send_paced(*sent);
    lock.lock();
    waiting_.pop_front();
    changed_.notify_all();
  }
}

void GigeStream::send_paced(const Sent& sent) {
  const std::uint32_t last =
      gige::payload_packets(bytes(sent.picture), per_packet(sent.settings)) + 1;
  const auto delay_ns = static_cast<std::int64_t>(1e9 * sent.settings.packet_delay_s);
  std::int64_t due_ns = clock_monotonic_ns();
  for (std::uint32_t packet = 0; packet <= last; ++packet) {
    const std::int64_t now_ns = clock_monotonic_ns();
    if (due_ns > now_ns + kGrain_ns) sleep_until(due_ns);
    if (!loses_one()) send_packet(sent, packet, gige::Status::kSuccess);
    due_ns = std::max(due_ns + delay_ns, now_ns - kCatchUp_ns);
  }
}

void GigeStream::set_loss(double share, bool can_resend) {
  const std::lock_guard lock(loss_mutex_);
  loss_ = share;
  can_resend_ = can_resend;
}

bool GigeStream::loses_one() {
  const std::lock_guard lock(loss_mutex_);
  return loss_ > 0.0 && std::uniform_real_distribution<double>()(generator_) < loss_;
}

void GigeStream::resend(const ResendRequest& request) {
  {
    const std::lock_guard lock(loss_mutex_);
    if (!can_resend_) return;
  }
  const std::lock_guard lock(mutex_);
  const auto found = std::find_if(sent_.begin(), sent_.end(), [&](const auto& sent) {
    return sent->description.id == request.frame;
  });
  if (found == sent_.end()) return;
  const Sent& sent = **found;
  const std::uint32_t last =
      gige::payload_packets(bytes(sent.picture), per_packet(sent.settings)) + 1;
  for (std::uint32_t packet = request.first; packet <= std::min(request.last, last); ++packet)
    if (!loses_one()) send_packet(sent, packet, gige::Status::kSuccess);
}

}  // namespace ols::sim
