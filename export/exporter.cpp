#include "export/exporter.h"

#include <cmath>
#include <cstdlib>
#include <utility>

namespace ols::exports {

Exporter::Exporter(SiteContext site, std::vector<std::unique_ptr<Output>> outputs, double max_age_s)
    : site_(std::move(site)),
      outputs_(std::move(outputs)),
      max_age_us_(static_cast<std::int64_t>(1e6 * max_age_s)) {
  for (const char* name :
       {"records_sent_on", "messages_refused", "messages_unused", "records_old"}) {
    counters_[name] = 0.0;
  }
}

template <class Record>
void Exporter::give(const Record& record) {
  ++counters_["records_sent_on"];
  for (const auto& output : outputs_) output->take(record);
}

// In floating point: the difference from an absurd stamp must not overflow.
bool Exporter::is_present(std::int64_t utime_us, std::int64_t now_utime_us) {
  const double off_us = static_cast<double>(utime_us) - static_cast<double>(now_utime_us);
  if (std::abs(off_us) <= static_cast<double>(max_age_us_)) return true;
  ++counters_["records_old"];
  return false;
}

void Exporter::receive(const BusMessage& message, std::int64_t now_utime_us) {
  if (const auto target = target_from(message, site_)) {
    if (!is_present(target->utime_us, now_utime_us)) return;
    for (const Target& told : targets_.take(*target)) give(told);
  } else if (const auto station = station_from(message, site_)) {
    if (is_present(station->utime_us, now_utime_us)) give(*station);
  } else if (const auto line = line_from(message, site_)) {
    if (is_present(line->utime_us, now_utime_us)) give(*line);
  } else if (const auto incident = incident_from(message, site_)) {
    if (is_present(incident->utime_us, now_utime_us)) give(*incident);
  } else {
    ++counters_[is_understood(message) ? "messages_unused" : "messages_refused"];
  }
}

void Exporter::step(double now_s, std::int64_t utime_us) {
  for (const Target& end : targets_.end_silent(utime_us)) give(end);
  for (const auto& output : outputs_) output->step(now_s, utime_us);
}

}  // namespace ols::exports
