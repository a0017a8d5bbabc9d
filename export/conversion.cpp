#include "export/conversion.h"

#include <stdexcept>

#include "base/bus/log_reader.h"
#include "base/files/atomic_file.h"
#include "base/files/output_check.h"
#include "export/factory.h"
#include "export/fixes.h"
#include "export/present_targets.h"
#include "export/readiness.h"
#include "export/tak/cot_text.h"

namespace ols::exports {
namespace {

// All events of Cursor on Target in one document.
class EventFile : public Encoder {
 public:
  explicit EventFile(const CotSettings& settings) : settings_(settings) {}
  Packets encode(const Target& target) override { return keep(target); }
  Packets encode(const Station& station) override { return keep(station); }
  Packets encode(const Line& line) override { return keep(line); }
  Packets due(std::int64_t) override { return {{"document", cot_document(elements_)}}; }

 private:
  template <class Record>
  Packets keep(const Record& record) {
    elements_ += cot_element(cot_event(record, settings_)) + "\n";
    return {};
  }

  CotSettings settings_;
  std::string elements_;
};

std::unique_ptr<Encoder> encoder_of(Format format, const ExportConfig& config) {
  if (format == Format::kCot) return std::make_unique<EventFile>(config.cot);
  return make_file_encoder(format, config);
}

class Recording {
 public:
  Recording(const GateConfig& gate, Encoder& encoder) : gate_(gate), encoder_(encoder) {}

  void take(const Target& target) {
    for (const Target& told : targets_.take(target)) give(told);
  }
  void take(const Station& station) {
    if (!gate_.passes(station)) return;
    ++report_.stations;
    encoder_.encode(station);
  }
  void take(const Line& line) {
    if (!gate_.passes(line)) return;
    ++report_.lines;
    encoder_.encode(line);
  }
  void end_silent(std::int64_t utime_us) {
    for (const Target& end : targets_.end_silent(utime_us)) give(end);
  }
  ConversionReport& report() { return report_; }

 private:
  void give(const Target& target) {
    const auto told = gate_.pass(target);
    if (!told) return;
    ++report_.targets;
    encoder_.encode(*told);
  }

  Gate gate_;
  Encoder& encoder_;
  PresentTargets targets_;
  ConversionReport report_;
};

void read_log(const std::string& path, const SiteContext& site, Recording& recording,
              const TellSteps& tell) {
  LogReader log(path);
  while (const auto message = log.next()) {
    if (tell) tell(log.offset(), log.size());
    recording.end_silent(message->received_utime_us);
    if (const auto target = target_from(*message, site)) {
      recording.take(*target);
    } else if (const auto station = station_from(*message, site)) {
      recording.take(*station);
    } else if (const auto line = line_from(*message, site)) {
      recording.take(*line);
    } else if (is_read(message->channel) && !is_understood(*message)) {
      log.reject(*message);
    }
  }
  recording.report().damage = log.damage();
}

// An empty or shortened file must not pass for what happened.
void check(const ConversionReport& report, const Conversion& conversion,
           const ExportConfig& config) {
  const std::string& input = conversion.log.empty() ? conversion.fixes : conversion.log;
  if (!report.damage.empty() && !conversion.skips_damage) {
    throw std::runtime_error(input + ": " + report.damage + ": " + conversion.output +
                             " is not written; --skip-damage leaves out what is damaged");
  }
  if (conversion.format == Format::kCourageous && report.stations + report.lines == 0 &&
      !config.courageous.has_place()) {
    throw std::runtime_error(input +
                             ": names no station, and courageous demands the place of the "
                             "system: state it in [courageous] of the configuration");
  }
  if (report.targets + report.stations + report.lines == 0) {
    throw std::runtime_error(input + ": has no position to write" +
                             (report.damage.empty() ? "" : ": " + report.damage));
  }
}

}  // namespace

ConversionReport convert(const Conversion& conversion, const ExportConfig& config,
                         const GateConfig& gate, const TellSteps& tell) {
  check_outputs({{"--log", conversion.log}, {"--fixes", conversion.fixes}},
                {{"--output", conversion.output}});
  const SiteContext site = site_context(config, {conversion.format});
  const auto encoder = encoder_of(conversion.format, config);
  Recording recording(gate, *encoder);
  if (!conversion.log.empty()) {
    read_log(conversion.log, site, recording, tell);
  } else {
    for (const Target& target : read_fixes(conversion.fixes, site)) recording.take(target);
  }
  check(recording.report(), conversion, config);
  const Packets document = encoder->due(0);
  if (document.empty()) throw std::runtime_error("nothing in the recording is of this format");
  AtomicFile file(conversion.output);
  file.stream() << document.back().bytes;
  file.commit();
  return recording.report();
}

}  // namespace ols::exports
