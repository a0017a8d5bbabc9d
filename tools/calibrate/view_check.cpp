// `ols-calibrate check`: views of the stored panorama, looked at again.
#include <stdexcept>

#include "base/process/clocks.h"
#include "tools/calibrate/command_report.h"
#include "tools/calibrate/procedure_stages.h"
#include "tools/calibrate/view_stage.h"

namespace ols::calibration {
namespace {

namespace fs = std::filesystem;

// The last message of a check: what it found, or that it found nothing out.
void announce(ProcedureRunner& runner, bool aborted, const ViewStage& looked) {
  using M = ols_msg::procedure_t;
  if (aborted) return runner.announce(M::STATE_ABORTED, "aborted: no result");
  runner.announce(looked.is_conclusive() ? M::STATE_ACCEPTED : M::STATE_FAILED, looked.verdict());
}

fs::path panorama_of(const ProcedureOptions& options, const CalibrationStore& store) {
  if (!options.panorama.empty()) {
    if (store.has(options.panorama)) return store.folder() / options.panorama;
    throw std::invalid_argument("--panorama: " + store.folder().string() + " has no '" +
                                options.panorama + "'");
  }
  const auto current = store.current();
  if (!current) throw std::invalid_argument("no calibration is in use: there is nothing to check");
  return store.folder() / *current;
}

}  // namespace

int run_check(const ProcedureOptions& options, const StationFiles& station,
              CalibrationStore& store) {
  const fs::path calibration = panorama_of(options, store);
  Person person(options.script);
  // Otherwise two procedures would drive one unit.
  for (const fs::path& dead : store.lock()) {
    person.tell("! a procedure was interrupted; its observations are kept in " + dead.string());
  }
  auto views = views_of(calibration);
  LcmBus bus(options.lcm_url.empty() ? station.settings.lcm_url : options.lcm_url,
             StationLink::open_trust(options.trust));
  StationLink link(bus, station.settings.id);
  check_station(link, station, options, person);
  const StationModel model = with_instrument(station.settings.station.geometry, station.instrument);
  auto stage =
      std::make_unique<ViewStage>(std::move(views), model, station.instrument.angle_sd_rad);
  const ViewStage* looked = stage.get();
  std::vector<std::unique_ptr<Stage>> stages;
  stages.push_back(std::move(stage));
  FieldProcedure procedure(std::move(stages), {});
  ProcedureRunner runner(options.name, link, person, nullptr);
  if (!options.overcast) {
    const SunKeepOut sun(prior_of(station.settings, station.instrument, station.config).model,
                         clock_utime_us);
    runner.keep_away([sun](const PanTilt& at) { return sun.hindrance(at); });
  }
  bool complete = false;
  try {
    runner.run(procedure, [&] {
      complete = true;
      procedure.abort();  // there is nothing to adjust or to decide
      return AdjustedResult{};
    });
  } catch (const std::exception& error) {
    // Whoever has stopped it releases it.
    if (dynamic_cast<const StationStopped*>(&error) == nullptr) link.release();
    runner.announce(ols_msg::procedure_t::STATE_FAILED, error.what());
    throw;
  }
  link.release();
  person.tell(complete ? looked->verdict() : "Aborted: no result about the tripod");
  announce(runner, !complete, *looked);
  return complete && looked->stands() ? 0 : kExitLookAtIt;
}

}  // namespace ols::calibration
