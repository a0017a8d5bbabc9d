// The folder of all events: its size, the free space on the disk, and the choice of the event that
// may be removed.
//
// Any program on the bus can request recordings, so new recordings must not displace old ones
// freely. In each interval of `protect_s` at most one event is removed, and only one older than
// `protect_s`: the oldest one with the label that takes most space.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>

namespace ols::recorder {

// For example "20260301T120000.250Z"; such names sort by time.
std::string utc_name(std::int64_t utime_us);

// Thrown if the disk has no space for the data.
class DiskFull : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

class EventStore {
 public:
  struct Config {
    std::string folder;
    double quota_bytes = 0.0, reserve_bytes = 0.0;
    double protect_s = 0.0;
  };
  using Names = std::set<std::string>;

  explicit EventStore(Config config) : config_(std::move(config)) {}

  // Checks the disk: creates the folder if it is missing, and measures events and free space.
  // Throws std::system_error if it is not a folder, or cannot be written.
  void survey();
  // As survey(), for a disk that has failed before: also writes a test file.
  void try_writing();

  // A name that is not in use.
  std::string free_name(std::int64_t utime_us, const std::string& label) const;
  // If `bytes` more do not fit into the quota, removes an event that may be removed. It never
  // removes one in `open`, because its frames are still arriving. Throws DiskFull if the bytes
  // still do not fit, or would use the reserve of the disk. Ages are by UTC.
  void make_room(double bytes, const Names& open, std::int64_t now_utime_us);
  // The free space in the quota, including that of events that may be removed.
  double room_bytes(const Names& open, std::int64_t now_utime_us) const;
  void add(const std::string& name, double bytes) { events_[name] += bytes; }
  void finished(const std::string& name);

  bool full() const { return free_bytes_ < config_.reserve_bytes; }
  std::string full_text() const;  // "disk full (0.2 GB free)"
  double free_bytes() const { return free_bytes_; }
  double bytes() const;
  std::size_t events() const { return events_.size(); }
  std::uint64_t removed() const { return removed_; }

 private:
  using Events = std::map<std::string, double>;

  void measure_room();
  void remember_removal() const;
  Events::const_iterator removable(const Names& open, std::int64_t now_utime_us) const;

  Config config_;
  Events events_;  // bytes by folder name, including partial folders
  double free_bytes_ = 0.0;
  std::uint64_t removed_ = 0;
};

}  // namespace ols::recorder
