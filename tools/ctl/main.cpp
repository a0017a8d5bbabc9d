// ols-ctl: the operator's hand on the command line.
#include <cmath>
#include <cstdio>
#include <functional>
#include <iomanip>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "base/command_line.h"
#include "geometry/angles.h"
#include "tools/ctl/operator.h"

namespace {

constexpr int kExitRefused = 1;
constexpr double kPatience_s = 3.0;

// "-" for what is not known.
std::string shown(double value, int decimals) {
  if (!std::isfinite(value)) return "-";
  std::ostringstream text;
  text << std::fixed << std::setprecision(decimals) << value;
  return text.str();
}

std::string shown_deg(double rad, int decimals) { return shown(ols::degrees(rad), decimals); }

void print_status(const ols::Operator::Statuses& statuses) {
  const char* format = "%-12s %-9s %6s %9s %9s %8s %8s  %-8s %-8s %8s %6s  %s\n";
  std::printf(format, "station", "state", "belief", "azim deg", "elev deg", "pan deg", "tilt deg",
              "camera", "ptu", "frames", "lost", "last error");
  for (const auto& [id, s] : statuses) {
    const double lost = ols::counter(s, "frames_lost") + ols::counter(s, "frames_incomplete");
    std::printf(format, id.c_str(), ols::state_name(s.state), shown(s.belief, 2).c_str(),
                shown_deg(s.azimuth_rad, 3).c_str(), shown_deg(s.elevation_rad, 3).c_str(),
                shown_deg(s.pan_rad, 2).c_str(), shown_deg(s.tilt_rad, 2).c_str(),
                ols::device_state(s, "camera"), ols::device_state(s, "ptu"),
                shown(ols::counter(s, "frames_captured"), 0).c_str(), shown(lost, 0).c_str(),
                s.last_error.c_str());
  }
}

using Send = std::function<std::optional<std::string>(ols::Operator&, const std::string&)>;

int send_to_each(ols::Operator& hand, const std::vector<std::string>& ids, const Send& send) {
  int result = 0;
  for (const auto& id : ids) {
    const auto refusal = send(hand, id);
    std::printf("%s: %s\n", id.c_str(), refusal ? refusal->c_str() : "done");
    if (refusal) result = kExitRefused;
  }
  return result;
}

int run(const std::string& url, const std::string& station, const std::optional<Send>& send) {
  ols::Operator hand(url, station);
  const auto& statuses = hand.listen(kPatience_s);
  if (statuses.empty()) {
    std::fprintf(stderr, "ols-ctl: no status of %s on %s\n",
                 station == "all" ? "any station" : station.c_str(), url.c_str());
    return kExitRefused;
  }
  if (send) {
    std::vector<std::string> ids;  // of now: the hand goes on listening while it sends
    for (const auto& [id, status] : statuses) ids.push_back(id);
    return send_to_each(hand, ids, *send);
  }
  print_status(statuses);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Tells one station, or all, what to do: designate, manual, stop, release, status"};
  std::string station;
  std::string url = "udpm://239.255.76.67:7667?ttl=0";
  std::vector<double> box;
  std::vector<double> angles_deg;
  app.add_option("station", station, "Id of the station, or all")->required();
  app.add_option("--lcm-url", url, "Bus of the site")->envname("LCM_DEFAULT_URL");
  app.require_subcommand(1);

  auto* designate = app.add_subcommand("designate", "Follow what is in this box of its view");
  designate->add_option("box", box, "X,Y,W,H [px], top-left corner, newest full-resolution frame")
      ->delimiter(',')
      ->expected(4)
      ->required();
  auto* manual = app.add_subcommand("manual", "Point the PTU and stay there");
  manual->add_option("angles", angles_deg, "PAN TILT [deg] as the PTU counts them")
      ->expected(2)
      ->required();
  auto* stop = app.add_subcommand("stop", "Halt the PTU, and stay stopped until told otherwise");
  auto* release = app.add_subcommand("release", "Give the PTU back to automatic control");
  app.add_subcommand("status", "Show how it is");
  if (const auto status = ols::parse_command_line(app, argc, argv, "ols-ctl")) return *status;

  std::optional<Send> send;
  if (designate->parsed()) {
    send = [&](ols::Operator& hand, const std::string& id) {
      return hand.designate(id, box[0], box[1], box[2], box[3]);
    };
  } else if (manual->parsed()) {
    send = [&](ols::Operator& hand, const std::string& id) {
      return hand.point(id, ols::radians(angles_deg[0]), ols::radians(angles_deg[1]));
    };
  } else if (stop->parsed()) {
    send = [](ols::Operator& hand, const std::string& id) { return hand.stop(id); };
  } else if (release->parsed()) {
    send = [](ols::Operator& hand, const std::string& id) { return hand.release(id); };
  }
  try {
    return run(url, station, send);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "ols-ctl: %s\n", error.what());
    return ols::kExitBadInput;
  }
}
