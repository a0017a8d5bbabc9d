#include "tools/calibrate/aircraft.h"

#include <netdb.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <sstream>
#include <thread>
#include <tuple>

#include "base/files/atomic_file.h"
#include "base/files/output_check.h"
#include "base/process/clocks.h"
#include "conditions/printed.h"
#include "edge/clock/clock_source.h"
#include "tools/calibrate/aircraft_feed.h"
#include "tools/calibrate/input_bytes.h"

namespace ols::calibration {
namespace {

// An aircraft flies 10 m in this time.
constexpr double kClock_s = 0.05;
constexpr const char* kNoPosition = "no position with a height above the ellipsoid";
constexpr const char* kNoMessage =
    "no message of this format in it: it is empty, compressed or of another --format";

// This host's clock gives positions their time, or judges it.
void check_clock() {
  constexpr double kPatience_s = 5.0;  // chronyd answers within two
  clock::ClockSource source;
  clock::ClockWatch watch{{}};
  const double end_s = clock_monotonic_s() + kPatience_s;
  std::optional<clock::ClockReading> reading;
  while (!reading && clock_monotonic_s() < end_s) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    reading = source.take();
  }
  if (reading) watch.add(*reading);
  const clock::ClockQuality quality = watch.quality(clock_monotonic_s());
  if (quality.state == clock::ClockState::kSynchronised && quality.error_s < kClock_s) return;
  throw std::runtime_error("the clock of this computer is not synchronised (" + quality.text +
                           "): aircraft cannot be used; wait for GNSS or a time server, or give "
                           "--clock-is-right if you know that it is right");
}

class Received {
 public:
  Received(const std::vector<std::string>& inputs, const TellSteps& tell)
      : all_(input_bytes(inputs)), tell_(tell) {}

  void add(std::size_t bytes) {
    done_ += bytes;
    if (tell_) tell_(done_, all_);
  }

 private:
  std::size_t done_ = 0, all_;
  const TellSteps& tell_;
};

// Makes positions of one input's bytes.
class Feed {
 public:
  explicit Feed(const AircraftOptions& options) : options_(options) {}

  void take(std::span<const std::uint8_t> bytes) {
    arrival_utime_us_ = clock_utime_us();
    if (options_.format == "beast") {
      for (const BeastFrames::Frame& frame : frames_.take(bytes)) {
        take_frame(frame, arrival_utime_us_);
      }
      return;
    }
    if (text_.empty()) text_utime_us_ = arrival_utime_us_;
    text_.append(bytes.begin(), bytes.end());
    if (options_.format == "sbs") take_lines();
  }
  // Judges the clock of a live receiver by what has come so far.
  void check_receiver() const {
    if (!delay_.least_us() || options_.clock_is_right) return;
    const std::string trouble = receiver_clock_trouble(*delay_.least_us());
    if (!trouble.empty()) throw std::runtime_error(trouble);
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
    has_messages = true;
    delay_.note(snapshot.utime_us, text_utime_us_);
    positions.insert(positions.end(), snapshot.positions.begin(), snapshot.positions.end());
    barometric_only += snapshot.barometric_only;
  }

  std::vector<AircraftPosition> positions;
  int barometric_only = 0;
  bool has_messages = false;

 private:
  // Times count from the first frame, whose own time is known only at the end.
  void take_frame(const BeastFrames::Frame& frame, std::int64_t arrival_utime_us) {
    has_messages = true;
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
      const std::string line = text_.substr(begin, end - begin);
      has_messages = has_messages || line.starts_with("MSG,");
      if (auto position = sbs_position(line)) {
        delay_.note(position->utime_us, arrival_utime_us_);
        positions.push_back(std::move(*position));
      }
    }
    text_.erase(0, begin);
  }

  const AircraftOptions& options_;
  TickClock ticks_;
  BeastFrames frames_;
  AdsbDecoder decoder_;
  ReceiverDelay delay_;
  std::string text_;
  std::int64_t arrival_utime_us_ = 0,
               text_utime_us_ = 0;  // of the newest bytes, of the text's first
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

  // Reads for so long. False: the other end has closed the connection before.
  bool read(double duration_s, Feed& feed, Received& received) const {
    using Clock = std::chrono::steady_clock;
    const auto end = Clock::now() + std::chrono::duration<double>(duration_s);
    std::vector<std::uint8_t> buffer(65536);
    while (Clock::now() < end) {
      pollfd waited{fd_, POLLIN, 0};
      constexpr int kLook_ms = 200;
      received.add(0);
      if (::poll(&waited, 1, kLook_ms) <= 0) continue;
      const ssize_t count = ::read(fd_, buffer.data(), buffer.size());
      if (count <= 0) return false;
      feed.take({buffer.data(), static_cast<std::size_t>(count)});
      received.add(static_cast<std::size_t>(count));
    }
    return true;
  }

 private:
  int fd_ = -1;
};

void read_file(const std::string& path, Feed& feed, Received& received) {
  std::ifstream file(path, std::ios::binary);
  file.peek();
  if (!file.is_open() || file.bad()) throw std::runtime_error(path + ": cannot be read");
  std::vector<char> buffer(65536);
  while (file.read(buffer.data(), static_cast<std::streamsize>(buffer.size())) ||
         file.gcount() > 0) {
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(buffer.data());
    feed.take({bytes, static_cast<std::size_t>(file.gcount())});
    received.add(static_cast<std::size_t>(file.gcount()));
  }
  if (file.bad()) throw std::runtime_error(path + ": cannot be read to its end");
}

// Returns what is missing of it, as a sentence; empty: nothing.
std::string read_input(const std::string& input, const AircraftOptions& options, Feed& feed,
                       Received& received) {
  std::string trouble;
  const std::size_t colon = input.rfind(':');
  const bool is_file = std::filesystem::exists(input) || colon == std::string::npos;
  if (is_file) {
    read_file(input, feed, received);
  } else {
    if (!options.clock_is_right) check_clock();
    const Connection receiver(input.substr(0, colon), input.substr(colon + 1), input);
    if (!receiver.read(options.duration_s, feed, received)) {
      trouble = input + ": the receiver has closed the connection before --duration was over";
    }
  }
  try {
    feed.end();
    if (!is_file && options.format != "beast") feed.check_receiver();
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(input + ": " + error.what());
  }
  return trouble;
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

std::string receiver_clock_trouble(std::int64_t least_delay_us) {
  // An aircraft.json is written once a second. A longer delay would be common to all passes, but
  // the adjustment assumes one of a second, independent for each pass.
  constexpr double kLate_s = 2.0;
  constexpr double kAhead_s = 2.0 * kClock_s;
  const double late_s = 1e-6 * static_cast<double>(least_delay_us);
  if (late_s > -kAhead_s && late_s < kLate_s) return {};
  return printed(
      "the receiver's time stamps are at least %.1f s %s by this computer's clock: the "
      "receiver's clock is not synchronised, or its messages are delayed on their way",
      std::abs(late_s), late_s > 0.0 ? "old" : "ahead");
}

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

CommandReport write_aircraft(const AircraftOptions& options, const TellSteps& tell) {
  check(options);
  CommandReport report;
  std::vector<AircraftPosition> positions;
  int barometric_only = 0;
  Received received(options.inputs, tell);
  for (const std::string& input : options.inputs) {
    Feed feed(options);
    const std::string trouble = read_input(input, options, feed, received);
    if (!trouble.empty()) report.faults.push_back(trouble);
    if (feed.positions.empty()) {
      report.faults.push_back(input + ": " + (feed.has_messages ? kNoPosition : kNoMessage));
    }
    positions.insert(positions.end(), feed.positions.begin(), feed.positions.end());
    barometric_only += feed.barometric_only;
  }
  if (barometric_only > 0) {
    report.notes.push_back(std::to_string(barometric_only) +
                           " positions have a barometric height alone and are left out: it is "
                           "wrong by tens to hundreds of metres");
  }
  if (positions.empty()) {
    throw std::runtime_error(report.faults.front() +
                             (report.notes.empty() ? "" : ": " + report.notes.front()));
  }
  const std::string rows = reference_rows(std::move(positions), options.sd_m);
  const auto count = std::ranges::count(rows, '\n') - 1;  // without the heading
  if (count == 0) {
    throw std::runtime_error(
        "--input: each aircraft was seen at one time only: give two inputs or more, some seconds "
        "apart");
  }
  AtomicFile file(options.output);
  file.stream() << rows;
  file.commit();
  report.summary.push_back(options.output + ": " + std::to_string(count) + " positions");
  return report;
}

}  // namespace ols::calibration
