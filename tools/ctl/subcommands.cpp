#include "tools/ctl/subcommands.h"

#include <cmath>
#include <sstream>

#include "geometry/angles.h"
#include "geometry/slew_limits.h"

namespace ols::ctl {
namespace {

void require_angle(const char* name, double angle_deg, double limit_deg) {
  if (std::abs(angle_deg) <= limit_deg) return;
  std::ostringstream what;
  what << name << ' ' << angle_deg << " is outside " << -limit_deg << " .. " << limit_deg << " deg";
  throw CLI::ValidationError("manual", what.str());
}

void require_rate(double rate_deg_s) {
  const double limit_deg_s = degrees(kRateLimit_rad_s);
  if (std::abs(rate_deg_s) <= limit_deg_s) return;
  std::ostringstream what;
  what << rate_deg_s << " is outside " << -limit_deg_s << " .. " << limit_deg_s << " deg/s";
  throw CLI::ValidationError("rate", what.str());
}

void add_rate_command(CLI::App& app, Words& words) {
  auto* rate = app.add_subcommand("rate", "Turn the PTU for a while, then halt it");
  rate->add_option("rates", words.rates_deg_s, "PAN TILT [deg/s] as the PTU counts them")
      ->expected(2)
      ->required();
  rate->add_option("--seconds", words.seconds, "How long [s]")->check(CLI::Range(0.1, 3600.0));
  rate->callback([&words] {
    for (const double rate_deg_s : words.rates_deg_s) require_rate(rate_deg_s);
    words.send = [&words](Operator& hand, const std::string& id) {
      return hand.hold_rate({.station = id,
                             .kind = wire::Kind::kRate,
                             .pan_rate_rad_s = radians(words.rates_deg_s[0]),
                             .tilt_rate_rad_s = radians(words.rates_deg_s[1])},
                            words.seconds);
    };
  });
}

void add_lens_command(CLI::App& app, Words& words) {
  auto* lens = app.add_subcommand("lens", "Move a motorised lens to positions");
  const CLI::Range share(0.0, 1.0);
  lens->add_option("--zoom", words.lens.zoom, "0 widest .. 1 longest")->check(share);
  lens->add_option("--focus", words.lens.focus, "0 far .. 1 near")->check(share);
  lens->add_option("--iris", words.lens.iris, "0 closed .. 1 open")->check(share);
  lens->require_option(1, 3);
  lens->callback([&words] {
    words.send = [&words](Operator& hand, const std::string& id) {
      wire::Order order = words.lens;
      order.station = id;
      order.kind = wire::Kind::kLens;
      return hand.give(order);
    };
  });
}

// At a pixel of the newest frame.
void add_point_commands(CLI::App& app, Words& words) {
  const auto at_point = [&](const char* name, const char* help, wire::Kind kind) {
    auto* command = app.add_subcommand(name, help);
    command->add_option("point", words.point, "X Y [px] in the full-resolution frame")
        ->expected(2)
        ->required();
    command->callback([&words, kind] {
      words.send = [&words, kind](Operator& hand, const std::string& id) {
        return hand.give(
            {.station = id, .kind = kind, .x_px = words.point[0], .y_px = words.point[1]});
      };
    });
  };
  at_point("centre", "Turn until a pixel is in the middle of the picture", wire::Kind::kCentre);
  at_point("look",
           "Follow the object at a pixel, and lead the other stations along that line of sight "
           "until they see it",
           wire::Kind::kLook);
}

void add_ptu_commands(CLI::App& app, Words& words) {
  auto* manual = app.add_subcommand("manual", "Point the PTU and stay there");
  manual->add_option("angles", words.angles_deg, "PAN TILT [deg] as the PTU counts them")
      ->expected(2)
      ->required();
  manual->callback([&words] {
    require_angle("PAN", words.angles_deg[0], degrees(kPointPanLimit_rad));
    require_angle("TILT", words.angles_deg[1], degrees(kPointTiltLimit_rad));
    words.send = [&words](Operator& hand, const std::string& id) {
      return hand.give({.station = id,
                        .kind = wire::Kind::kPoint,
                        .pan_rad = radians(words.angles_deg[0]),
                        .tilt_rad = radians(words.angles_deg[1])});
    };
  });
  const auto simple = [&](const char* name, const char* help, wire::Kind kind) {
    app.add_subcommand(name, help)->callback([&words, kind] {
      words.send = [kind](Operator& hand, const std::string& id) {
        return hand.give({.station = id, .kind = kind});
      };
    });
  };
  app.add_subcommand("stop", "Halt the PTU; it stays stopped until the next command")
      ->callback([&words] { words.stop = true; });
  simple("release", "Give the PTU back to automatic control", wire::Kind::kRelease);
  simple(
      "rearm",
      "End the emergency after the stop button is released; the PTU stays stopped. Only where the "
      "site permits it remotely",
      wire::Kind::kRearm);
  simple("home", "Home the PTU: it sweeps its whole travel, clear the way first",
         wire::Kind::kHome);
  simple("reference-ok", "Confirm the PTU's angles, after checking them or homing by hand",
         wire::Kind::kReferenceOk);
}

// Commands to the fusion, not to a station.
void add_cue_commands(CLI::App& app, Words& words) {
  const auto of_fusion = [&words](const char* name) {
    words.cues = true;
    if (words.station == "fusion") return;
    throw CLI::ValidationError(name, "is for the fusion: ols-ctl fusion " + std::string(name));
  };
  app.add_subcommand("cues",
                     "Show cues from outside, and targets found by detection (ols-ctl fusion cues)")
      ->callback([of_fusion] { of_fusion("cues"); });
  const auto word = [&](const char* name, const char* help, bool allow) {
    auto* command = app.add_subcommand(name, help);
    command->add_option("cue", words.label, "Its name or number, as shown by cues")->required();
    command->callback([&words, of_fusion, name, allow] {
      of_fusion(name);
      words.cue_order = wire::CueOrder{words.label, allow};
    });
  };
  word("allow", "Let stations be led to a cue or target (ols-ctl fusion allow CUE)", true);
  word("forbid", "Let no station be led to a cue or target any more", false);
  auto* handover = app.add_subcommand("handover",
                                      "Which targets of detections lead stations, until the fusion "
                                      "restarts (ols-ctl fusion handover MODE)");
  handover->add_option("mode", words.label, "off, propose or automatic")
      ->required()
      ->check(CLI::IsMember({"off", "propose", "automatic"}));
  handover->callback([&words, of_fusion] {
    of_fusion("handover");
    words.cue_order = wire::CueOrder{.cue = "hand-over", .handover = words.label};
  });
}

void add_other_commands(CLI::App& app, Words& words) {
  auto* designate = app.add_subcommand("designate", "Follow the object in this box of the image");
  designate
      ->add_option("box", words.box, "X,Y,W,H [px], top-left corner, newest full-resolution frame")
      ->delimiter(',')
      ->expected(4)
      ->required();
  designate->callback([&words] {
    words.send = [&words](Operator& hand, const std::string& id) {
      return hand.give({.station = id,
                        .kind = wire::Kind::kDesignate,
                        .x_px = words.box[0],
                        .y_px = words.box[1],
                        .width_px = words.box[2],
                        .height_px = words.box[3]});
    };
  });
  auto* record =
      app.add_subcommand("record", "Save the raw frames around now on the station's disk");
  record->add_option("before", words.before_s, "Before now [s], as far as in memory")->required();
  record->add_option("after", words.after_s, "After now [s]")->required();
  record->add_option("label", words.label, "Part of the folder's name: letters, digits, - and _")
      ->required();
  record->callback([&words] {
    words.send = [&words](Operator& hand, const std::string& id) {
      return hand.give({.station = id,
                        .kind = wire::Kind::kRecord,
                        .before_s = words.before_s,
                        .after_s = words.after_s,
                        .label = words.label});
    };
  });
  auto* status = app.add_subcommand("status", "Show the state");
  status->add_flag_callback(
      "--full", [&words] { words.look = Look::kFull; }, "Devices, alarms, readings and counters");
  app.add_subcommand("fleet", "Calibration, clock, disk, temperature and newest alarm of each")
      ->callback([&words] { words.look = Look::kFleet; });
}

}  // namespace

void add_subcommands(CLI::App& app, Words& words) {
  app.require_subcommand(1);
  add_ptu_commands(app, words);
  add_rate_command(app, words);
  add_lens_command(app, words);
  add_point_commands(app, words);
  add_other_commands(app, words);
  add_cue_commands(app, words);
}

}  // namespace ols::ctl
