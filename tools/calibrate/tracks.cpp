#include "tools/calibrate/tracks.h"

#include <filesystem>
#include <stdexcept>
#include <utility>

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

void note(std::vector<std::string>& remarks, std::size_t count, const char* what) {
  if (count > 0) remarks.push_back(std::to_string(count) + " sightings " + what);
}

std::vector<std::string> remarks_of(const SightingLog& log, const Instants& instants) {
  std::vector<std::string> remarks = log.damage;
  note(remarks, log.unusable, "cannot be read: left out");
  note(remarks, log.of_others, "are of stations that --station does not name");
  note(remarks, log.unsynchronised, "are of a station that did not know the time: left out");
  note(remarks, log.disbelieved, "were hardly believed by the tracker: left out");
  note(remarks, instants.lonely, "have no other on the other side of a whole second: left out");
  note(remarks, 2 * instants.unsure,
       "are of a unit that turned round, or of which nobody knows from where it came: left out");
  return remarks;
}

}  // namespace

TracksReport write_tracks(const TracksOptions& options) {
  check(options);
  const Case stations = read_stations(options.stations);
  const Problem& problem = stations.problem;
  const SightingLog log = read_sightings(options.log, problem.names, problem.stations,
                                         Progress("ols-calibrate", "bytes of the recordings"));
  const Instants instants = instants_of(log.sightings, problem.stations);
  const FollowedObservations found =
      followed(instants.instants, problem.stations, problem.names, references_in(options.aircraft),
               Progress("ols-calibrate", "tracks of stations"));
  std::vector<std::string> remarks = remarks_of(log, instants);
  remarks.insert(remarks.end(), found.remarks.begin(), found.remarks.end());
  if (found.observations.empty()) {
    std::string why =
        "--recording: nothing that two stations, or a station and --aircraft, have "
        "seen at the same instants";
    for (const std::string& remark : remarks) why += "; " + remark;
    throw std::runtime_error(why);
  }
  AtomicFile file(options.output);
  for (const Observation& one : found.observations) {
    file.stream() << observation_lines({one}, problem.names[one.station]);
  }
  file.commit();
  return {std::move(remarks), !log.damage.empty()};
}

}  // namespace ols::calibration
