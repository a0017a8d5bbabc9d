// One output: a gate selects records, an encoder turns them into packets, and an outlet sends the
// packets.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "export/encoder.h"
#include "export/gate.h"
#include "export/outlet/outlet.h"

namespace ols::exports {

class Output {
 public:
  // `period_s`: interval between two calls of Encoder::due().
  Output(std::string name, const GateConfig& gate, double period_s,
         std::unique_ptr<Encoder> encoder, std::unique_ptr<Outlet> outlet);

  void take(const Target& target);
  void take(const Station& station);
  void take(const Line& line);
  void take(const Incident& incident);
  // Call often: sends what is due without a record. `now_s`: monotonic; `utime_us`: UTC.
  void step(double now_s, std::int64_t utime_us);

  const std::string& name() const { return name_; }
  OutletReport report() const { return outlet_->report(); }

 private:
  void put(Packets packets);

  std::string name_;
  Gate gate_;
  double period_s_;
  std::unique_ptr<Encoder> encoder_;
  std::unique_ptr<Outlet> outlet_;
  double due_s_ = 0.0;
  std::uint64_t openings_ = 0;
};

}  // namespace ols::exports
