// The folder that contains all events. Measures its size and the free space on the disk, and
// chooses the event to remove when space is needed.
//
// Any program on the bus can request recordings. New recordings must therefore not displace old
// ones freely. In any period of `protect_s`, at most one event is removed. It must be older than
// `protect_s`. Among the labels that have such an event, the one whose events occupy most space is
// chosen, and its oldest event is removed.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>

namespace ols::recorder {

// The first part of an event's name, for example "20260301T120000.250Z"; alphabetical order is
// order of time.
std::string utc_name(std::int64_t utime_us);

// Thrown if quota or disk have no space for the data.
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

  // Creates the folder if it is missing, and measures the events and the free space. Throws
  // std::system_error if the path is not a folder, or if the folder cannot be written.
  void survey();
  // As survey(), and also writes a test file. For a disk that has failed before.
  void try_writing();

  // A name for a new event that is not in use yet.
  std::string free_name(std::int64_t utime_us, const std::string& label) const;
  // Makes space for `bytes` more. If they do not fit into the quota, removes one event, chosen as
  // described above, but only if its removal makes enough space. Never removes an event in `open`,
  // because its frames are still arriving. Throws DiskFull if the bytes do not fit into the quota,
  // or if they would use the reserve of the disk. The age of an event is computed from
  // `now_utime_us` (UTC).
  void make_room(double bytes, const Names& open, std::int64_t now_utime_us);
  // The free space in the quota, including the space of the event that may be removed.
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
  Events events_;  // size [byte] by folder name, with the folders of incomplete events
  double free_bytes_ = 0.0;
  std::uint64_t removed_ = 0;
};

}  // namespace ols::recorder
