// ols-bridge: parses the command line, loads the configuration, and runs.
#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <string>
#include <system_error>

#include "base/process/command_line.h"
#include "base/process/service_frame.h"
#include "base/trust/crypto.h"
#include "bridge/bridge_config.h"
#include "bridge/bridge_process.h"
#include "bridge/nats_key.h"

namespace {

namespace bridge = ols::bridge;

struct Arguments : ols::ServiceOptions {
  std::string make_key;
};

// Writes the seed into a new file for its owner alone, and prints the public key.
void make_key(const std::string& path) {
  const ols::trust::Seed seed = ols::trust::draw_secret();
  const bridge::NatsKey key = bridge::nats_key(seed, ols::trust::SigningKey(seed).public_key());
  const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
  const std::string text = key.seed + "\n";
  const bool is_written =
      file >= 0 && ::write(file, text.data(), text.size()) == static_cast<ssize_t>(text.size()) &&
      ::fsync(file) == 0;
  const int problem = errno;
  if (file >= 0) ::close(file);
  if (!is_written) throw std::system_error(problem, std::generic_category(), path);
  std::printf("%s\n", key.public_key.c_str());
}

int act(const Arguments& arguments) {
  if (!arguments.make_key.empty()) {
    make_key(arguments.make_key);
    return 0;
  }
  const bridge::BridgeConfig config = configuration_of(arguments, bridge::load_bridge_config);
  if (arguments.check_config) return 0;
  bridge::BridgeProcess(config).run();
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Passes messages between this site's bus and other sites, over NATS"};
  app.set_version_flag("--version", OLS_VERSION);
  Arguments arguments;
  add_service_options(app, arguments);
  app.add_option("--make-key", arguments.make_key,
                 "Only make a key: write its seed into this new file and print the public key");
  if (const auto status = ols::parse_command_line(app, argc, argv, "ols-bridge")) return *status;
  return ols::run_service("ols-bridge", ols::InvalidArgument::kFailure,
                          [&arguments] { return act(arguments); });
}
