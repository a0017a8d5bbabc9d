#include "console/client_message.h"

#include <gtest/gtest.h>

#include "geometry/angles.h"

namespace ols::console {
namespace {

std::string refusal(const std::string& text) {
  const ClientMessage message = parse_client_message(text);
  const auto* refused = std::get_if<Refused>(&message);
  return refused ? refused->why : "taken";
}

TEST(ClientMessage, ABoxOnAFrameIsADesignation) {
  const auto message =
      parse_client_message(R"({"do":"command","number":7,"station":"alfa","command":"designate",)"
                           R"("frame_utime_us":1700000000123456,"box_px":[10.5,20,30,40]})");
  const auto& request = std::get<CommandRequest>(message);
  EXPECT_EQ(request.number, 7);
  EXPECT_EQ(request.order.kind, wire::Kind::kDesignate);
  EXPECT_EQ(request.order.station, "alfa");
  EXPECT_EQ(request.order.frame_utime_us, 1700000000123456);
  EXPECT_EQ(request.order.x_px, 10.5);
  EXPECT_EQ(request.order.height_px, 40.0);
}

TEST(ClientMessage, AnglesAreDegreesAsThePtuCountsThem) {
  const auto message = parse_client_message(
      R"({"do":"command","station":"alfa","command":"point","pan_deg":90,"tilt_deg":-10})");
  const auto& order = std::get<CommandRequest>(message).order;
  EXPECT_NEAR(order.pan_rad, kPi / 2, 1e-12);
  EXPECT_NEAR(order.tilt_rad, radians(-10), 1e-12);
}

TEST(ClientMessage, AStationIsPointedAtAPlaceToo) {
  const std::string point = R"({"do":"command","station":"alfa","command":"point",)";
  const auto message =
      parse_client_message(point + R"("latitude_deg":49.2,"longitude_deg":-16.6,"height_m":380})");
  const auto& place = std::get<CommandRequest>(message).place;
  ASSERT_TRUE(place);
  EXPECT_NEAR(place->latitude_rad, radians(49.2), 1e-12);
  EXPECT_NEAR(place->longitude_rad, radians(-16.6), 1e-12);
  EXPECT_EQ(place->height_m, 380.0);
  for (const char* wrong : {R"("latitude_deg":91,"longitude_deg":0,"height_m":0})",
                            R"("latitude_deg":49,"longitude_deg":0})",
                            R"("latitude_deg":49,"longitude_deg":0,"height_m":0,"pan_deg":1})"}) {
    EXPECT_NE(refusal(point + wrong), "taken") << wrong;
  }
}

TEST(ClientMessage, ATargetIsGivenANameThatIsSafeToShow) {
  const auto message =
      parse_client_message(R"({"do":"name","number":3,"target":"7","name":"gr\u00fcne\n Drohne"})");
  const auto& request = std::get<NameRequest>(message);
  EXPECT_EQ(request.target, "7");
  EXPECT_EQ(request.name, "gr\u00fcne? Drohne");
  EXPECT_NE(refusal(R"({"do":"name","target":"7"})"), "taken");
  EXPECT_NE(refusal(R"({"do":"name","target":"7","name":")" + std::string(41, 'x') + "\"}"),
            "taken");
}

TEST(ClientMessage, ARateSaysWhatTheBrowserHeardLast) {
  const std::string rate =
      R"({"do":"command","station":"alfa","command":"rate","pan_deg_s":10,"tilt_deg_s":-1)";
  const auto message = parse_client_message(rate + R"(,"heard_us":1700000000000000})");
  const auto& request = std::get<CommandRequest>(message);
  EXPECT_NEAR(request.order.pan_rate_rad_s, radians(10.0), 1e-12);
  EXPECT_NEAR(request.order.tilt_rate_rad_s, radians(-1.0), 1e-12);
  EXPECT_EQ(request.heard_utime_us, 1700000000000000);
  EXPECT_EQ(refusal(rate + "}"), "heard_us is missing");
  EXPECT_EQ(refusal(rate + R"(,"heard_us":1.5})"), "heard_us must be a whole number");
}

TEST(ClientMessage, AnyCommandMaySayWhatTheBrowserHeardLast) {
  const std::string release = R"({"do":"command","station":"alfa","command":"release")";
  EXPECT_EQ(std::get<CommandRequest>(parse_client_message(release + "}")).heard_utime_us,
            std::nullopt);
  const auto message = parse_client_message(release + R"(,"heard_us":17})");
  EXPECT_EQ(std::get<CommandRequest>(message).heard_utime_us, 17);
  EXPECT_EQ(refusal(release + R"(,"heard_us":"now"})"), "heard_us must be a whole number");
  EXPECT_EQ(refusal(release + R"(,"box_px":[1,2,3,4]})"), "unknown key \"box_px\"");
}

TEST(ClientMessage, ALensIsMovedByPositionOrByRate) {
  const std::string head = R"({"do":"command","station":"o","command":"lens","is_rate":)";
  const auto position = parse_client_message(head + R"(false,"zoom":0.5})");
  const auto& order = std::get<CommandRequest>(position).order;
  EXPECT_FALSE(order.lens_rates);
  EXPECT_EQ(order.zoom, 0.5);
  EXPECT_NE(order.focus, order.focus) << "not named";
  const auto rate = parse_client_message(head + R"(true,"zoom":-1,"heard_us":17})");
  EXPECT_TRUE(std::get<CommandRequest>(rate).order.lens_rates);
  EXPECT_EQ(refusal(head + R"(false,"zoom":-1})"), "zoom must be within 0.0 and 1.0");
  EXPECT_EQ(refusal(head + R"(true,"zoom":-1})"), "heard_us is missing");
  EXPECT_EQ(refusal(head + R"(1,"zoom":0})"), "is_rate must be true or false");
}

TEST(ClientMessage, APointIsCentredOrLookedAt) {
  const auto message = parse_client_message(
      R"({"do":"command","station":"o","command":"look","point_px":[10,20.5],"frame_utime_us":5})");
  const auto& order = std::get<CommandRequest>(message).order;
  EXPECT_EQ(order.kind, wire::Kind::kLook);
  EXPECT_EQ(order.x_px, 10.0);
  EXPECT_EQ(order.y_px, 20.5);
  EXPECT_EQ(order.width_px, 0.0);
  EXPECT_EQ(order.frame_utime_us, 5);
  EXPECT_EQ(refusal(R"({"do":"command","station":"o","command":"centre","point_px":[10]})"),
            "point_px must be [x, y]");
}

TEST(ClientMessage, TheOthers) {
  EXPECT_EQ(
      std::get<StopAllRequest>(parse_client_message(R"({"do":"stop_all","number":3})")).number, 3);
  EXPECT_TRUE(
      std::get<ControlRequest>(parse_client_message(R"({"do":"take","station":"a"})")).take);
  EXPECT_FALSE(
      std::get<ControlRequest>(parse_client_message(R"({"do":"give_up","station":"a"})")).take);
  EXPECT_EQ(std::get<WatchRequest>(parse_client_message(R"({"do":"watch","pictures":["a","b"]})"))
                .stations.size(),
            2U);
  EXPECT_EQ(
      std::get<WatchRequest>(parse_client_message(R"({"do":"watch","pictures":[],"codec":"h264"})"))
          .codec,
      Codec::kH264);
  EXPECT_EQ(refusal(R"({"do":"watch","pictures":[],"codec":"av1"})"), "codec must be jpeg or h264");
  EXPECT_EQ(
      std::get<CommandRequest>(
          parse_client_message(R"({"do":"command","station":"a","command":"record","before_s":5,)"
                               R"("after_s":1,"label":"bird"})"))
          .order.label,
      "bird");
}

TEST(ClientMessage, AreasAndVerdicts) {
  const auto set = parse_client_message(R"({"do":"area","number":2,"area":{"name":"Gate"}})");
  EXPECT_EQ(std::get<AreaRequest>(set).change.area.at("name"), "Gate");
  const auto removed = parse_client_message(R"({"do":"remove_area","name":"North gate"})");
  EXPECT_TRUE(std::get<AreaRequest>(removed).change.area.is_null());
  EXPECT_EQ(std::get<AreaRequest>(removed).change.name, "North gate");
  const auto judged = parse_client_message(R"({"do":"judge","incident":3,"verdict":"dismissed"})");
  EXPECT_EQ(std::get<JudgeRequest>(judged).judgement.incident, 3U);
  EXPECT_EQ(std::get<JudgeRequest>(judged).judgement.verdict, Judgement::kDismissed);
  EXPECT_EQ(refusal(R"({"do":"area","area":[]})"), "area must be an object");
  EXPECT_EQ(refusal(R"({"do":"judge","incident":3,"verdict":"guilty"})"),
            "verdict must be open, confirmed or dismissed");
}

TEST(ClientMessage, SaysWhatItHasTaken) {
  const auto taken = std::get<TakenRequest>(
      parse_client_message(R"({"do":"taken","pictures":["alfa"],"state":true})"));
  EXPECT_EQ(taken.stations, std::vector<std::string>{"alfa"});
  EXPECT_TRUE(taken.state);
  EXPECT_EQ(refusal(R"({"do":"taken","pictures":[]})"), "state is missing");
  EXPECT_EQ(refusal(R"({"do":"taken","pictures":[],"state":1})"), "state must be true or false");
}

TEST(ClientMessage, WhatIsWrongIsSaid) {
  EXPECT_EQ(refusal("{"), "not JSON");
  EXPECT_EQ(refusal("[]"), "not a JSON object");
  EXPECT_EQ(refusal("{}"), "do is missing");
  EXPECT_EQ(
      refusal(R"({"do":"dance"})"),
      "do must be command, stop_all, take, give_up, watch, taken, answer, cue, handover, name, "
      "acknowledge, area, remove_area, judge or replay");
  EXPECT_EQ(refusal(R"({"do":"stop_all","station":"a"})"), "unknown key \"station\"");
  EXPECT_EQ(refusal(R"({"do":"command","station":"a","command":"fly"})"), "unknown command");
  EXPECT_EQ(refusal(R"({"do":"command","station":"a b","command":"stop"})"),
            "station must be 1 to 64 printable characters without spaces");
  EXPECT_EQ(refusal(R"({"do":"command","station":"a","command":"designate","box_px":[1,2,3]})"),
            "box_px must be [x, y, width, height]");
  EXPECT_EQ(refusal(R"({"do":"command","station":"a","command":"designate","box_px":[1,2,0,4]})"),
            "box_px must be within 0.5 and 100000.0");
  EXPECT_EQ(refusal(R"({"do":"command","station":"a","command":"point","pan_deg":400,)"
                    R"("tilt_deg":0})"),
            "pan_deg must be within -360.0 and 360.0");
  EXPECT_EQ(refusal(R"({"do":"stop_all","number":-1})"), "number must be a whole number");
  EXPECT_EQ(refusal(std::string(kMostMessageBytes + 1, ' ')), "the message is too long");
}

TEST(ClientMessage, ARefusalKeepsTheNumber) {
  EXPECT_EQ(std::get<Refused>(parse_client_message(R"({"do":"dance","number":9})")).number, 9);
}

TEST(ClientMessage, AReplayIsToldWhereToGoAndHowFast) {
  const auto parsed = parse_client_message(
      R"({"do":"replay","number":4,"at_us":1700000000000000,"playing":false,"speed":2.5})");
  const auto& request = std::get<ReplayRequest>(parsed);
  EXPECT_EQ(request.number, 4);
  EXPECT_EQ(request.at_us, 1'700'000'000'000'000);
  EXPECT_EQ(request.playing, false);
  EXPECT_EQ(request.speed, 2.5);
  EXPECT_FALSE(
      std::get<ReplayRequest>(parse_client_message(R"({"do":"replay","number":4})")).at_us);
  for (const char* text :
       {R"({"do":"replay","number":4,"speed":1000})", R"({"do":"replay","number":4,"playing":1})",
        R"({"do":"replay","number":4,"at_us":"now"})", R"({"do":"replay","number":4,"at":5})"}) {
    EXPECT_TRUE(std::holds_alternative<Refused>(parse_client_message(text))) << text;
  }
}

TEST(ClientMessage, TheHandOversModeIsOneOfThree) {
  const auto message = parse_client_message(R"({"do":"handover","number":4,"mode":"propose"})");
  const auto* request = std::get_if<CueRequest>(&message);
  ASSERT_NE(request, nullptr);
  EXPECT_EQ(request->order.handover, "propose");
  EXPECT_TRUE(request->order.allow) << "must come in time";
  for (const char* wrong : {R"({"do":"handover"})", R"({"do":"handover","mode":"on"})",
                            R"({"do":"handover","mode":true})"}) {
    EXPECT_TRUE(std::holds_alternative<Refused>(parse_client_message(wrong))) << wrong;
  }
}

TEST(ClientMessage, AWordOnACue) {
  const auto message =
      parse_client_message(R"({"do":"cue","number":4,"cue":"tak.A B","allow":true})");
  const auto& request = std::get<CueRequest>(message);
  EXPECT_EQ(request.number, 4);
  EXPECT_EQ(request.order.cue, "tak.A B");
  EXPECT_TRUE(request.order.allow);
  for (const char* bad :
       {R"({"do":"cue","cue":"a"})", R"({"do":"cue","allow":true})",
        R"({"do":"cue","cue":7,"allow":true})", R"({"do":"cue","cue":"a","allow":1})",
        R"({"do":"cue","cue":"a","allow":true,"station":"alfa"})"}) {
    EXPECT_TRUE(std::holds_alternative<Refused>(parse_client_message(bad))) << bad;
  }
  const std::string longest(101, 'x');
  EXPECT_TRUE(std::holds_alternative<Refused>(
      parse_client_message(R"({"do":"cue","allow":true,"cue":")" + longest + "\"}")));
}

TEST(ClientMessage, AnAnswerToAProcedure) {
  const auto message = parse_client_message(
      R"({"do":"answer","number":4,"station":"alfa","question":12,"choice":"point",)"
      R"("pixel_px":[10.5,20]})");
  const auto& request = std::get<AnswerRequest>(message);
  EXPECT_EQ(request.number, 4);
  EXPECT_EQ(request.answer.station, "alfa");
  EXPECT_EQ(request.answer.question, 12);
  EXPECT_EQ(request.answer.choice, "point");
  EXPECT_EQ(request.answer.pixel_px, (std::array{10.5, 20.0}));
  EXPECT_EQ(request.answer.turn_deg, (std::array{0.0, 0.0}));
  const std::string head = R"({"do":"answer","station":"alfa","question":1,"choice":"turn")";
  const auto turn = parse_client_message(head + R"(,"turn_deg":[-3,0.5]})");
  EXPECT_EQ(std::get<AnswerRequest>(turn).answer.turn_deg, (std::array{-3.0, 0.5}));
  EXPECT_FALSE(std::get<AnswerRequest>(turn).answer.pixel_px);
  for (const char* bad : {R"(,"turn_deg":[400,0]})", R"(,"turn_deg":[1]})", R"(,"pixel_px":"1,2"})",
                          R"(,"pixel_px":[1e9,2]})", R"(,"boot":1})"}) {
    EXPECT_TRUE(std::holds_alternative<Refused>(parse_client_message(head + bad))) << bad;
  }
}

}  // namespace
}  // namespace ols::console
