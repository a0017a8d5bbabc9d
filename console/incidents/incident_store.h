// Keeps areas and incidents in a folder, over a restart:
//
//   areas.json    {"version": 1, "areas": [...]}
//   NUMBER.json   {"version": 1, "incident": {...}}: an incident, with its track
//   NUMBER.jpg    its picture
//
// A file that cannot be read is named in an alarm and left as it is; what it would have said is
// missing meanwhile, and nothing is written over it.
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
  // The folder is made when it is first needed.
  explicit IncidentStore(std::string folder) : folder_(std::move(folder)) {}

  KeptIncidents read();

  // Writes what is new.
  void keep(const IncidentBook& book, const IncidentBook::News& news);

  void write(const std::vector<Area>& areas);
  void write(const Incident& incident);
  void write_picture(std::uint64_t number, const std::string& jpeg);
  void remove(std::uint64_t number);

  // What could not be read at the start, or written last.
  std::vector<Alarm> alarms() const;

 private:
  bool tried(const std::string& file, const std::function<void()>& read_it);
  void read_incident(std::uint64_t number, KeptIncidents& kept);
  void write_file(const std::string& name, const std::string& content);

  std::string folder_;
  std::vector<Alarm> unread_;
  Alarm unsaved_;
};

}  // namespace ols::console
