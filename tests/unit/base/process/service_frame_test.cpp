#include "base/process/service_frame.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <vector>

#include "base/config/toml_config.h"
#include "base/process/clocks.h"
#include "base/process/shutdown.h"

namespace ols {
namespace {

struct Config {
  std::string lcm_url = "memq://";
  int read = 0;
};
Config load(const std::string& path) {
  Config config;
  config.lcm_url = "of " + path;
  config.read = 1;
  return config;
}

Config configured(std::vector<std::string> words) {
  CLI::App app;
  ServiceOptions options;
  add_service_options(app, options);
  std::reverse(words.begin(), words.end());  // as CLI11 wants them
  app.parse(words);
  return configuration_of(options, load);
}

TEST(ServiceFrame, TheCommandLineOverridesTheFileAndTheFileTheDefaults) {
  EXPECT_EQ(configured({}).lcm_url, "memq://");
  EXPECT_EQ(configured({"--config", "a.toml"}).lcm_url, "of a.toml");
  const Config both = configured({"--config", "a.toml", "--lcm-url", "udpm://"});
  EXPECT_EQ(both.lcm_url, "udpm://");
  EXPECT_EQ(both.read, 1);
}

// In a process of its own: a program has one name.
template <class Error>
void fail_with(InvalidArgument invalid) {
  std::exit(run_service("program", invalid, []() -> int { throw Error("this went wrong"); }));
}

TEST(ServiceFrameDeathTest, TheExitStatusSaysWhetherARestartHelps) {
  const auto bad_input = testing::ExitedWithCode(2), failure = testing::ExitedWithCode(1);
  const char* const line = "^program: this went wrong\n$";
  EXPECT_EXIT(fail_with<ConfigError>(InvalidArgument::kFailure), bad_input, line);
  EXPECT_EXIT(fail_with<std::invalid_argument>(InvalidArgument::kBadInput), bad_input, line);
  EXPECT_EXIT(fail_with<std::invalid_argument>(InvalidArgument::kFailure), failure,
              "critical.*this went wrong");
  EXPECT_EXIT(fail_with<std::runtime_error>(InvalidArgument::kBadInput), failure,
              "critical.*this went wrong");
  EXPECT_EXIT(std::exit(run_service("program", InvalidArgument::kFailure, [] { return 5; })),
              testing::ExitedWithCode(5), "");
}

// In a process of its own, because a request to end is never taken back. Ends with the number of
// turns, and 100 for each status.
void serve_for_turns(int turns, double status_s) {
  install_shutdown_handler();
  ServiceNotifier service_manager;
  int turned = 0, statuses = 0;
  const auto turn = [&](double) {
    if (++turned == turns) std::raise(SIGTERM);
  };
  serve(service_manager, status_s, turn, [&] {
    ++statuses;
    return std::string("well");
  });
  std::exit(turned + 100 * statuses);
}

TEST(ServiceFrameDeathTest, TurnsUntilItIsAskedToEndAndSaysHowItIs) {
  EXPECT_EXIT(serve_for_turns(3, 1000.0), testing::ExitedWithCode(103), "");
  EXPECT_EXIT(serve_for_turns(2, 0.0), testing::ExitedWithCode(202), "");
}

}  // namespace
}  // namespace ols
