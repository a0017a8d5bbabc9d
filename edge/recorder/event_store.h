// The folder of all events: how much there is, how much room the disk has, and which may go.
//
// Anybody on the bus may ask for recordings, so they must not push out what was there before: once
// in `protect_s` one event makes room for new ones, and only one that is older than that: the
// oldest of the label that takes most room.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>

namespace ols::recorder {

// "20260301T120000.250Z": sorts by time.
std::string utc_name(std::int64_t utime_us);

// The disk has no room for what is to be written.
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

  // Looks at the disk: makes the folder where it is missing, and takes stock of events and room.
  // Throws std::system_error when the folder is none, or cannot be written.
  void survey();
  // The same, and really writes something: for a disk that has failed before.
  void try_writing();

  // A name that is still free.
  std::string free_name(std::int64_t utime_us, const std::string& label) const;
  // Removes what may go when `bytes` more do not fit into the quota, never what is of `open`, whose
  // frames are still coming. Throws DiskFull when they do not fit all the same, or the disk's
  // reserve would be touched. UTC decides what is how old.
  void make_room(double bytes, const Names& open, std::int64_t now_utime_us);
  // What fits into the quota, with what may go.
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
  Events events_;  // by folder name; partial ones too
  double free_bytes_ = 0.0;
  std::uint64_t removed_ = 0;
};

}  // namespace ols::recorder
