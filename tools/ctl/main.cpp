// ols-ctl: the operator's commands on the command line.
#include <poll.h>

#include <cstdio>
#include <optional>
#include <string>
#include <vector>

#include "base/process/clocks.h"
#include "base/process/command_line.h"
#include "tools/ctl/cue_operator.h"
#include "tools/ctl/cue_table.h"
#include "tools/ctl/fleet_table.h"
#include "tools/ctl/operator.h"
#include "tools/ctl/status_text.h"
#include "tools/ctl/subcommands.h"

namespace {

constexpr int kExitRefused = 1;
constexpr double kPatience_s = 3.0;

int send_to_each(ols::ctl::Operator& hand, const std::vector<std::string>& ids,
                 const ols::ctl::Send& send) {
  int result = 0;
  for (const auto& id : ids) {
    const auto refusal = send(hand, id);
    std::printf("%s: %s\n", id.c_str(), refusal ? refusal->c_str() : "done");
    if (refusal) result = kExitRefused;
  }
  return result;
}

int no_status(const std::string& station, const std::string& url) {
  std::fprintf(stderr, "ols-ctl: no status of %s on %s\n",
               station == "all" ? "any station" : station.c_str(), url.c_str());
  return kExitRefused;
}

void warn_when_full(const ols::ctl::Operator& hand) {
  if (!hand.is_full()) return;
  std::fprintf(
      stderr,
      "ols-ctl: more than %zu stations are heard, not all are shown: name the one that you "
      "mean\n",
      ols::wire::kMostStationsHeard);
}

// Returns after the stop's hold (Station::kStopHold_s), so that a following release is obeyed.
int stop(const std::string& url, const ols::trust::TrustConfig& trust, const std::string& station) {
  constexpr int kHold_ms = 1100;
  ols::ctl::Operator hand(url, trust, station);
  const auto stopped = hand.stop(kPatience_s);
  warn_when_full(hand);
  if (stopped.empty()) return no_status(station, url);
  int result = 0;
  for (const auto& [id, said] : stopped) {
    std::printf("%s: %s\n", id.c_str(), said ? "done" : "sent repeatedly, no answer");
    if (!said) result = kExitRefused;
  }
  ols::flush_output();
  ::poll(nullptr, 0, kHold_ms);
  return result;
}

int run(const std::string& url, const ols::trust::TrustConfig& trust, const std::string& station,
        const std::optional<ols::ctl::Send>& send, ols::ctl::Look look) {
  ols::ctl::Operator hand(url, trust, station);
  if (send && station != "all") return send_to_each(hand, {station}, *send);
  const auto& statuses = hand.listen(kPatience_s);
  if (look == ols::ctl::Look::kFleet && (!statuses.empty() || !hand.enrolled().empty())) {
    std::fputs(ols::ctl::fleet_table(statuses, hand.enrolled()).c_str(), stdout);
  }
  if (statuses.empty()) return no_status(station, url);
  warn_when_full(hand);
  if (send) {
    std::vector<std::string> ids;  // a copy: the operator continues to listen while it sends
    for (const auto& [id, status] : statuses) ids.push_back(id);
    return send_to_each(hand, ids, *send);
  }
  if (look == ols::ctl::Look::kTable) std::fputs(ols::ctl::status_table(statuses).c_str(), stdout);
  for (const auto& [id, status] : statuses) {
    if (look != ols::ctl::Look::kFull) break;
    std::fputs(ols::ctl::full_status(status, ols::clock_utime_us()).c_str(), stdout);
  }
  return 0;
}

int run_cues(const ols::ctl::Words& words) {
  ols::ctl::CueOperator hand(words.url, words.trust);
  if (words.cue_order) {
    const auto refusal = hand.give(*words.cue_order, kPatience_s);
    std::printf("%s: %s\n", words.cue_order->cue.c_str(), refusal ? refusal->c_str() : "done");
    return refusal ? kExitRefused : 0;
  }
  const auto said = hand.listen(kPatience_s);
  if (!said) {
    std::fprintf(stderr, "ols-ctl: no status of a fusion on %s\n", words.url.c_str());
    return kExitRefused;
  }
  std::fputs(ols::ctl::cue_table(*said, hand.classes()).c_str(), stdout);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{
      "Commands one station or all: designate, look, centre, manual, rate, lens, stop, release, "
      "rearm, home, "
      "reference-ok, record, "
      "status, fleet; or with fusion in place of a station: cues, allow, forbid"};
  app.set_version_flag("--version", OLS_VERSION);
  ols::ctl::Words words;
  app.add_option("station", words.station, "Id of the station, all, or fusion")->required();
  app.add_option("--lcm-url", words.url,
                 "Bus of the site; else with ttl=1 where /etc/ols/bus.env is")
      ->envname("LCM_DEFAULT_URL");
  ols::trust::add_trust_options(app, words.trust);
  ols::ctl::add_subcommands(app, words);
  return ols::run_command(app, argc, argv, "ols-ctl", [&] {
    if (words.cues) return run_cues(words);
    if (words.stop) return stop(words.url, words.trust, words.station);
    return run(words.url, words.trust, words.station, words.send, words.look);
  });
}
