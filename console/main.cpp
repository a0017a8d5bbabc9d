// ols-console: parses the command line, loads the configuration, wires the parts and loops.
#include <sodium.h>
#include <spdlog/spdlog.h>

#include <array>
#include <cstdio>
#include <ctime>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "base/journal/alarm_journal.h"
#include "base/journal/journal.h"
#include "base/process/clocks.h"
#include "base/process/command_line.h"
#include "base/process/service_frame.h"
#include "base/process/service_notifier.h"
#include "console/add_user.h"
#include "console/console.h"
#include "console/console_bus.h"
#include "console/console_config.h"
#include "console/handed_over_socket.h"
#include "console/incidents/incident_store.h"
#include "console/replay/replay.h"
#include "console/video_puller.h"
#include "console/web_api.h"
#include "console/web_server.h"
#include "land/terrain_folder.h"

namespace {

constexpr double kTurn_s = 0.01;
constexpr double kStatus_s = 1.0;

struct Arguments : ols::ServiceOptions {
  std::string address, users, add_user, role = "operator", replay;
  std::vector<std::string> frames;  // "STATION=FOLDER"
  int port = -1;
};

std::string draw_token() {
  std::array<unsigned char, 32> bytes{};
  randombytes_buf(bytes.data(), bytes.size());
  std::array<char, 2 * bytes.size() + 1> text{};
  sodium_bin2hex(text.data(), text.size(), bytes.data(), bytes.size());
  return text.data();
}

// In this host's time zone.
int local_minute_of_day(std::int64_t utime_us) {
  const std::time_t seconds = utime_us / 1'000'000;
  std::tm local{};
  tzset();  // The zone may be set while the console runs; localtime_r need not look.
  localtime_r(&seconds, &local);
  return 60 * local.tm_hour + local.tm_min;
}

// As a person types it into a browser.
std::string web_address(const ols::console::ConsoleConfig& config, int port) {
  const bool is_v6 = config.address.find(':') != std::string::npos;
  return (config.certificate.empty() ? "http://" : "https://") +
         (is_v6 ? "[" + config.address + "]" : config.address) + ":" + std::to_string(port) + "/";
}

ols::console::ConsoleConfig configuration(const Arguments& arguments) {
  auto config = configuration_of(arguments, ols::console::load_console_config);
  if (!arguments.address.empty()) config.address = arguments.address;
  if (!arguments.users.empty()) config.users = arguments.users;
  if (arguments.port >= 0) config.port = arguments.port;
  return config;
}

ols::console::RecordedFrames recorded_frames(const std::vector<std::string>& folders) {
  ols::console::RecordedFrames frames;
  for (const std::string& folder : folders) {
    const auto equals = folder.find('=');
    if (equals == 0 || equals == std::string::npos) {
      throw std::invalid_argument("--frames " + folder + ": must be STATION=FOLDER");
    }
    frames.add(folder.substr(0, equals), folder.substr(equals + 1));
  }
  return frames;
}

// Writes the users down, unless somebody else has changed the file since.
ols::console::WebApi::SaveUsers user_keeper(const std::string& file, ols::console::Users known) {
  return [file, known](const ols::console::Users& users) mutable {
    if (ols::console::read_users(file) != known) {
      throw std::runtime_error(file + " was changed meanwhile: restart the console");
    }
    ols::console::write_users(file, users);
    known = users;
  };
}

// What the console shows: a site on the bus, or a recording of one.
class Shown {
 public:
  virtual ~Shown() = default;
  virtual void turn(const ols::console::Now& now) = 0;
  virtual std::string in_one_line() const = 0;
};

class LiveSite : public Shown {
 public:
  LiveSite(const ols::console::ConsoleConfig& config, ols::console::Console& console)
      : console_(console),
        bus_(config.lcm_url, config.trust, console),
        video_(config.video_networks, {}),
        store_(config.incidents_folder) {
    console_.resume(store_.read(), {ols::clock_monotonic_s(), ols::clock_utime_us()});
  }

  void turn(const ols::console::Now& now) override {
    bus_.turn(now);
    console_.bus_is(bus_.trouble());
    video_.watch(console_.watched_video());
    for (ols::console::Picture& picture : video_.take()) console_.receive(std::move(picture));
    bus_.send(console_.turn(now), now);
    bus_.send(console_.take_answers(), now);
    bus_.send(console_.take_cue_orders(), now);
    keep_incidents(now);
  }
  std::string in_one_line() const override { return bus_.in_one_line(); }

 private:
  using IncidentStore = ols::console::IncidentStore;

  // Written at once and in this thread: incidents are rare and small.
  void keep_incidents(const ols::console::Now& now) {
    const ols::console::IncidentBook::News& news = console_.incident_news();
    const ols::console::IncidentBook& book = console_.incidents();
    bus_.send(news, now);
    store_.keep(book, news, now.monotonic_s);
    const std::vector<ols::Alarm> trouble = store_.alarms();
    console_.incident_trouble(trouble);
    std::vector<ols::Alarm> alarms = book.alarms();
    alarms.insert(alarms.end(), trouble.begin(), trouble.end());
    journal_.look(alarms, now.monotonic_s);
  }

  ols::console::Console& console_;
  ols::console::ConsoleBus bus_;
  ols::console::VideoPuller video_;
  IncidentStore store_;
  ols::AlarmJournal journal_;
};

// A recording has no bus: nothing that is said in a browser can reach a station.
class RecordedSite : public Shown {
 public:
  RecordedSite(const Arguments& arguments, ols::console::Console& console)
      : replay_(arguments.replay, recorded_frames(arguments.frames), console) {}

  void turn(const ols::console::Now& now) override {
    const bool was_read = replay_.is_read();
    replay_.turn(now.monotonic_s);
    if (replay_.is_read() && !was_read && !replay_.problem().empty()) {
      spdlog::warn("replay: {}", replay_.problem());
    }
  }
  std::string in_one_line() const override { return replay_.in_one_line(); }

 private:
  ols::console::Replay replay_;
};

std::unique_ptr<Shown> shown(const Arguments& arguments, const ols::console::ConsoleConfig& config,
                             ols::console::Console& console) {
  if (arguments.replay.empty()) return std::make_unique<LiveSite>(config, console);
  return std::make_unique<RecordedSite>(arguments, console);
}

int run(const Arguments& arguments, ols::console::ConsoleConfig config,
        ols::land::TerrainFolder land) {
  if (sodium_init() < 0) throw std::runtime_error("libsodium cannot be initialised");
  const auto socket = ols::console::handed_over_socket();
  if (socket) config.address = socket->address;
  const auto users = ols::as_bad_input([&] { return ols::console::read_users(config.users); });
  if (const auto problem = serving_problem(config, !users.empty()); !problem.empty()) {
    throw std::invalid_argument(problem);
  }
  ols::console::Console console(config.control_timeout_s, config.incident_recording);
  ols::console::WebApi api(config, users, console, draw_token, user_keeper(config.users, users));
  ols::console::WebServer server(config, std::move(land), socket, api, console);
  const std::unique_ptr<Shown> site = shown(arguments, config, console);
  const std::string address = web_address(config, server.port());
  ols::ServiceNotifier service_manager;
  service_manager.ready(address);
  if (api.is_open()) {
    spdlog::info("{} names no user: everybody on this host is an operator, without log-in",
                 config.users);
  }
  ols::write_to_journal({.text = "ready: " + address, .id = ols::event::kReady});
  const auto turn = [&](double) {
    server.serve_for(kTurn_s);
    const std::int64_t utime_us = ols::clock_utime_us();
    site->turn({ols::clock_monotonic_s(), utime_us, local_minute_of_day(utime_us)});
    server.pump();
  };
  serve(service_manager, kStatus_s, turn, [&] {
    return address + ", " + std::to_string(console.viewers()) + " browsers; " + site->in_one_line();
  });
  return 0;
}

int act(const Arguments& arguments) {
  const ols::console::ConsoleConfig config = configuration(arguments);
  if (arguments.add_user.empty()) {
    ols::land::TerrainFolder land = ols::land::read_configured_land(config.land_folder);
    return arguments.check_config ? 0 : run(arguments, config, std::move(land));
  }
  ols::as_bad_input(
      [&] { ols::console::add_user(config.users, arguments.add_user, arguments.role); });
  std::fprintf(stderr, "ols-console: %s may log in; restart the console\n",
               arguments.add_user.c_str());
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"The site live in a browser: map, pictures, targets, and commands to the stations"};
  app.set_version_flag("--version", OLS_VERSION);
  Arguments arguments;
  add_service_options(app, arguments);
  app.add_option("--address", arguments.address, "IP address, in place of the configuration's")
      ->check(ols::console::address_problem);
  app.add_option("--port", arguments.port, "TCP port, in place of the configuration's; 0: any")
      ->check(CLI::Range(0, 65535));
  app.add_option("--users", arguments.users, "File of users, in place of the configuration's");
  auto* replay =
      app.add_option("--replay", arguments.replay,
                     "Show this recorded LCM log instead of the bus; no command goes out");
  app.add_option("--frames", arguments.frames,
                 "STATION=FOLDER: show the frames that this station's recorder kept there; may be "
                 "repeated")
      ->needs(replay);
  auto* add = app.add_option("--add-user", arguments.add_user,
                             "Enter this user into the file of users, with a password from the "
                             "terminal or from standard input, and end");
  app.add_option("--role", arguments.role, "Role of that user: viewer, operator or admin")
      ->needs(add);
  if (const auto status = ols::parse_command_line(app, argc, argv, "ols-console")) return *status;
  return ols::run_service("ols-console", ols::InvalidArgument::kBadInput,
                          [&arguments] { return act(arguments); });
}
