// Plans slews in rounds. One round passes through all stations. Each bearing triggers only the
// slews of the next few stations: the slews of a thousand stations at once would delay the
// processing of bearings. Pure.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "central/admission/station_registry.h"
#include "central/cues/cue_registry.h"
#include "central/fusion/bearing_lines.h"
#include "central/fusion/slew_planner.h"
#include "central/handover/handover_policy.h"

namespace ols::fusion {

class SlewSchedule {
 public:
  // give_up_s: a round that has not ended after this time is abandoned. staring: stations that are
  // never led.
  SlewSchedule(const SlewConfig& config, double give_up_s, std::vector<std::string> staring = {})
      : config_(config), give_up_s_(give_up_s), staring_(std::move(staring)), planner_(config) {}

  // The slews that are due with one bearing or cue, at the time now_us.
  std::vector<Slew> plan(std::int64_t now_us, const StationRegistry& stations,
                         const BearingLines& lines, const std::vector<Track>& tracks,
                         const CueRegistry& cues, const HandoverPolicy& handover);
  // Whether a round is unfinished; then its next part is due at once.
  bool is_in_round() const { return next_.has_value(); }
  void forget(const std::string& station) {
    planner_.forget(station);
    forget_tracklets(station);
  }
  // Forgets a station's tracklets, because the station has restarted their numbering.
  void forget_tracklets(const std::string& station) {
    std::erase_if(tracklets_, [&](const auto& known) { return known.first.first == station; });
  }
  void clear() { *this = SlewSchedule(config_, give_up_s_, staring_); }

 private:
  void begin(std::int64_t now_us, const StationRegistry& stations, const BearingLines& lines,
             const std::vector<Track>& tracks, const CueRegistry& cues,
             const HandoverPolicy& handover);
  SlewStation station_of(const std::string& name, const KnownStation& station,
                         std::int64_t now_us) const;
  void find_lent_stations(std::int64_t now_us, const StationRegistry& stations);
  void find_what_is_let_go(const std::vector<Track>& tracks, const HandoverPolicy& handover);
  // A station, and its own id of the tracklet.
  using TrackletName = std::pair<std::string, std::int64_t>;
  // Stations search along the line of one object for at most this long in total.
  static constexpr double kSearched_s = 10.0;
  struct Tracklet {
    std::int64_t noted_us = 0, seen_us = 0;
    double searched_s = 0.0;  // how long its line has been searched
    // The target to which it last belonged, if that target leads stations; otherwise 0.
    std::int64_t target = 0;
    double stays_s = kSearched_s;  // a tracker stays with the object this long after noted_us
  };
  const BearingMeasurement* line_of(const std::string& station,
                                    const std::vector<const BearingMeasurement*>& own);
  // How many turns of a search (5 s each) this object's line has had. nullopt: the line must not be
  // searched now.
  std::optional<int> turn_of(const TrackletName& tracklet);
  // The sort key of a line of sight; the line with the smallest key is searched. Its fields, in
  // order: false if an operator designated the object; how many turns of a search its line has had;
  // whether the station that sees it may be led; whether this station's line is a new one, not the
  // one of the previous round; the station.
  using LineKey = std::tuple<bool, int, bool, bool, std::string>;
  struct SearchedLine {
    BearingMeasurement newest;
    CueRay ray;
  };
  void keep_line(std::int64_t now_us, const BearingLines& lines,
                 std::map<LineKey, SearchedLine>& open) const;
  void cue(std::int64_t now_us, const BearingLines& lines,
           const std::vector<SlewStation>& stations);
  void note_search(double since_s);
  void note_targets(const std::vector<Track>& tracks);
  void note_acquired(const BearingMeasurement& line);
  void expect_range(const std::vector<SlewStation>& stations);
  void share_out(const std::vector<SlewStation>& stations);
  void narrow_by_cue();

  SlewConfig config_;
  double give_up_s_;
  std::vector<std::string> staring_;
  SlewPlanner planner_;
  SlewRound round_;
  // Stations whose trackers are to let their objects go: the track_id that each tracker follows.
  std::map<std::string, std::int64_t> let_go_;
  // Stations that see one target but are led to another target or along a line: the target that
  // each of them sees.
  std::map<std::string, std::int64_t> lent_;
  std::optional<std::pair<LineKey, SearchedLine>> line_;  // the line along which stations search
  // The objects that stations see, with and without a position.
  std::map<TrackletName, Tracklet> tracklets_;
  std::optional<std::int64_t> begun_us_;  // start of the last round
  std::optional<std::string> next_;  // the next station of the round; nullopt if the round is over
};

}  // namespace ols::fusion
