// The two sockets of a multicast bus: one sends to the group, one receives from it.
#pragma once

#include <netinet/in.h>
#include <sys/socket.h>

#include <atomic>
#include <cstdint>
#include <optional>
#include <span>
#include <system_error>

#include "base/bus/lcm_url.h"

namespace ols {

class MulticastSocket {
 public:
  // Throws std::system_error, for example if no route leads to the group.
  explicit MulticastSocket(const BusAddress& address);
  ~MulticastSocket();
  MulticastSocket(const MulticastSocket&) = delete;
  MulticastSocket& operator=(const MulticastSocket&) = delete;

  // Joins the group. Throws std::system_error.
  void listen();
  // The file descriptor to poll: readable when a datagram waits; -1 before listen().
  int descriptor() const { return receiving_; }
  // The next datagram, in `buffer`; nullopt if none waits.
  std::optional<std::span<const std::uint8_t>> receive(std::span<std::uint8_t> buffer);

  // Number of datagrams that the kernel dropped because this process did not fetch earlier ones in
  // time. The number is updated whenever a datagram is received. Call from any thread.
  std::uint64_t dropped() const { return dropped_; }

  // Returns the reason if the datagram could not be sent, otherwise no error.
  std::error_code send(std::span<const std::uint8_t> datagram);

 private:
  void count_dropped(msghdr& message);

  BusAddress address_;
  int sending_ = -1;
  int receiving_ = -1;
  std::uint32_t kernels_count_ = 0;  // dropped datagrams as the kernel counts them, modulo 2^32
  std::atomic<std::uint64_t> dropped_ = 0;
};

}  // namespace ols
