#include "edge/camera/rtsp/rtp_pictures.h"

#include <algorithm>

namespace ols::camera {
namespace {

constexpr std::size_t kMost = 256;  // pictures between network and decoder

}  // namespace

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
  entry.picture = {
      .number = ++number_,
      .device_ns = static_cast<std::int64_t>(1e9 / clock_hz_ * static_cast<double>(ticks_)),
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
