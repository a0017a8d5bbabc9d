#include "tools/calibrate/aircraft.h"

#include <netdb.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <sstream>
#include <tuple>

#include "base/atomic_file.h"
#include "base/output_check.h"
#include "tools/calibrate/aircraft_feed.h"

namespace ols::calibration {
namespace {

std::int64_t utime_now() {
  using namespace std::chrono;
  return duration_cast<microseconds>(system_clock::now().time_since_epoch()).count();
}

// One input's bytes to positions.
class Feed {
 public:
  explicit Feed(const AircraftOptions& options) : options_(options) {}

  void take(std::span<const std::uint8_t> bytes) {
    if (options_.format == "beast") {
      const std::int64_t arrival_utime_us = utime_now();
      for (const BeastFrames::Frame& frame : frames_.take(bytes)) {
        take_frame(frame, arrival_utime_us);
      }
      return;
    }
    text_.append(bytes.begin(), bytes.end());
    if (options_.format == "sbs") take_lines();
  }
  void end() {
    if (options_.format == "beast") {
      const std::int64_t first_us = options_.start_utime_us.value_or(ticks_.first_utime_us());
      for (AircraftPosition& one : positions) one.utime_us += first_us;
    }
    if (options_.format == "sbs") {
      text_ += '\n';
      take_lines();
    }
    if (options_.format != "json") return;
    AircraftSnapshot snapshot = aircraft_json(text_);
    positions.insert(positions.end(), snapshot.positions.begin(), snapshot.positions.end());
    barometric_only += snapshot.barometric_only;
  }

  std::vector<AircraftPosition> positions;
  int barometric_only = 0;

 private:
  // Its time is that since the first frame, until the end tells when that was.
  void take_frame(const BeastFrames::Frame& frame, std::int64_t arrival_utime_us) {
    const std::int64_t since_us = ticks_.take(frame.ticks, arrival_utime_us);
    if (auto position = decoder_.take(frame.message, since_us)) {
      positions.push_back(std::move(*position));
    }
    barometric_only = decoder_.barometric_only();
  }
  void take_lines() {
    std::size_t begin = 0;
    for (std::size_t end = 0; (end = text_.find('\n', begin)) != std::string::npos;
         begin = end + 1) {
      if (auto position = sbs_position(text_.substr(begin, end - begin))) {
        positions.push_back(std::move(*position));
      }
    }
    text_.erase(0, begin);
  }

  const AircraftOptions& options_;
  TickClock ticks_;
  BeastFrames frames_;
  AdsbDecoder decoder_;
  std::string text_;
};

class Connection {
 public:
  Connection(const std::string& host, const std::string& port, const std::string& input) {
    addrinfo hints{}, *found = nullptr;
    hints.ai_socktype = SOCK_STREAM;
    if (::getaddrinfo(host.c_str(), port.c_str(), &hints, &found) != 0) {
      throw std::runtime_error("--input: " + input + ": no such host or port");
    }
    for (const addrinfo* one = found; one && fd_ < 0; one = one->ai_next) {
      fd_ = ::socket(one->ai_family, one->ai_socktype | SOCK_CLOEXEC, one->ai_protocol);
      if (fd_ < 0 || ::connect(fd_, one->ai_addr, one->ai_addrlen) == 0) continue;
      ::close(fd_);
      fd_ = -1;
    }
    ::freeaddrinfo(found);
    if (fd_ < 0) throw std::runtime_error("--input: " + input + ": cannot be connected to");
  }
  ~Connection() { ::close(fd_); }
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  // Until the other end closes, or for so long.
  void read(double duration_s, Feed& feed) const {
    using Clock = std::chrono::steady_clock;
    const auto end = Clock::now() + std::chrono::duration<double>(duration_s);
    std::vector<std::uint8_t> buffer(65536);
    while (Clock::now() < end) {
      pollfd waited{fd_, POLLIN, 0};
      constexpr int kLook_ms = 200;
      if (::poll(&waited, 1, kLook_ms) <= 0) continue;
      const ssize_t count = ::read(fd_, buffer.data(), buffer.size());
      if (count <= 0) return;
      feed.take({buffer.data(), static_cast<std::size_t>(count)});
    }
  }

 private:
  int fd_ = -1;
};

void read_file(const std::string& path, Feed& feed) {
  std::ifstream file(path, std::ios::binary);
  file.peek();
  if (!file.is_open() || file.bad()) throw std::runtime_error(path + ": cannot be read");
  std::vector<char> buffer(65536);
  while (file.read(buffer.data(), static_cast<std::streamsize>(buffer.size())) ||
         file.gcount() > 0) {
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(buffer.data());
    feed.take({bytes, static_cast<std::size_t>(file.gcount())});
  }
  if (file.bad()) throw std::runtime_error(path + ": cannot be read to its end");
}

void read_input(const std::string& input, const AircraftOptions& options, Feed& feed) {
  const std::size_t colon = input.rfind(':');
  if (std::filesystem::exists(input) || colon == std::string::npos) {
    read_file(input, feed);
  } else {
    Connection(input.substr(0, colon), input.substr(colon + 1), input)
        .read(options.duration_s, feed);
  }
  try {
    feed.end();
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(input + ": " + error.what());
  }
}

void check(const AircraftOptions& options) {
  if (options.format == "sbs" && !options.heights_are_geometric) {
    throw std::runtime_error(
        "--format sbs: its heights are barometric, wrong by tens to hundreds of metres: use beast "
        "or json, or --geometric if the receiver is set up to write heights above the ellipsoid");
  }
  std::vector<NamedFile> inputs;
  for (const std::string& input : options.inputs) {
    inputs.push_back({"--input", input});
    const bool is_file = std::filesystem::exists(input);
    if (is_file && options.format == "beast" && !options.start_utime_us) {
      throw std::runtime_error("--start-utime: is needed: a Beast file has no time of day");
    }
  }
  check_outputs(inputs, {{"--output", options.output}});
  if (std::filesystem::exists(options.output)) {
    throw std::runtime_error("--output: " + options.output + " exists: it is not overwritten");
  }
}

}  // namespace

std::string reference_rows(std::vector<AircraftPosition> positions, double sd_m) {
  constexpr std::int64_t kGap_us = 30'000'000;
  std::ranges::stable_sort(
      positions, {}, [](const AircraftPosition& one) { return std::tie(one.icao, one.utime_us); });
  std::ostringstream out;
  out << std::fixed << "landmark,latitude_deg,longitude_deg,height_m,sd_m,utime_us\n";
  for (std::size_t first = 0, pass = 1; first < positions.size();) {
    std::size_t end = first + 1;
    while (end < positions.size() && positions[end].icao == positions[first].icao &&
           positions[end].utime_us - positions[end - 1].utime_us < kGap_us) {
      ++end;
    }
    const bool again = first > 0 && positions[first - 1].icao == positions[first].icao;
    pass = again ? pass + 1 : 1;
    std::string name = positions[first].icao;
    if (pass > 1) name.append("-").append(std::to_string(pass));
    const bool moves = positions[end - 1].utime_us > positions[first].utime_us;
    for (std::size_t i = first; moves && i < end; ++i) {
      if (i > first && positions[i].utime_us == positions[i - 1].utime_us) continue;
      const AircraftPosition& one = positions[i];
      out << name << ',' << std::setprecision(7) << one.latitude_deg << ',' << one.longitude_deg
          << ',' << std::setprecision(1) << one.height_m << ',' << sd_m << ',' << one.utime_us
          << '\n';
    }
    first = end;
  }
  return out.str();
}

std::vector<std::string> write_aircraft(const AircraftOptions& options) {
  check(options);
  std::vector<AircraftPosition> positions;
  int barometric_only = 0;
  for (const std::string& input : options.inputs) {
    Feed feed(options);
    read_input(input, options, feed);
    positions.insert(positions.end(), feed.positions.begin(), feed.positions.end());
    barometric_only += feed.barometric_only;
  }
  std::vector<std::string> remarks;
  if (barometric_only > 0) {
    remarks.push_back(std::to_string(barometric_only) +
                      " positions have a barometric height alone and are left out: it is wrong by "
                      "tens to hundreds of metres");
  }
  if (positions.empty()) {
    throw std::runtime_error("--input: no position with a height above the ellipsoid" +
                             (remarks.empty() ? "" : ": " + remarks.front()));
  }
  AtomicFile file(options.output);
  file.stream() << reference_rows(std::move(positions), options.sd_m);
  file.commit();
  return remarks;
}

}  // namespace ols::calibration
