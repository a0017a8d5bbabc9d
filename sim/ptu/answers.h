// The simulated PTU's answers to queries: texts from the PTU-D46's manual and from transcripts of
// real units.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "sim/ptu/motion.h"
#include "sim/ptu/setup.h"

namespace ols::sim {

class PtuAnswers {
 public:
  // `setup` and `motion` must outlive this object.
  PtuAnswers(const PtuUnitConfig& config, const PtuSetup& setup, const PtuMotion& motion)
      : config_(config), setup_(setup), motion_(motion) {}

  // The value of one axis as a bare number. `what`: the query's second letter, one of PORNXSDABUL.
  std::string number(int axis, char what, double time_s) const;
  // The same value as an answer, with the selected verbosity.
  std::string query(int axis, char what, double time_s) const;

  // The answer to an identification query; nullopt: the command is not one.
  std::optional<std::string> information(std::string_view command) const;
  // The unit's output at power-up, before it is ready.
  std::string banner() const;
  // Whether the unit's firmware has the preset commands.
  bool has_presets() const;

 private:
  bool e_series() const { return config_.model == PtuModel::kE46; }
  std::string firmware() const;
  std::string version() const;

  PtuUnitConfig config_;
  const PtuSetup& setup_;
  const PtuMotion& motion_;
};

}  // namespace ols::sim
