// ols-ctl: the operator's hand on the command line.
#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "geometry/angles.h"
#include "tools/ctl/operator.h"

namespace {

constexpr int kExitRefused = 1;
constexpr int kExitBadInput = 2;
constexpr double kPatience_s = 3.0;

void print_status(const ols::Operator::Statuses& statuses) {
  std::printf("%-12s %-9s %6s %9s %9s %8s %8s  %-8s %-8s %8s %6s  %s\n", "station", "state",
              "belief", "azimuth", "elevation", "pan", "tilt", "camera", "ptu", "frames", "lost",
              "last error");
  for (const auto& [id, status] : statuses) {
    std::printf(
        "%-12s %-9s %6.2f %8.3f\u00b0 %8.3f\u00b0 %7.2f\u00b0 %7.2f\u00b0  %-8s %-8s %8.0f %6.0f  "
        "%s\n",
        id.c_str(), ols::state_name(status.state), status.belief, ols::degrees(status.azimuth_rad),
        ols::degrees(status.elevation_rad), ols::degrees(status.pan_rad),
        ols::degrees(status.tilt_rad), ols::device_name(status.camera_state),
        ols::device_name(status.ptu_state), ols::counter(status, "frames_captured"),
        ols::counter(status, "frames_lost") + ols::counter(status, "frames_incomplete"),
        status.last_error.c_str());
  }
}

using Send = std::function<std::optional<std::string>(ols::Operator&, const std::string&)>;

int send_to_each(ols::Operator& hand, const ols::Operator::Statuses& statuses, const Send& send) {
  int result = 0;
  const ols::Operator::Statuses addressed = statuses;
  for (const auto& [id, status] : addressed) {
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
  if (send) return send_to_each(hand, statuses, *send);
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
  CLI11_PARSE(app, argc, argv);

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
    return kExitBadInput;
  }
}
