#include "sim/camera/gige_wire.h"

#include <algorithm>
#include <concepts>

namespace ols::sim::gige {
namespace {

constexpr std::uint8_t kCommandKey = 0x42;
constexpr std::size_t kControlHeader = 8;
constexpr std::uint16_t kImage = 1;  // payload type

// Writes numbers one after the other, most significant byte first.
class Writer {
 public:
  explicit Writer(std::span<std::uint8_t> to) : to_(to) {}
  template <std::unsigned_integral T>
  Writer& put(T value) {
    for (std::size_t i = sizeof(T); i-- > 0;)
      to_[at_++] = static_cast<std::uint8_t>(static_cast<std::uint64_t>(value) >> (8 * i));
    return *this;
  }

 private:
  std::span<std::uint8_t> to_;
  std::size_t at_ = 0;
};

std::uint16_t two(Bytes bytes) { return static_cast<std::uint16_t>(bytes[0] << 8 | bytes[1]); }

}  // namespace

std::uint32_t big_endian(Bytes four) {
  return std::uint32_t{two(four)} << 16 | two(four.subspan(2));
}

std::array<std::uint8_t, 4> big_endian(std::uint32_t value) {
  std::array<std::uint8_t, 4> bytes{};
  Writer(bytes).put(value);
  return bytes;
}

std::optional<ControlPacket> parse(Bytes packet) {
  if (packet.size() < kControlHeader || packet[0] != kCommandKey) return std::nullopt;
  const std::size_t length = two(packet.subspan(4));
  if (packet.size() < kControlHeader + length) return std::nullopt;
  return ControlPacket{.command = static_cast<Command>(two(packet.subspan(2))),
                       .id = two(packet.subspan(6)),
                       .data = packet.subspan(kControlHeader, length)};
}

std::vector<std::uint8_t> acknowledge(const ControlPacket& asked, Status status, Bytes data) {
  std::vector<std::uint8_t> packet(kControlHeader + data.size());
  Writer(packet)
      .put(static_cast<std::uint16_t>(status))
      .put(static_cast<std::uint16_t>(static_cast<std::uint16_t>(asked.command) + 1))
      .put(static_cast<std::uint16_t>(data.size()))
      .put(asked.id);
  std::copy(data.begin(), data.end(), packet.begin() + kControlHeader);
  return packet;
}

std::array<std::uint8_t, kHeader> stream_header(std::uint16_t id, Content content,
                                                std::uint32_t packet, Status status) {
  std::array<std::uint8_t, kHeader> bytes{};
  Writer(bytes)
      .put(static_cast<std::uint16_t>(status))
      .put(id)
      .put(static_cast<std::uint32_t>(content) << 24 | (packet & 0xffffffU));
  return bytes;
}

std::array<std::uint8_t, 36> leader(const Picture& picture) {
  std::array<std::uint8_t, 36> bytes{};  // fields left out below are zero: offsets and paddings
  Writer(bytes)
      .put(std::uint16_t{0})
      .put(kImage)
      .put(picture.stamp)
      .put(picture.format)
      .put(picture.width)
      .put(picture.height);
  return bytes;
}

std::array<std::uint8_t, 8> trailer(const Picture& picture) {
  std::array<std::uint8_t, 8> bytes{};
  Writer(bytes).put(std::uint16_t{0}).put(kImage).put(picture.height);
  return bytes;
}

}  // namespace ols::sim::gige
