// The bytes of GigE Vision 1.x: control (GVCP) and stream (GVSP) packets. Pure.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace ols::sim::gige {

using Bytes = std::span<const std::uint8_t>;

enum class Command : std::uint16_t {
  kDiscovery = 0x0002,
  kResend = 0x0040,
  kReadRegister = 0x0080,
  kWriteRegister = 0x0082,
  kReadMemory = 0x0084,
  kWriteMemory = 0x0086,
};

enum class Status : std::uint16_t {
  kSuccess = 0x0000,
  kNotImplemented = 0x8001,
  kInvalidParameter = 0x8002,
  kInvalidAddress = 0x8003,
  kAccessDenied = 0x8006,
  kPacketUnavailable = 0x800c,
};

struct ControlPacket {
  Command command;
  std::uint16_t id = 0;
  Bytes data;
};

std::uint32_t big_endian(Bytes four);
std::array<std::uint8_t, 4> big_endian(std::uint32_t value);

// Nullopt if the packet is not a command.
std::optional<ControlPacket> parse(Bytes packet);
// The acknowledgement. Its command code is that of the request plus one.
std::vector<std::uint8_t> acknowledge(const ControlPacket& asked, Status status, Bytes data);

struct Picture {
  std::uint16_t id = 0;      // 1..65535
  std::uint64_t stamp = 0;   // ticks
  std::uint32_t format = 0;  // PFNC code
  std::uint32_t width = 0, height = 0;
};

constexpr int kUdpOverhead = 20 + 8;  // [byte] IP and UDP headers, part of the set packet size
constexpr int kHeader = 8;            // [byte] header of every stream packet

constexpr std::uint32_t payload_packets(std::size_t bytes, std::size_t per_packet) {
  return static_cast<std::uint32_t>((bytes + per_packet - 1) / per_packet);
}

enum class Content : std::uint8_t { kLeader = 1, kTrailer = 2, kPayload = 3 };
std::array<std::uint8_t, kHeader> stream_header(std::uint16_t id, Content content,
                                                std::uint32_t packet,
                                                Status status = Status::kSuccess);
std::array<std::uint8_t, 36> leader(const Picture& picture);
std::array<std::uint8_t, 8> trailer(const Picture& picture);

}  // namespace ols::sim::gige
