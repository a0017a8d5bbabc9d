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
#include "geometry/angles.h"
#include "geometry/slew_limits.h"
#include "tools/ctl/operator.h"
#include "tools/ctl/status_text.h"

namespace {

constexpr int kExitRefused = 1;
constexpr double kPatience_s = 3.0;

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
      ols::ctl::kMostStationsHeard);
}

// Returns after the stop's hold (Station::kStopHold_s), so that a following release is obeyed.
int stop(const std::string& url, const std::string& station) {
  constexpr int kHold_ms = 1100;
  ols::ctl::Operator hand(url, station);
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

int run(const std::string& url, const std::string& station, const std::optional<Send>& send,
        bool full) {
  ols::ctl::Operator hand(url, station);
  const auto& statuses = hand.listen(kPatience_s);
  if (statuses.empty()) return no_status(station, url);
  warn_when_full(hand);
  if (send) {
    std::vector<std::string> ids;  // a copy: the operator continues to listen while it sends
    for (const auto& [id, status] : statuses) ids.push_back(id);
    return send_to_each(hand, ids, *send);
  }
  if (!full) std::fputs(ols::ctl::status_table(statuses).c_str(), stdout);
  for (const auto& [id, status] : statuses) {
    if (full) std::fputs(ols::ctl::full_status(status, ols::clock_utime_us()).c_str(), stdout);
  }
  return 0;
}

// The parsed command line.
struct Words {
  std::string station;
  std::string url = "udpm://239.255.76.67:7667?ttl=0";
  std::vector<double> box;
  std::vector<double> angles_deg;
  double before_s = 0.0, after_s = 0.0;
  std::string label;
  bool full = false;
  bool stop = false;
  std::optional<Send> send;  // nothing: stop or status
};

void require_angle(const char* name, double angle_deg, double limit_deg) {
  if (std::abs(angle_deg) <= limit_deg) return;
  std::ostringstream what;
  what << name << ' ' << angle_deg << " is outside " << -limit_deg << " .. " << limit_deg << " deg";
  throw CLI::ValidationError("manual", what.str());
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
      return hand.point(id, ols::radians(words.angles_deg[0]), ols::radians(words.angles_deg[1]));
    };
  });
  const auto simple = [&](const char* name, const char* help, auto method) {
    app.add_subcommand(name, help)->callback([&words, method] {
      words.send = [method](ols::ctl::Operator& hand, const std::string& id) {
        return (hand.*method)(id);
      };
    });
  };
  app.add_subcommand("stop", "Halt the PTU; it stays stopped until the next command")
      ->callback([&words] { words.stop = true; });
  simple("release", "Give the PTU back to automatic control", &ols::ctl::Operator::release);
  simple(
      "rearm",
      "End the emergency after the stop button is released; the PTU stays stopped. Only where the "
      "site permits it remotely",
      &ols::ctl::Operator::rearm);
  simple("home", "Home the PTU: it sweeps its whole travel, clear the way first",
         &ols::ctl::Operator::home);
  simple("reference-ok", "Confirm the PTU's angles, after checking them or homing by hand",
         &ols::ctl::Operator::reference_ok);
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
      return hand.designate(id, words.box[0], words.box[1], words.box[2], words.box[3]);
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
      return hand.record(id, words.before_s, words.after_s, words.label);
    };
  });
  auto* status = app.add_subcommand("status", "Show the state");
  status->add_flag("--full", words.full, "Devices, alarms, readings and counters");
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{
      "Commands one station or all: designate, manual, stop, release, rearm, home, "
      "reference-ok, record, "
      "status"};
  Words words;
  app.add_option("station", words.station, "Id of the station, or all")->required();
  app.add_option("--lcm-url", words.url, "Bus of the site")->envname("LCM_DEFAULT_URL");
  app.require_subcommand(1);
  add_ptu_commands(app, words);
  add_other_commands(app, words);
  if (const auto status = ols::parse_command_line(app, argc, argv, "ols-ctl")) return *status;
  try {
    const int status = words.stop ? stop(words.url, words.station)
                                  : run(words.url, words.station, words.send, words.full);
    ols::flush_output();
    return status;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "ols-ctl: %s\n", error.what());
    return ols::kExitBadInput;
  }
}
