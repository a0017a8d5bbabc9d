#include "tools/calibrate/procedure_end.h"

#include <stdexcept>

#include "base/process/clocks.h"
#include "tools/calibrate/command_report.h"

namespace ols::calibration {
namespace {

namespace fs = std::filesystem;

// Sets the session aside; returns where it is, and how to go on with it.
std::string set_aside(const ProcedureSession& session, CalibrationStore& store) {
  const fs::path kept = store.interrupt(session.folder());
  const bool can_go_on = fs::exists(kept / kSessionFile);
  return kept.string() + (can_go_on ? "; to resume it: the same command with --resume" : "");
}

// The running station says which calibration it works with.
void tell_when_in_use(StationLink& link, std::int64_t id, Person& person) {
  constexpr double kPatience_s = 15.0, kLook_s = 2.0;
  const double end_s = clock_monotonic_s() + kPatience_s;
  std::string says = "it says nothing";
  while (clock_monotonic_s() < end_s) {
    const auto status = link.status(kLook_s);
    if (!status) continue;
    if (status->calibration_id == id &&
        status->calibration_state == ols_msg::station_status_t::CALIBRATION_IN_USE) {
      return person.tell("The station works with it.");
    }
    for (const Alarm& alarm : alarms_of(*status)) {
      if (alarm.text.starts_with("calibration: ")) says = alarm.text;
    }
  }
  person.tell("! Accepted, not yet in use: the station takes it up by itself when it is idle (" +
              says + ").");
}

// A station reads the folder of its configuration, whatever is in use here.
void tell_whether_in_use(const StationFiles& station, const CalibrationStore& store,
                         StationLink& link, std::int64_t id, Person& person) {
  const fs::path current = fs::absolute(store.folder() / "current").lexically_normal();
  const fs::path read = station.settings.calibration_folder;
  const bool reads_it =
      !read.empty() && (read.lexically_normal() == current ||
                        fs::weakly_canonical(read) == fs::weakly_canonical(current));
  if (reads_it) return tell_when_in_use(link, id, person);
  person.tell("! The station does not read it: " + station.config + " has " +
              (read.empty() ? "no [calibration] folder"
                            : "[calibration] folder = \"" + read.string() + "\"") +
              ". Set it to \"" + current.string() +
              "\" and restart the station; later ones it takes up by itself.");
}

}  // namespace

void fail(const std::exception& error, const ProcedureSession& session, CalibrationStore& store) {
  const std::string what = error.what();
  if (!fs::exists(session.folder())) {
    throw std::runtime_error(what + "; the new calibration is stored in " +
                             store.folder().string() +
                             ", `ols-calibrate history` tells which one is in use");
  }
  throw std::runtime_error(what +
                           "; the old calibration stays in use, the observations are kept in " +
                           set_aside(session, store));
}

int finish(const Procedure& procedure, Outcome outcome, const StationFiles& station,
           StationLink& link, CalibrationStore& store, Person& person) {
  const fs::path& running = procedure.session->folder();
  if (outcome == Outcome::kAborted) {
    person.tell("Aborted. The old calibration stays in use; the observations are kept in " +
                set_aside(*procedure.session, store));
    return kExitLookAtIt;
  }
  if (!procedure.adjusted) {
    const fs::path kept = store.interrupt(running);
    person.tell("There is no result; the observations are kept in " + kept.string());
    return kExitLookAtIt;
  }
  procedure.session->take_result();
  const std::int64_t number = procedure.adjusted->results.front().calibration_id;
  const std::string id = std::to_string(number);
  const fs::path kept = store.keep(running, id);
  HistoryLine line{clock_utime_us(), "accepted", id, procedure.options.name, ""};
  if (procedure.options.name == "sweep") {
    person.tell("The panorama is kept: `ols-calibrate check --panorama " + id +
                "` compares with it.");
  }
  if (outcome == Outcome::kAccepted && !procedure.adjusted->found.headings_known) {
    line.event = "instrument";
    store.use_instrument(id, line);
    person.tell("Accepted: " + kept.string() + "; the next `field` begins with it.");
    return 0;
  }
  if (outcome == Outcome::kAccepted) {
    store.use(id, line);
    person.tell("Accepted: " + kept.string());
    tell_whether_in_use(station, store, link, number, person);
    return 0;
  }
  line.event = "kept";
  line.previous = store.current().value_or("");
  store.note(line);
  person.tell("The old calibration stays in use; this one is in " + kept.string());
  return kExitLookAtIt;
}

}  // namespace ols::calibration
