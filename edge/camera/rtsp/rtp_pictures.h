// What the RTP packets of a stream say of its pictures, for the pictures as they leave the decoder.
// Pure.
//
// Packets of one picture have one stamp. After a lost packet all pictures are wrong until one that
// needs no other.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>

namespace ols::camera {

struct RtpPacket {
  std::uint16_t sequence = 0;
  bool last = false;         // of its picture: the marker
  std::uint32_t stamp = 0;   // [ticks]
  std::uint64_t pts_ns = 0;  // the same in the pipeline: names the picture on its way
  double arrival_s = 0.0;    // CLOCK_MONOTONIC
  std::optional<std::int64_t> report_utc_ns;
};

struct RtpPicture {
  std::uint64_t number = 0;    // counts the pictures of the stream
  std::int64_t device_ns = 0;  // the stamp, unwrapped
  double arrival_s = 0.0;      // of the first packet
  std::optional<std::int64_t> report_utc_ns;
  bool broken = false;
};

class RtpPictures {
 public:
  // `clock_hz`: ticks of the stamps.
  explicit RtpPictures(double clock_hz) : clock_hz_(clock_hz) {}

  void add(const RtpPacket& packet);
  // The decoder gets a picture; `whole`: it needs no other one.
  void decoding(std::uint64_t pts_ns, bool whole);
  // The picture that left the decoder; empty: no packet had this time.
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
  bool ended_ = true;  // the newest packet was the last of its picture
  std::int64_t ticks_ = 0;
  std::uint64_t number_ = 0;
  std::uint64_t lost_packets_ = 0;
  bool broken_ = false;  // from the picture on that the decoder got last
};

}  // namespace ols::camera
