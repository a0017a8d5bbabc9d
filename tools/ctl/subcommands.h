// The subcommands of ols-ctl: each reads its words and says what is to be sent or shown.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/lcm_url.h"
#include "base/trust/trust_options.h"
#include "command/order.h"
#include "tools/ctl/operator.h"

namespace ols::ctl {

// What is shown of the statuses.
enum class Look { kTable, kFull, kFleet };

// Tells one station; what it refused, in words, or nothing.
using Send = std::function<std::optional<std::string>(Operator&, const std::string&)>;

// The parsed command line.
struct Words {
  std::string station;
  std::string url = default_lcm_url();
  std::vector<double> box;
  std::vector<double> point;
  std::vector<double> angles_deg;
  std::vector<double> rates_deg_s;
  double seconds = 1.0;
  command::Order lens;
  double before_s = 0.0, after_s = 0.0;
  std::string label;
  trust::TrustConfig trust;
  Look look = Look::kTable;
  bool stop = false;
  bool cues = false;  // in place of a station: what the fusion is led by
  std::optional<command::CueOrder> cue_order;
  std::optional<Send> send;  // nothing: stop or status
};

// The words of every subcommand; parsing fills `words`.
void add_subcommands(CLI::App& app, Words& words);

}  // namespace ols::ctl
