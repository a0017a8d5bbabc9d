// The subcommands of ols-ctl. Each parses its arguments and sets in Words what ols-ctl will send or
// show.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/bus/lcm_url.h"
#include "base/trust/trust_options.h"
#include "tools/ctl/operator.h"
#include "wire/order.h"

namespace ols::ctl {

// How the statuses are shown.
enum class Look { kTable, kFull, kFleet };

// Sends an order to one station; returns the refusal in words, or nullopt.
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
  wire::Order lens;
  double before_s = 0.0, after_s = 0.0;
  std::string label;
  trust::TrustConfig trust;
  Look look = Look::kTable;
  bool stop = false;
  bool cues = false;  // show the cues instead of stations
  std::optional<wire::CueOrder> cue_order;
  std::optional<Send> send;  // nullopt: the subcommand stops stations or shows something
};

// Adds every subcommand; parsing fills `words`.
void add_subcommands(CLI::App& app, Words& words);

}  // namespace ols::ctl
