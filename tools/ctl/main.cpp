// ols-ctl: the operator's commands on the command line.
#include <poll.h>

#include <cmath>
#include <cstdio>
#include <functional>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "base/clocks.h"
#include "base/command_line.h"
#include "base/trust/trust_options.h"
#include "geometry/angles.h"
#include "geometry/slew_limits.h"
#include "tools/ctl/cue_operator.h"
#include "tools/ctl/cue_table.h"
#include "tools/ctl/fleet_table.h"
#include "tools/ctl/operator.h"
#include "tools/ctl/status_text.h"

namespace {

constexpr int kExitRefused = 1;
constexpr double kPatience_s = 3.0;

// What is shown of the statuses.
enum class Look { kTable, kFull, kFleet };

using Send = std::function<std::optional<std::string>(ols::ctl::Operator&, const std::string&)>;

int send_to_each(ols::ctl::Operator& hand, const std::vector<std::string>& ids, const Send& send) {
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
      ols::command::kMostStationsHeard);
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
        const std::optional<Send>& send, Look look) {
  ols::ctl::Operator hand(url, trust, station);
  const auto& statuses = hand.listen(kPatience_s);
  if (statuses.empty()) return no_status(station, url);
  warn_when_full(hand);
  if (send) {
    std::vector<std::string> ids;  // a copy: the operator continues to listen while it sends
    for (const auto& [id, status] : statuses) ids.push_back(id);
    return send_to_each(hand, ids, *send);
  }
  if (look == Look::kTable) std::fputs(ols::ctl::status_table(statuses).c_str(), stdout);
  if (look == Look::kFleet) std::fputs(ols::ctl::fleet_table(statuses).c_str(), stdout);
  for (const auto& [id, status] : statuses) {
    if (look != Look::kFull) break;
    std::fputs(ols::ctl::full_status(status, ols::clock_utime_us()).c_str(), stdout);
  }
  return 0;
}

// The parsed command line.
struct Words {
  std::string station;
  std::string url = "udpm://239.255.76.67:7667?ttl=0";
  std::vector<double> box;
  std::vector<double> point;
  std::vector<double> angles_deg;
  std::vector<double> rates_deg_s;
  double seconds = 1.0;
  ols::command::Order lens;
  double before_s = 0.0, after_s = 0.0;
  std::string label;
  ols::trust::TrustConfig trust;
  Look look = Look::kTable;
  bool stop = false;
  bool cues = false;  // in place of a station: what the fusion is led by
  std::optional<ols::command::CueOrder> cue_order;
  std::optional<Send> send;  // nothing: stop or status
};

int run_cues(const Words& words) {
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
  std::fputs(ols::ctl::cue_table(*said).c_str(), stdout);
  return 0;
}

void require_angle(const char* name, double angle_deg, double limit_deg) {
  if (std::abs(angle_deg) <= limit_deg) return;
  std::ostringstream what;
  what << name << ' ' << angle_deg << " is outside " << -limit_deg << " .. " << limit_deg << " deg";
  throw CLI::ValidationError("manual", what.str());
}

void require_rate(double rate_deg_s) {
  const double limit_deg_s = ols::degrees(ols::kRateLimit_rad_s);
  if (std::abs(rate_deg_s) <= limit_deg_s) return;
  std::ostringstream what;
  what << rate_deg_s << " is outside " << -limit_deg_s << " .. " << limit_deg_s << " deg/s";
  throw CLI::ValidationError("rate", what.str());
}

void add_rate_command(CLI::App& app, Words& words) {
  auto* rate = app.add_subcommand("rate", "Turn the PTU for a while, then halt it");
  rate->add_option("rates", words.rates_deg_s, "PAN TILT [deg/s] as the PTU counts them")
      ->expected(2)
      ->required();
  rate->add_option("--seconds", words.seconds, "How long [s]")->check(CLI::Range(0.1, 3600.0));
  rate->callback([&words] {
    for (const double rate_deg_s : words.rates_deg_s) require_rate(rate_deg_s);
    words.send = [&words](ols::ctl::Operator& hand, const std::string& id) {
      return hand.hold_rate({.station = id,
                             .kind = ols::command::Kind::kRate,
                             .pan_rate_rad_s = ols::radians(words.rates_deg_s[0]),
                             .tilt_rate_rad_s = ols::radians(words.rates_deg_s[1])},
                            words.seconds);
    };
  });
}

void add_lens_command(CLI::App& app, Words& words) {
  auto* lens = app.add_subcommand("lens", "Move a motorised lens to positions");
  const CLI::Range share(0.0, 1.0);
  lens->add_option("--zoom", words.lens.zoom, "0 widest .. 1 longest")->check(share);
  lens->add_option("--focus", words.lens.focus, "0 far .. 1 near")->check(share);
  lens->add_option("--iris", words.lens.iris, "0 closed .. 1 open")->check(share);
  lens->require_option(1, 3);
  lens->callback([&words] {
    words.send = [&words](ols::ctl::Operator& hand, const std::string& id) {
      ols::command::Order order = words.lens;
      order.station = id;
      order.kind = ols::command::Kind::kLens;
      return hand.give(order);
    };
  });
}

// At a pixel of the newest frame.
void add_point_commands(CLI::App& app, Words& words) {
  const auto at_point = [&](const char* name, const char* help, ols::command::Kind kind) {
    auto* command = app.add_subcommand(name, help);
    command->add_option("point", words.point, "X Y [px] in the full-resolution frame")
        ->expected(2)
        ->required();
    command->callback([&words, kind] {
      words.send = [&words, kind](ols::ctl::Operator& hand, const std::string& id) {
        return hand.give(
            {.station = id, .kind = kind, .x_px = words.point[0], .y_px = words.point[1]});
      };
    });
  };
  at_point("centre", "Turn until a pixel is in the middle of the picture",
           ols::command::Kind::kCentre);
  at_point("look",
           "Follow the object at a pixel, and lead the other stations along that line of sight "
           "until they see it",
           ols::command::Kind::kLook);
}

void add_ptu_commands(CLI::App& app, Words& words) {
  auto* manual = app.add_subcommand("manual", "Point the PTU and stay there");
  manual->add_option("angles", words.angles_deg, "PAN TILT [deg] as the PTU counts them")
      ->expected(2)
      ->required();
  manual->callback([&words] {
    require_angle("PAN", words.angles_deg[0], ols::degrees(ols::kPointPanLimit_rad));
    require_angle("TILT", words.angles_deg[1], ols::degrees(ols::kPointTiltLimit_rad));
    words.send = [&words](ols::ctl::Operator& hand, const std::string& id) {
      return hand.give({.station = id,
                        .kind = ols::command::Kind::kPoint,
                        .pan_rad = ols::radians(words.angles_deg[0]),
                        .tilt_rad = ols::radians(words.angles_deg[1])});
    };
  });
  const auto simple = [&](const char* name, const char* help, ols::command::Kind kind) {
    app.add_subcommand(name, help)->callback([&words, kind] {
      words.send = [kind](ols::ctl::Operator& hand, const std::string& id) {
        return hand.give({.station = id, .kind = kind});
      };
    });
  };
  app.add_subcommand("stop", "Halt the PTU; it stays stopped until the next command")
      ->callback([&words] { words.stop = true; });
  simple("release", "Give the PTU back to automatic control", ols::command::Kind::kRelease);
  simple(
      "rearm",
      "End the emergency after the stop button is released; the PTU stays stopped. Only where the "
      "site permits it remotely",
      ols::command::Kind::kRearm);
  simple("home", "Home the PTU: it sweeps its whole travel, clear the way first",
         ols::command::Kind::kHome);
  simple("reference-ok", "Confirm the PTU's angles, after checking them or homing by hand",
         ols::command::Kind::kReferenceOk);
}

// Of the fusion, not of a station.
void add_cue_commands(CLI::App& app, Words& words) {
  const auto of_fusion = [&words](const char* name) {
    words.cues = true;
    if (words.station == "fusion") return;
    throw CLI::ValidationError(name, "is for the fusion: ols-ctl fusion " + std::string(name));
  };
  app.add_subcommand("cues", "Show the cues from outside (ols-ctl fusion cues)")
      ->callback([of_fusion] { of_fusion("cues"); });
  const auto word = [&](const char* name, const char* help, bool allow) {
    auto* command = app.add_subcommand(name, help);
    command->add_option("cue", words.label, "Its name, as shown by cues")->required();
    command->callback([&words, of_fusion, name, allow] {
      of_fusion(name);
      words.cue_order = ols::command::CueOrder{words.label, allow};
    });
  };
  word("allow", "Let stations be led to a cue (ols-ctl fusion allow CUE)", true);
  word("forbid", "Let no station be led to a cue any more", false);
}

void add_other_commands(CLI::App& app, Words& words) {
  auto* designate = app.add_subcommand("designate", "Follow the object in this box of the image");
  designate
      ->add_option("box", words.box, "X,Y,W,H [px], top-left corner, newest full-resolution frame")
      ->delimiter(',')
      ->expected(4)
      ->required();
  designate->callback([&words] {
    words.send = [&words](ols::ctl::Operator& hand, const std::string& id) {
      return hand.give({.station = id,
                        .kind = ols::command::Kind::kDesignate,
                        .x_px = words.box[0],
                        .y_px = words.box[1],
                        .width_px = words.box[2],
                        .height_px = words.box[3]});
    };
  });
  auto* record =
      app.add_subcommand("record", "Save the raw frames around now on the station's disk");
  record->add_option("before", words.before_s, "Before now [s], as far as in memory")->required();
  record->add_option("after", words.after_s, "After now [s]")->required();
  record->add_option("label", words.label, "Part of the folder's name: letters, digits, - and _")
      ->required();
  record->callback([&words] {
    words.send = [&words](ols::ctl::Operator& hand, const std::string& id) {
      return hand.give({.station = id,
                        .kind = ols::command::Kind::kRecord,
                        .before_s = words.before_s,
                        .after_s = words.after_s,
                        .label = words.label});
    };
  });
  auto* status = app.add_subcommand("status", "Show the state");
  status->add_flag_callback(
      "--full", [&words] { words.look = Look::kFull; }, "Devices, alarms, readings and counters");
  app.add_subcommand("fleet", "Calibration, clock, disk, temperature and newest alarm of each")
      ->callback([&words] { words.look = Look::kFleet; });
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{
      "Commands one station or all: designate, look, centre, manual, rate, lens, stop, release, "
      "rearm, home, "
      "reference-ok, record, "
      "status, fleet; or with fusion in place of a station: cues, allow, forbid"};
  app.set_version_flag("--version", OLS_VERSION);
  Words words;
  app.add_option("station", words.station, "Id of the station, all, or fusion")->required();
  app.add_option("--lcm-url", words.url, "Bus of the site")->envname("LCM_DEFAULT_URL");
  ols::trust::add_trust_options(app, words.trust);
  app.require_subcommand(1);
  add_ptu_commands(app, words);
  add_rate_command(app, words);
  add_lens_command(app, words);
  add_point_commands(app, words);
  add_other_commands(app, words);
  add_cue_commands(app, words);
  if (const auto status = ols::parse_command_line(app, argc, argv, "ols-ctl")) return *status;
  try {
    const int status = words.cues ? run_cues(words)
                       : words.stop
                           ? stop(words.url, words.trust, words.station)
                           : run(words.url, words.trust, words.station, words.send, words.look);
    ols::flush_output();
    return status;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "ols-ctl: %s\n", error.what());
    return ols::kExitBadInput;
  }
}
