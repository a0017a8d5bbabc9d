// Runs ols-bridge: connects its parts. The thread of run() handles messages from the bus; the NATS
// library's threads handle messages from the network. Neither waits for the other.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>

#include "base/journal/alarm_journal.h"
#include "base/process/status_file.h"
#include "bridge/archive_stream.h"
#include "bridge/bridge_bus.h"
#include "bridge/bridge_config.h"
#include "bridge/nats_link.h"
#include "bridge/owner_store.h"
#include "bridge/ownership/ownership.h"
#include "bridge/passage.h"
#include "bridge/status.h"

namespace ols::bridge {

class BridgeProcess {
 public:
  explicit BridgeProcess(const BridgeConfig& config);

  // Runs until the process is asked to end.
  void run();

 private:
  // The parts that share one connection to a server. They are destroyed in the reverse order of
  // declaration, so that each part ends before the parts that it uses.
  struct Remote {
    Remote(BridgeProcess& bridge, const BridgeConfig& config);
    NatsLink link;
    std::unique_ptr<ArchiveStream> archive;
    std::unique_ptr<OwnerStore> store;
    double begun_s;
  };
  void renew_link(double now_s);
  OwnerStore::Ears ears();
  Owned owned();
  void hear_owner(std::string_view subject, const Headers& headers, Bytes bytes);
  void step_ownership();
  void send_out(const std::string& channel, Bytes bytes);
  void take_in(std::string_view subject, const Headers& headers, Bytes bytes);
  BridgeStatus status();
  void describe_link(BridgeStatus& status) const;
  void describe_archive(BridgeStatus& status, std::map<std::string, double> heard, double now_s);
  // Logs conditions that begin or end, and writes the status file. Returns the status in one line.
  std::string report();

  const BridgeConfig config_;
  StatusFile status_file_;
  std::mutex mutex_;
  Passage passage_;                     // under the lock
  std::optional<Ownership> ownership_;  // under the lock; nullopt: ownership is off, this fusion
                                        // owns every target
  BridgeBus bus_;
  std::atomic<std::uint64_t> unsent_to_bus_{0};
  AlarmJournal alarms_;
  std::map<std::string, double> live_since_s_;  // since when each site's live messages arrive
  LinkReport before_;                           // summed counts of the connections that have ended
  std::string tried_anew_;                      // the reason last logged for a new connection;
                                                // empty: none since the connection works
  std::unique_ptr<Remote> remote_;  // declared last, so that its threads end before anything that
                                    // they use
};

}  // namespace ols::bridge
