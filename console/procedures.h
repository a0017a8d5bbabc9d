// The stations' guided procedures, such as calibrations, for browsers. A procedure's fields are
// part of the site's state; a browser fetches its picture separately. A person's answer is checked
// against the current question. Pure.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "conditions/refusal.h"
#include "console/entity_table.h"

namespace ols::console {

struct ReceivedProcedure {
  std::string station;
  Json fields;                       // listed in docs/console.md
  std::int64_t question = 0;         // number of the question; 0: none
  std::vector<std::string> choices;  // the answers that the question allows
  std::string jpeg;                  // empty: no picture
  bool is_at_work = true;            // false: the procedure has ended
};

struct ProcedureAnswer {
  std::string station;
  std::int64_t question = 0;
  std::string choice;
  std::optional<std::array<double, 2>> pixel_px;  // in pixels of the full frame
  std::array<double, 2> turn_deg{};               // for the choice "turn": pan, tilt
};

class Procedures {
 public:
  // Takes a message. Returns the procedure's part of the site's state: its fields and `picture`, a
  // number that changes with each new picture; 0: there is no picture.
  Json receive(ReceivedProcedure heard);
  // The newest picture (JPEG) of a station's procedure; null: there is none.
  const std::string* picture(const std::string& station) const;

  bool has(const std::string& station) const { return kept_.contains(station); }
  // Takes a person's answer. Returns why it is refused; empty: it will be sent. The answer "abort",
  // which ends the procedure, is accepted whatever the question is.
  Outcome answer(const ProcedureAnswer& answer);
  // The answers to send now.
  std::vector<ProcedureAnswer> take() { return std::exchange(answers_, {}); }

  void keep_only(const std::function<bool(const std::string&)>& is_known);

 private:
  struct Kept {
    ReceivedProcedure heard;
    std::uint64_t picture = 0;
  };
  std::map<std::string, Kept> kept_;
  std::uint64_t pictures_ = 0;
  std::vector<ProcedureAnswer> answers_;
};

}  // namespace ols::console
