// The folder of all events: how much there is, how much room the disk has, and which is the oldest.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <stdexcept>
#include <string>

namespace ols {

// "20260301T120000.250Z": sorts by time.
std::string utc_name(std::int64_t utime_us);

// The disk has no room for what is to be written.
class DiskFull : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

class EventStore {
 public:
  EventStore(const std::string& folder, double quota_bytes, double reserve_bytes);

  // Looks at the disk: makes the folder where it is missing, and takes stock of events and room.
  // Throws std::system_error when the folder is none, or cannot be written.
  void survey();
  // The same, and really writes something: for a disk that has failed before.
  void try_writing();

  // A name that is still free.
  std::string free_name(std::int64_t utime_us, const std::string& label) const;
  // Removes the oldest events until `bytes` more fit into the quota, never those of `open`, whose
  // frames are still coming. Throws DiskFull when they do not fit all the same, or the disk's
  // reserve would be touched.
  void make_room(double bytes, const std::set<std::string>& open);
  void add(const std::string& name, double bytes) { events_[name] += bytes; }
  void finished(const std::string& name);

  bool full() const { return free_bytes_ < reserve_bytes_; }
  std::string full_text() const;  // "disk full (0.2 GB free)"
  double free_bytes() const { return free_bytes_; }
  double bytes() const;
  std::size_t events() const { return events_.size(); }
  std::uint64_t removed() const { return removed_; }

 private:
  void measure_room();
  bool remove_oldest(const std::set<std::string>& open);

  std::string folder_;
  double quota_bytes_, reserve_bytes_;
  std::map<std::string, double> events_;  // by folder name; partial ones too
  double free_bytes_ = 0.0;
  std::uint64_t removed_ = 0;
};

}  // namespace ols
