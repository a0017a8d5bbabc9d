#include "tools/exporter/alarm_metrics.h"

#include <set>

namespace ols::exporter {

void add_alarms(MetricCollection& all, const std::string& program, const std::string& station,
                const std::vector<Alarm>& alarms) {
  std::set<std::string> told;  // each sample may appear only once
  for (const Alarm& alarm : alarms) {
    const AlarmRow& row = alarm.row();
    if (!told.insert(alarm.gist()).second) continue;
    all.gauge("ols_alarm", "1 for each alarm that holds, with its row of the table of conditions.",
              {{"program", program},
               {"station", station},
               {"alarm", alarm.id},
               {"severity", std::string(row.severity)},
               {"says", alarm.gist()},
               {"action", std::string(row.action)}},
              1.0);
  }
}

}  // namespace ols::exporter
