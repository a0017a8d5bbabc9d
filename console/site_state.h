// The console's model of the site: stations, targets with their trails, bearing-only tracks
// ("lines"), the fusion, areas, incidents and events. The number of each is limited; silent ones
// are marked as stale. Pure.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <string>
#include <vector>

#include "base/journal/alarm_changes.h"
#include "console/entity_table.h"
#include "console/event_list.h"
#include "console/received.h"

namespace ols::console {

// The time now. `monotonic_s`: for ages and timeouts. `utime_us`: this host's UTC, to be shown to
// people.
struct Now {
  double monotonic_s = 0.0;
  std::int64_t utime_us = 0;
  int minute_of_day = 0;  // in this host's time zone
};

class SiteState {
 public:
  void receive(const ReceivedStation& station, const Now& now);
  void receive(const ReceivedTarget& target, const Now& now);
  void receive(const ReceivedFusion& fusion, const Now& now);
  // An occlusion is ignored unless its station has sent a status.
  void receive(const ReceivedOcclusion& occlusion, const Now& now);
  // The newest bearing of a station; ignored unless the station has sent a status.
  void receive_bearing(const std::string& station, const Json& bearing);
  // Takes the current alarms of the console itself.
  void receive_own(const std::vector<Alarm>& alarms, const Now& now);
  // Sets the state of a station's guided procedure.
  void set_procedure(const std::string& station, const Json& procedure);
  // Sets the areas that are watched, as an array of objects, each with its "name".
  void set_areas(const Json& areas);
  // Sets the incident with this number; null: removes it.
  void set_incident(std::uint64_t number, const Json& incident);
  // Call often: marks what has become stale, and removes what has been silent for long.
  void look(const Now& now);

  std::uint64_t note(Event event) { return events_.add(std::move(event), revision_); }
  void conclude(std::uint64_t event, const Outcome& refusal) {
    events_.conclude(event, refusal, revision_);
  }
  // Notes that somebody handles an alarm. False: there is no such alarm.
  bool acknowledge(std::uint64_t event, const std::string& who) {
    return events_.acknowledge(event, who, revision_);
  }
  // Sets the operators' name for a target, for as long as the target is known. False: there is no
  // such target.
  bool name_target(const std::string& id, const std::string& name);
  // Sets who controls a station: {"by": NAME, "viewer": N}; null: nobody.
  void set_holder(const std::string& station, const Json& holder);

  Revision revision() const { return revision_; }
  // The whole state, for GET /api/state and for a new viewer: stations, targets (with trails),
  // lines, fusion, areas, incidents, events.
  Json snapshot() const;
  // The changes since a revision: only the fields that have changed, and in "gone" the ids that
  // were removed. If the revision is too old to know the changes, a snapshot.
  Json changes(Revision since) const;
  Json events_since(Revision since) const { return events_.since(since); }
  // Whether this is the boot id of the fusion whose targets are shown.
  bool counts_fusion(std::int64_t boot_id) const { return boot_id == fusion_boot_; }
  // How many stations, silent stations and targets there are, and whether there is a fusion.
  Json counts() const;
  std::vector<std::string> station_ids() const { return stations_.ids(); }
  bool knows(const std::string& station) const { return fields_of(station) != nullptr; }
  // The fields of a station's last status; null: the station is unknown.
  const Json* fields_of(const std::string& station) const { return stations_.find(station); }
  std::uint64_t refused() const { return refused_; }  // how often there was no room for a new name

  static constexpr double kStationStale_s = 2.5;  // five status intervals
  static constexpr double kTargetStale_s = 1.5;
  static constexpr double kFusionGone_s = 1.5;
  static constexpr std::size_t kMostAlarms = 32;  // limit per station
  static constexpr std::size_t kMostStations = 200, kMostTargets = 500, kMostTrailPoints = 600;
  static constexpr std::size_t kMostAreas = 50, kMostIncidents = 200;

 private:
  struct Kept {  // of a station, or of the fusion if the name is empty
    AlarmChanges alarms;
    std::string last_error;
    std::int64_t last_error_utime_us = -1;
  };
  struct Trail {
    // Each point is [longitude_deg, latitude_deg, height_m]. If the land hid the target from
    // stations, a list of their ids is added, with "*" at its end if no other station saw the
    // target. null: a gap in which the target was not received.
    std::deque<Json> points;
    double added_s = -1e9;
  };

  struct Occluded {  // of a station
    std::string target;
    std::int64_t since_us = 0, back_us = 0;
    double until_s = 0.0;  // monotonic; the message is valid until then
  };

  // From which stations the land hides the target: {from: [{id, since_us, back_us}], all}; `all`:
  // whether no other station sees it now. null: it is not hidden.
  Json hidden(const std::string& target, double now_s) const;
  void note_alarm(const std::string& station, const Alarm& alarm, std::int64_t utime_us) {
    note({utime_us, "alarm", station, "", alarm.text, "", alarm});
  }
  void note_alarms(AlarmChanges& known, const std::string& station,
                   const std::vector<Alarm>& alarms, std::int64_t utime_us);
  void note_error(const std::string& station, const std::string& error, std::int64_t error_utime_us,
                  std::int64_t utime_us);
  void add_to_trail(const ReceivedTarget& target, double now_s);
  // Whether messages with this boot id are from the fusion that is shown. When that fusion is
  // silent for kFusionGone_s, the next one that sends is shown.
  bool is_of_fusion(std::int64_t boot_id, const Now& now);

  Revision revision_ = 0;
  EntityTable stations_{kMostStations};
  EntityTable targets_{kMostTargets};
  EntityTable lines_{kMostStations};
  EntityTable fusion_{1};
  EntityTable areas_{kMostAreas};
  EntityTable incidents_{kMostIncidents};
  EventList events_;
  std::map<std::string, Kept> kept_;
  AlarmChanges own_;
  std::map<std::string, Trail> trails_;
  std::map<std::string, Occluded> occluded_;  // by station
  std::int64_t fusion_boot_ = 0;
  double fusion_heard_s_ = -1e9;
  std::uint64_t refused_ = 0;
};

}  // namespace ols::console
