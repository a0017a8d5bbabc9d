#include "tools/calibrate/tracks.h"

#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "base/files/atomic_file.h"
#include "base/files/output_check.h"
#include "base/process/progress.h"
#include "tools/calibrate/observation_writer.h"

namespace ols::calibration {
namespace {

void check(const TracksOptions& options) {
  std::vector<NamedFile> inputs{{"--aircraft", options.aircraft}};
  for (const std::string& path : options.stations.stations) inputs.push_back({"--station", path});
  for (const std::string& path : options.log.recordings) inputs.push_back({"--recording", path});
  check_outputs(inputs, {{"--output", options.output}});
  if (std::filesystem::exists(options.output)) {
    throw std::runtime_error("--output: " + options.output + " exists: it is not overwritten");
  }
}

void note(std::vector<std::string>& said, std::size_t count, const char* what) {
  if (count > 0) said.push_back(std::to_string(count) + " sightings " + what);
}

// Notes are normal in every flight: the tracker's doubts, a unit that turns round. Faults are not:
// a station that contributes nothing, a wrong clock, a damaged recording.
CommandReport report_on(const SightingLog& log, const Instants& instants,
                        const FollowedObservations& found, const std::vector<std::string>& names) {
  CommandReport report{found.remarks, {}, log.damage};
  note(report.notes, log.of_others, "are of stations that --station does not name");
  note(report.notes, log.disbelieved, "were hardly believed by the tracker: left out");
  note(report.notes, instants.lonely,
       "have no other on the other side of a whole second: left out");
  note(report.notes, 2 * instants.unsure,
       "are of a unit that turned round, or of which nobody knows from where it came: left out");
  note(report.faults, log.unusable, "cannot be read: left out");
  note(report.faults, log.unsynchronised, "are of a station that did not know the time: left out");
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (std::ranges::count(found.observations, i, &Observation::station) > 0) continue;
    report.faults.push_back("station '" + names[i] + "': nothing that it has followed can be used");
  }
  return report;
}

std::runtime_error nothing_found(const CommandReport& report) {
  std::string why =
      "--recording: nothing that two stations, or a station and --aircraft, have "
      "seen at the same instants";
  for (const auto* lines : {&report.faults, &report.notes, &report.summary}) {
    for (const std::string& line : *lines) why += "; " + line;
  }
  return std::runtime_error(why);
}

}  // namespace

CommandReport write_tracks(const TracksOptions& options) {
  check(options);
  const Case stations = read_stations(options.stations);
  const Problem& problem = stations.problem;
  const SightingLog log = read_sightings(options.log, problem.names, problem.stations,
                                         Progress("ols-calibrate", "bytes of the recordings"));
  const Instants instants = instants_of(log.sightings, problem.stations);
  const FollowedObservations found =
      followed(instants.instants, problem.stations, problem.names, references_in(options.aircraft),
               Progress("ols-calibrate", "tracks of stations"));
  CommandReport report = report_on(log, instants, found, problem.names);
  if (found.observations.empty()) throw nothing_found(report);
  AtomicFile file(options.output);
  for (const Observation& one : found.observations) {
    file.stream() << observation_lines({one}, problem.names[one.station]);
  }
  file.commit();
  return report;
}

}  // namespace ols::calibration
