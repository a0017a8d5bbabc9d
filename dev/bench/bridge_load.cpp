// ols-bench-bridge-load: bearings of many stations onto one bus, and when they reach another, for
// tools/bench bridge. It must not measure itself: a bearing is stamped right before it is sent, and
// the kernel says when it arrived, so that nobody has to be awake then.
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

#include "base/bus/bus_datagram.h"
#include "base/bus/multicast_socket.h"
#include "base/process/clocks.h"
#include "dev/bench/load.h"
#include "dev/bench/program.h"
#include "ols_msg/bearing_t.hpp"

namespace {

struct Arguments {
  std::string from = "udpm://239.255.76.67:7667?ttl=0", to = "udpm://239.255.76.67:7668?ttl=0";
  std::size_t stations = 1000, bytes = 400;
  double rate_hz = 15.0, seconds = 20.0;
};

constexpr auto kSettle = std::chrono::seconds(2);  // what is still under way
using Datagram = std::vector<std::uint8_t>;
constexpr std::string_view kChannel = "OLS_BEARING_";
// Behind LCM's fingerprint; and behind time, version, name's length, the name, its end and the
// boot.
constexpr std::size_t kUtimeAt = 8, kSequenceBehindName = 8 + 8 + 4 + 4 + 1 + 8;

void put(std::int64_t value, std::uint8_t* at) {
  for (int shift = 56; shift >= 0; shift -= 8) *at++ = static_cast<std::uint8_t>(value >> shift);
}

std::int64_t get(const std::uint8_t* at) {
  std::uint64_t value = 0;
  for (int i = 0; i < 8; ++i) value = value << 8 | *at++;
  return static_cast<std::int64_t>(value);
}

// One station's datagram, of which only time and sequence change.
struct Station {
  Station(std::size_t number, std::size_t size) {
    char name[16];
    std::snprintf(name, sizeof name, "s%05zu", number);
    ols_msg::bearing_t bearing{};
    bearing.schema_version = ols_msg::bearing_t::SCHEMA_VERSION;
    bearing.station = name;
    bearing.boot_id = 7;
    Datagram payload(static_cast<std::size_t>(bearing.getEncodedSize()));
    bearing.encode(payload.data(), 0, static_cast<int>(payload.size()));
    payload.resize(std::max(payload.size(), size));  // as with a signature
    datagram = ols::make_datagram(0, std::string(kChannel) + name, payload);
    payload_at = datagram.size() - payload.size();
    sequence_at = payload_at + kSequenceBehindName + bearing.station.size();
  }

  Datagram datagram;
  std::size_t payload_at = 0, sequence_at = 0;
  std::int64_t sequence = 0;
};

// Station after station. Returns the number of those that were sent.
std::size_t send(const Arguments& arguments) {
  ols::MulticastSocket socket(ols::parse_lcm_url(arguments.from));
  std::vector<Station> stations;
  for (std::size_t i = 0; i < arguments.stations; ++i) stations.emplace_back(i, arguments.bytes);
  const double rate_hz = arguments.rate_hz * static_cast<double>(stations.size());
  std::size_t sent = 0;
  ols::bench::at_rate(rate_hz, arguments.seconds, [&](std::size_t turn) {
    Station& station = stations[turn % stations.size()];
    put(++station.sequence, station.datagram.data() + station.sequence_at);
    put(ols::clock_utime_us(), station.datagram.data() + station.payload_at + kUtimeAt);
    if (!socket.send(station.datagram)) ++sent;
  });
  return sent;
}

// A socket whose datagrams have the kernel's stamps.
void listen(ols::MulticastSocket& socket) {
  socket.listen();
  const int on = 1, bytes = 64 << 20;
  // Beyond the kernel's limit only as root; what is lost without it is seen in the numbers.
  ::setsockopt(socket.descriptor(), SOL_SOCKET, SO_RCVBUFFORCE, &bytes, sizeof bytes);
  if (::setsockopt(socket.descriptor(), SOL_SOCKET, SO_TIMESTAMPNS, &on, sizeof on) != 0) {
    throw std::system_error(errno, std::generic_category(), "SO_TIMESTAMPNS");
  }
}

// [ms] Of each bearing that waits: from its own stamp to its arrival.
void read_all(const ols::MulticastSocket& socket, std::vector<double>& delays_ms) {
  std::array<std::uint8_t, 65'536> buffer;
  alignas(cmsghdr) std::array<char, 64> control;
  iovec part{buffer.data(), buffer.size()};
  while (true) {
    msghdr header{};
    header.msg_iov = &part;
    header.msg_iovlen = 1;
    header.msg_control = control.data();
    header.msg_controllen = control.size();
    const ssize_t bytes = ::recvmsg(socket.descriptor(), &header, 0);
    if (bytes < 0) return;
    const auto parsed =
        ols::parse_datagram(std::span(buffer).first(static_cast<std::size_t>(bytes)));
    const auto* datagram = std::get_if<ols::BusDatagram>(&parsed);
    const cmsghdr* stamp = CMSG_FIRSTHDR(&header);
    if (datagram == nullptr || !datagram->channel.starts_with(kChannel) || stamp == nullptr)
      continue;
    timespec arrived{};
    std::memcpy(&arrived, CMSG_DATA(stamp), sizeof arrived);
    const std::int64_t arrived_us = arrived.tv_sec * 1'000'000 + arrived.tv_nsec / 1000;
    const std::int64_t delay_us = arrived_us - get(datagram->payload.data() + kUtimeAt);
    delays_ms.push_back(1e-3 * static_cast<double>(delay_us));
  }
}

void run(const Arguments& arguments) {
  ols::MulticastSocket socket(ols::parse_lcm_url(arguments.to));
  listen(socket);
  std::vector<double> delays_ms;
  std::atomic<bool> ends{false};
  std::jthread receiver([&] {
    while (!ends) {
      read_all(socket, delays_ms);
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
  });
  const double begin_s = ols::clock_monotonic_s();
  const std::size_t sent = send(arguments);
  const double took_s = ols::clock_monotonic_s() - begin_s;
  std::printf("%s\n", nlohmann::json{{"sent", sent}, {"took_s", took_s}}.dump().c_str());
  std::fflush(stdout);
  std::this_thread::sleep_for(kSettle);
  ends = true;
  receiver.join();
  read_all(socket, delays_ms);
  std::printf("%s\n", nlohmann::json{{"delays_ms", delays_ms}}.dump().c_str());
}

void declare(CLI::App& app, Arguments& arguments) {
  app.add_option("--from", arguments.from, "the bus that they are sent to")->capture_default_str();
  app.add_option("--to", arguments.to, "the bus that they come to")->capture_default_str();
  app.add_option("--stations", arguments.stations)->check(CLI::Range(1, 50'000));
  app.add_option("--bytes", arguments.bytes, "of each, with its signature")
      ->check(CLI::Range(1, 8000));
  app.add_option("--rate", arguments.rate_hz, "[Hz] of each station")->check(CLI::Range(0.1, 1e3));
  app.add_option("--seconds", arguments.seconds)->check(CLI::Range(0.1, 3600.0));
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Bearings onto one bus, and when they reach another.", "ols-bench-bridge-load");
  Arguments arguments;
  declare(app, arguments);
  return ols::bench::run_program(app, argc, argv, [&] { run(arguments); });
}
