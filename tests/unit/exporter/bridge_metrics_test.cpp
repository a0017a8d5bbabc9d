#include "tools/exporter/bridge_metrics.h"

#include <gtest/gtest.h>
#include <prometheus/text_serializer.h>

#include "bridge/status.h"

namespace ols::exporter {
namespace {

constexpr std::int64_t kNow_us = 1'700'000'000'000'000;

std::string text(const std::string& status, std::int64_t utime_us = kNow_us) {
  return prometheus::TextSerializer().Serialize(bridge_metrics(status, utime_us));
}

bool has_line(const std::string& text, const std::string& line) {
  return ("\n" + text).find("\n" + line + "\n") != std::string::npos;
}

// As the bridge itself writes it.
bridge::BridgeStatus status_of_bridge() {
  bridge::BridgeStatus status;
  status.utime_us = kNow_us - 1'000'000;
  status.stations = 3;
  status.link.is_open = true;
  status.link.losses = 2;
  status.link.unsent = 4;
  status.out.passed = 120;
  status.in.passed = 7;
  status.in.refused[static_cast<std::size_t>(bridge::Refusal::kStale)] = 5;
  status.missing = 6;
  status.unsent_to_bus = 8;
  status.ownership.owned = 9;
  status.ownership.others = 10;
  status.ownership.epoch = 77;
  status.obeyed_epoch = 78;
  return status;
}

TEST(BridgeMetrics, TellLinkMessagesRefusalsAndEpochs) {
  const std::string told = text(to_json(status_of_bridge()));
  for (const char* line :
       {"ols_bridge_up 1", "ols_bridge_stations 3", "ols_bridge_link_up 1",
        "ols_bridge_link_losses_total 2", "ols_bridge_messages_total{direction=\"out\"} 120",
        "ols_bridge_messages_total{direction=\"in\"} 7",
        "ols_bridge_refused_total{direction=\"in\",reason=\"stale\"} 5",
        "ols_bridge_refused_total{direction=\"out\",reason=\"stale\"} 0",
        "ols_bridge_missing_total 6", "ols_bridge_unsent_total{to=\"network\"} 4",
        "ols_bridge_unsent_total{to=\"bus\"} 8", "ols_bridge_owners_confirmed 1",
        "ols_bridge_targets{owner=\"own\"} 9", "ols_bridge_targets{owner=\"other\"} 10",
        "ols_bridge_owner_epoch{of=\"own\"} 77", "ols_bridge_owner_epoch{of=\"obeyed\"} 78"}) {
    EXPECT_TRUE(has_line(told, line)) << line << "\n" << told;
  }
}

TEST(BridgeMetrics, AnAlarmOfTheBridgeIsCounted) {
  bridge::BridgeStatus status = status_of_bridge();
  status.link.is_open = false;
  const std::string told = text(to_json(status));
  EXPECT_NE(told.find("alarm=\"bridge_no_server\""), std::string::npos) << told;
  EXPECT_TRUE(has_line(told, "ols_bridge_link_up 0")) << told;
}

TEST(BridgeMetrics, ABridgeWithoutAPresentStatusDoesNotRun) {
  const std::string status = to_json(status_of_bridge());
  for (const std::string& told :
       {text(""), text("{"), text("[]"), text("{\"utime_us\": 1}"),
        text(status, kNow_us + 10'000'000), text(status, kNow_us - 12'000'000)}) {
    EXPECT_TRUE(has_line(told, "ols_bridge_up 0")) << told;
    EXPECT_EQ(told.find("ols_bridge_messages_total"), std::string::npos) << told;
  }
}

}  // namespace
}  // namespace ols::exporter
