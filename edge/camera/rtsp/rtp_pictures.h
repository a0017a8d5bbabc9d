// Collects stamp and arrival of each picture from the stream's RTP packets, and attaches them to
// the picture when it leaves the decoder. Pure.
//
// All packets of one picture have the same stamp. After a lost packet, all pictures are broken
// until the next key frame, which does not depend on other pictures.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <span>

namespace ols::camera {

struct RtpPacket {
  std::uint16_t sequence = 0;
  bool last = false;        // the last packet of its picture (marker bit)
  std::uint32_t stamp = 0;  // [ticks]
  // GStreamer's time of the packet, which identifies the picture in the pipeline
  std::uint64_t pts_ns = 0;
  double arrival_s = 0.0;  // CLOCK_MONOTONIC
  std::optional<std::int64_t> report_utc_ns;
};

// Reads sequence, stamp and marker from the first bytes of a packet (RFC 3550, section 5.1);
// nullopt if there are less than eight. Extensions and sources come after these.
std::optional<RtpPacket> rtp_packet(std::span<const std::uint8_t> bytes);

struct RtpPicture {
  std::uint64_t number = 0;    // counts the stream's pictures, from 1
  std::int64_t device_ns = 0;  // the RTP stamp, extended beyond 32 bits; at most 2^61
  double arrival_s = 0.0;      // arrival of the first packet
  std::optional<std::int64_t> report_utc_ns;
  bool broken = false;
};

class RtpPictures {
 public:
  // `clock_hz`: tick rate of the stamps.
  explicit RtpPictures(double clock_hz) : clock_hz_(clock_hz) {}

  void add(const RtpPacket& packet);
  // Notes that a picture enters the decoder. `whole`: the picture is a key frame.
  void decoding(std::uint64_t pts_ns, bool whole);
  // Returns the data of a picture that has left the decoder; nullopt if no packet had this pts_ns.
  std::optional<RtpPicture> take(std::uint64_t pts_ns);

  std::uint64_t lost_packets() const { return lost_packets_; }

 private:
  struct Entry {
    std::uint64_t pts_ns = 0;
    RtpPicture picture;
    bool lost_here = false;
    bool decoding = false;
  };
  Entry* find(std::uint64_t pts_ns);

  double clock_hz_;
  std::deque<Entry> entries_;
  std::optional<std::uint16_t> sequence_;
  std::uint32_t stamp_ = 0;
  bool ended_ = true;  // the newest packet was the last one of its picture
  std::int64_t ticks_ = 0;
  std::uint64_t number_ = 0;
  std::uint64_t lost_packets_ = 0;
  // The decoder's newest picture is wrong, and so are the next ones until a key frame.
  bool broken_ = false;
};

}  // namespace ols::camera
