#include "export/exporter.h"

#include <gtest/gtest.h>

#include "tests/unit/export/made_messages.h"

namespace ols::exports {
namespace {

// Says what it was given.
class MadeEncoder : public Encoder {
 public:
  Packets encode(const Target& target) override {
    return {{target.uid, target.state == TrackState::kEnded ? "end" : "target"}};
  }
  Packets encode(const Station&) override { return {{"", "station"}}; }
  Packets encode(const Line&) override { return {{"", "line"}}; }
  Packets encode_incident(const Incident&) override { return {{"", "incident"}}; }
  Packets due(std::int64_t) override { return {{"", "turn"}}; }
  void begin_again() override { ++beginnings; }

  int beginnings = 0;
};

struct Got {
  std::vector<std::string> bytes;
  std::uint64_t openings = 1;
};

class MadeOutlet : public Outlet {
 public:
  explicit MadeOutlet(Got& got) : got_(got) {}
  void put(Packets packets) override {
    for (const Packet& packet : packets) got_.bytes.push_back(packet.bytes);
  }
  OutletReport report() const override { return {.openings = got_.openings}; }

 private:
  Got& got_;
};

struct Made {
  Got got;
  MadeEncoder* encoder = new MadeEncoder;
  Exporter exporter{{"brno"}, outputs(), 5.0};

  std::vector<std::unique_ptr<Output>> outputs() {
    std::vector<std::unique_ptr<Output>> made;
    made.push_back(std::make_unique<Output>("made", GateConfig{.lines = true}, 1.0,
                                            std::unique_ptr<Encoder>(encoder),
                                            std::make_unique<MadeOutlet>(got)));
    return made;
  }
};

using Texts = std::vector<std::string>;

TEST(Exporter, WhatIsHeardGoesToTheOutputs) {
  Made made;
  made.exporter.receive(on("OLS_TARGET", target_message()), kNow_us);
  made.exporter.receive(on("OLS_STATUS_alfa", status_message()), kNow_us);
  made.exporter.receive(on("OLS_BEARING_alfa", bearing_message()), kNow_us);
  made.exporter.receive(on("OLS_INCIDENT", incident_message()), kNow_us);
  EXPECT_EQ(made.got.bytes, (Texts{"target", "station", "line", "incident"}));
  EXPECT_EQ(made.exporter.counters().at("records_sent_on"), 4.0);
}

TEST(Exporter, OldNewsAndRubbishAreCounted) {
  Made made;
  made.exporter.receive(on("OLS_TARGET", target_message()), kNow_us + 5'000'001);
  auto absurd = target_message();
  absurd.utime = std::numeric_limits<std::int64_t>::min();
  made.exporter.receive(on("OLS_TARGET", absurd), kNow_us);
  BusMessage rubbish;
  rubbish.channel = "OLS_TARGET";
  made.exporter.receive(rubbish, kNow_us);
  auto none = target_message();
  none.target_id = 0;
  made.exporter.receive(on("OLS_TARGET", none), kNow_us);
  EXPECT_TRUE(made.got.bytes.empty());
  EXPECT_EQ(made.exporter.counters().at("records_old"), 2.0);
  EXPECT_EQ(made.exporter.counters().at("messages_refused"), 1.0);
  EXPECT_EQ(made.exporter.counters().at("messages_unused"), 1.0);
}

TEST(Exporter, ATargetOfAFusionThatStoppedEnds) {
  Made made;
  made.exporter.receive(on("OLS_TARGET", target_message()), kNow_us);
  made.exporter.step(100.0, kNow_us + 11'000'000);
  EXPECT_EQ(made.got.bytes, (Texts{"target", "end", "turn"}));
  EXPECT_EQ(made.exporter.targets(), 0U);
}

TEST(Exporter, ANewConnectionIsToldEverythingAtOnce) {
  Made made;
  made.exporter.step(100.0, kNow_us);
  made.exporter.step(100.5, kNow_us);
  EXPECT_EQ(made.encoder->beginnings, 1);
  EXPECT_EQ(made.got.bytes, (Texts{"turn"}));
  made.got.openings = 2;
  made.exporter.step(100.6, kNow_us);
  EXPECT_EQ(made.encoder->beginnings, 2);
  EXPECT_EQ(made.got.bytes, (Texts{"turn", "turn"}));
}

}  // namespace
}  // namespace ols::exports
