// Stores areas and incidents in a folder, so that they survive a restart:
//
//   areas.json    {"version": 1, "areas": [...]}
//   NUMBER.json   {"version": 1, "incident": {...}}: an incident, with its track
//   NUMBER.jpg    its picture
//
// If a file cannot be read, an alarm names it. The file is never changed or overwritten, and its
// contents are missing until a later start can read it. If the folder cannot be listed, nothing is
// written into it, because the numbers of its files are unknown and might be used again.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "conditions/alarm.h"
#include "console/incidents/incident_book.h"

namespace ols::console {

class IncidentStore {
 public:
  // The folder is created when it is first needed.
  explicit IncidentStore(std::string folder) : folder_(std::move(folder)) {}

  KeptIncidents read();

  // Writes what is new, and tries again each second to write what could not be written. Call often.
  // `now_s`: monotonic.
  void keep(const IncidentBook& book, const IncidentBook::News& news, double now_s);

  // Alarms about what could not be read at the start, or could not be written yet.
  std::vector<Alarm> alarms() const;

  static constexpr double kAgain_s = 1.0;

 private:
  bool tried(const std::string& file, const std::function<void()>& read_it);
  void read_incident(std::uint64_t number, KeptIncidents& kept);
  bool is_written(const std::function<void()>& write_it);
  void write(const std::vector<Area>& areas) const;
  void write(const Incident& incident) const;
  void write_file(const std::string& name, const std::string& content) const;
  void remove(std::uint64_t number) const;

  std::string folder_;
  bool is_listed_ = true;
  std::vector<Alarm> unread_;
  IncidentBook::News unsaved_;
  std::string why_unsaved_;  // empty: everything is written
  double again_s_ = 0.0;
};

}  // namespace ols::console
