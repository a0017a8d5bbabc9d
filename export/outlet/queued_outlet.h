// An outlet that puts packets into a queue. A thread sends them over a connection, and opens the
// connection again whenever it breaks.
#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <thread>

#include "base/process/wakeup.h"
#include "export/back_off.h"
#include "export/outlet/link.h"
#include "export/outlet/outlet.h"
#include "export/packet_queue.h"

namespace ols::exports {

class QueuedOutlet : public Outlet {
 public:
  explicit QueuedOutlet(std::unique_ptr<Link> link);
  ~QueuedOutlet() override;

  void put(Packets packets) override;
  OutletReport report() const override;

 private:
  void run();
  void serve();
  void note_open();
  void note_complaints();
  void note_failure(const std::string& why);
  std::optional<Packet> next();
  void pause(double seconds);

  std::unique_ptr<Link> link_;  // used by the thread
  BackOff back_off_;            // used by the thread
  Wakeup wakeup_;
  std::atomic<bool> ends_ = false;
  mutable std::mutex mutex_;  // guards the following
  PacketQueue queue_;
  OutletReport report_;
  std::thread thread_;
};

}  // namespace ols::exports
