// Passes every record from the bus to every output, and counts messages that are not used.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "base/bus/bus_inbox.h"
#include "export/messages.h"
#include "export/output.h"
#include "export/present_targets.h"

namespace ols::exports {

class Exporter {
 public:
  // max_age_s: records whose time differs from now by more than this are not passed on.
  Exporter(SiteContext site, std::vector<std::unique_ptr<Output>> outputs, double max_age_s);

  void receive(const BusMessage& message, std::int64_t now_utime_us);
  // Ends silent targets, and lets each output send what is due, such as a file. `now_s`: monotonic;
  // `utime_us`: UTC.
  void step(double now_s, std::int64_t utime_us);

  const std::vector<std::unique_ptr<Output>>& outputs() const { return outputs_; }
  // The counters: records_sent_on, messages_refused, messages_unused (for example targets without a
  // position), records_old.
  const std::map<std::string, double>& counters() const { return counters_; }
  std::size_t targets() const { return targets_.size(); }

 private:
  template <class Record>
  void give(const Record& record);
  bool is_present(std::int64_t utime_us, std::int64_t now_utime_us);

  SiteContext site_;
  std::vector<std::unique_ptr<Output>> outputs_;
  std::int64_t max_age_us_;
  PresentTargets targets_;
  std::map<std::string, double> counters_;
};

}  // namespace ols::exports
