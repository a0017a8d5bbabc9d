#include "console/messages_procedure.h"

#include <gtest/gtest.h>

#include <limits>

#include "ols_msg/procedure_answer_t.hpp"
#include "ols_msg/procedure_t.hpp"
#include "tests/unit/on_the_bus.h"

namespace ols::console {
namespace {

using M = ols_msg::procedure_t;

M asking() {
  auto message = made<M>();
  message.station = "alfa";
  message.procedure = "field";
  message.state = M::STATE_ASKING;
  message.step = "spire: where is it?";
  message.progress = std::numeric_limits<double>::quiet_NaN();
  message.elapsed_s = 12.7;
  message.question = 5;
  message.text = "Point at spire.\nOr turn\x1b[2J the unit.";
  message.choices = 2;
  message.choice = {"point", "skip"};
  message.has_crosshair = 1;
  message.crosshair_px[0] = 10.5;
  message.crosshair_px[1] = 20.25;
  message.full_width_px = 640;
  message.full_height_px = 480;
  message.jpeg_bytes = 3;
  message.jpeg = {1, 2, 3};
  return message;
}

TEST(ProcedureMessages, AQuestionInPlainTextWithItsPicture) {
  const auto heard = procedure_from(on("OLS_PROCEDURE_alfa", asking()));
  ASSERT_TRUE(heard);
  EXPECT_EQ(heard->question, 5);
  EXPECT_EQ(heard->choices, (std::vector<std::string>{"point", "skip"}));
  EXPECT_EQ(heard->jpeg, std::string("\1\2\3"));
  EXPECT_EQ(heard->fields.at("state"), "asking");
  EXPECT_EQ(heard->fields.at("lines"), (Json{"Point at spire.", "Or turn?[2J the unit."}));
  EXPECT_TRUE(heard->fields.at("progress").is_null());
  EXPECT_EQ(heard->fields.at("elapsed_s"), 12.0);
  EXPECT_EQ(heard->fields.at("crosshair_px"), (Json{10.5, 20.25}));
  EXPECT_EQ(heard->fields.at("full_px"), (Json{640, 480}));
  EXPECT_FALSE(procedure_from(on("OLS_PROCEDURE_bravo", asking()))) << "of another station";
}

TEST(ProcedureMessages, OnlyAskingHasAQuestion) {
  M at_work = asking();
  at_work.state = M::STATE_RUNNING;
  at_work.has_crosshair = 0;
  at_work.full_width_px = 0;
  const auto heard = procedure_from(on("OLS_PROCEDURE_alfa", at_work));
  ASSERT_TRUE(heard);
  EXPECT_EQ(heard->question, 0);
  EXPECT_TRUE(heard->fields.at("crosshair_px").is_null());
  EXPECT_TRUE(heard->jpeg.empty()) << "a picture without a size";
  at_work.schema_version = 99;
  EXPECT_FALSE(procedure_from(on("OLS_PROCEDURE_alfa", at_work)));
}

TEST(ProcedureMessages, AnAnswerIsAddressedAndNumbered) {
  LcmBus bus("memq://");
  std::vector<ols_msg::procedure_answer_t> heard;
  bus.subscribe("OLS_PROCEDURE_ANSWER_alfa", [&](const BusMessage& message) {
    ASSERT_TRUE(decode_exactly(message, heard.emplace_back()));
  });
  AnswerSender sender(77);
  EXPECT_TRUE(sender.send(bus, {"alfa", 5, "point", std::array{1.5, 2.5}, {}}, 1000));
  EXPECT_TRUE(sender.send(bus, {"alfa", 6, "turn", {}, {3.0, -4.0}}, 2000));
  while (bus.handle(0) > 0) {
  }
  ASSERT_EQ(heard.size(), 2U);
  EXPECT_EQ(heard[0].boot_id, 77);
  EXPECT_EQ(heard[0].question, 5);
  EXPECT_TRUE(heard[0].has_pixel);
  EXPECT_EQ(heard[0].pixel_px[1], 2.5);
  EXPECT_GT(heard[0].lease_s, 0.0);
  EXPECT_EQ(heard[1].sequence, heard[0].sequence + 1);
  EXPECT_FALSE(heard[1].has_pixel);
  EXPECT_EQ(heard[1].turn_deg[1], -4.0);
  EXPECT_EQ(heard[1].utime, 2000);
}

}  // namespace
}  // namespace ols::console
