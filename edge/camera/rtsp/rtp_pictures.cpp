#include "edge/camera/rtsp/rtp_pictures.h"

#include <algorithm>

namespace ols::camera {
namespace {

constexpr std::size_t kMost = 256;  // pictures between network and decoder
// 73 years: differences to times of UTC stay within 64 bits, whatever stamps a camera sends.
constexpr double kLongest_ns = 0x1p61;

}  // namespace

std::optional<RtpPacket> rtp_packet(std::span<const std::uint8_t> bytes) {
  constexpr std::size_t kBytes = 8;
  if (bytes.size() < kBytes) return std::nullopt;
  RtpPacket packet;
  packet.sequence = static_cast<std::uint16_t>(bytes[2] << 8 | bytes[3]);
  packet.last = (bytes[1] & 0x80U) != 0;
  packet.stamp = std::uint32_t{bytes[4]} << 24 | std::uint32_t{bytes[5]} << 16 |
                 std::uint32_t{bytes[6]} << 8 | bytes[7];
  return packet;
}

RtpPictures::Entry* RtpPictures::find(std::uint64_t pts_ns) {
  const auto entry = std::ranges::find(entries_, pts_ns, &Entry::pts_ns);
  return entry == entries_.end() ? nullptr : &*entry;
}

void RtpPictures::add(const RtpPacket& packet) {
  // A gap; a packet that comes late is not one.
  const auto step =
      static_cast<std::int16_t>(packet.sequence - sequence_.value_or(packet.sequence));
  const bool lost = sequence_ && step > 1;
  if (lost) lost_packets_ += static_cast<std::uint64_t>(step - 1);
  if (!sequence_) stamp_ = packet.stamp;
  // The end of the picture before is lost, too.
  if (lost && !ended_ && !entries_.empty()) entries_.back().lost_here = true;
  ended_ = packet.last;
  sequence_ = packet.sequence;
  ticks_ += static_cast<std::int32_t>(packet.stamp - stamp_);
  stamp_ = packet.stamp;
  if (Entry* known = find(packet.pts_ns)) {
    known->lost_here |= lost;
    return;
  }
  Entry entry;
  entry.pts_ns = packet.pts_ns;
  entry.picture = {.number = ++number_,
                   .device_ns = static_cast<std::int64_t>(std::clamp(
                       1e9 / clock_hz_ * static_cast<double>(ticks_), -kLongest_ns, kLongest_ns)),
                   .arrival_s = packet.arrival_s,
                   .report_utc_ns = packet.report_utc_ns,
                   .broken = false};
  entry.lost_here = lost;
  entries_.push_back(entry);
  if (entries_.size() > kMost) entries_.pop_front();
}

void RtpPictures::decoding(std::uint64_t pts_ns, bool whole) {
  Entry* entry = find(pts_ns);
  // Pictures of which too little was left for the decoder.
  for (Entry& before : entries_) {
    if (entry == nullptr || before.picture.number >= entry->picture.number) break;
    broken_ |= !before.decoding;
    before.decoding = true;
  }
  if (whole) broken_ = false;
  // A whole picture with a gap before it may have lost its own beginning.
  if (entry == nullptr || entry->lost_here) broken_ = true;
  if (entry == nullptr) return;
  entry->decoding = true;
  entry->picture.broken = broken_;
}

std::optional<RtpPicture> RtpPictures::take(std::uint64_t pts_ns) {
  const Entry* entry = find(pts_ns);
  if (entry == nullptr) return std::nullopt;
  const RtpPicture picture = entry->picture;
  // Those shown before it were left out on the way.
  std::erase_if(entries_, [&](const Entry& e) { return e.picture.device_ns <= picture.device_ns; });
  return picture;
}

}  // namespace ols::camera
