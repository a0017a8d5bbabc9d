#include "console/console.h"

#include <gtest/gtest.h>

#include "conditions/alarms.h"

namespace ols::console {
namespace {

ReceivedStation station(const std::string& id, bool stopped = false) {
  ReceivedStation heard;
  heard.id = id;
  heard.fields = {{"state", "tracking"}};
  heard.is_stopped = stopped;
  return heard;
}

// What a station says to the console's order of this number.
wire::Reply stands(const std::string& id, std::int64_t sequence) {
  return {.station = id, .order = {0, sequence}, .is_accepted = true, .is_stopped = true};
}

// Has heard alfa.
struct Listening : Console {
  Listening() : Console(60.0) { receive(station("alfa"), {0.0, 0}); }
};

// All that a viewer is sent now.
std::vector<Json> received(Console& console, std::uint64_t viewer, const Now& now) {
  std::vector<Json> messages;
  while (auto next = console.next(viewer, now)) {
    messages.push_back(next->is_binary ? Json(next->bytes.size()) : Json::parse(next->bytes));
  }
  return messages;
}

Json answer_in(const std::vector<Json>& messages) {
  for (const Json& message : messages) {
    if (message.is_object() && message.at("kind") == "answer") return message;
  }
  return nullptr;
}

TEST(Console, GreetsThenSendsASnapshotThenDeltasAtTwentyHertz) {
  Listening console;
  const auto viewer = console.open("ana", Role::kOperator);
  const auto first = received(console, viewer, {1.0, 5});
  ASSERT_EQ(first.size(), 2U);
  EXPECT_EQ(first[0].at("kind"), "hello");
  EXPECT_EQ(first[0].at("role"), "operator");
  EXPECT_EQ(first[1].at("kind"), "snapshot");
  console.receive_bearing("alfa", {{"azimuth_deg", 1.0}});
  EXPECT_TRUE(received(console, viewer, {1.04, 5}).empty());
  const auto second = received(console, viewer, {1.1, 5});
  ASSERT_EQ(second.size(), 1U);
  EXPECT_EQ(second[0].at("kind"), "delta");
  EXPECT_TRUE(received(console, viewer, {1.5, 5}).empty()) << "nothing new";
  EXPECT_EQ(received(console, viewer, {2.2, 5}).size(), 1U) << "a sign of life each second";
}

TEST(Console, ASlowViewerGetsTheNewestNotAQueue) {
  Listening console;
  const auto viewer = console.open("ana", Role::kViewer);
  static_cast<void>(received(console, viewer, {0.0, 0}));
  for (int i = 1; i <= 1000; ++i) console.receive_bearing("alfa", {{"azimuth_deg", i}});
  const auto messages = received(console, viewer, {60.0, 0});
  ASSERT_EQ(messages.size(), 1U);
  EXPECT_EQ(messages[0].at("stations")[0].at("bearing").at("azimuth_deg"), 1000);
}

TEST(Console, OnlyTheNewestPictureThatIsWatchedIsSent) {
  Listening console;
  console.receive(station("bravo"), {0.0, 0});
  const auto viewer = console.open("ana", Role::kViewer);
  static_cast<void>(received(console, viewer, {0.0, 0}));
  for (const char* id : {"alfa", "alfa", "bravo", "unknown"}) {
    console.receive(Picture{id, {{"station", id}}, "JPEG"});
  }
  EXPECT_TRUE(received(console, viewer, {0.01, 0}).empty());
  console.take(viewer, R"({"do":"watch","pictures":["alfa","unknown"]})", {0.02, 0});
  const auto next = console.next(viewer, {0.03, 0});
  ASSERT_TRUE(next && next->is_binary);
  EXPECT_EQ(next->bytes.substr(0, 4), std::string("\0\0\0\x12", 4)) << "the header's length";
  EXPECT_EQ(next->bytes.substr(4), "{\"station\":\"alfa\"}JPEG");
  EXPECT_FALSE(console.next(viewer, {0.04, 0}));
}

TEST(Console, ABrowserThatSaysWhatItHasTakenIsSentTheNextOnlyThen) {
  Listening console;
  const auto viewer = console.open("ana", Role::kViewer);
  console.take(viewer, R"({"do":"watch","pictures":["alfa"]})", {0.0, 0});
  const auto show = [&](const std::string& jpeg) {
    console.receive(Picture{"alfa", {{"station", "alfa"}}, jpeg});
  };
  show("1");
  EXPECT_EQ(received(console, viewer, {0.0, 0}).size(), 3U) << "greeting, snapshot, picture";
  console.take(viewer, R"({"do":"taken","pictures":["bravo"],"state":false})", {0.0, 0});
  show("2"), show("3");
  console.receive_bearing("alfa", {{"azimuth_deg", 1.0}});
  EXPECT_TRUE(received(console, viewer, {5.0, 0}).empty()) << "both are under way";
  console.take(viewer, R"({"do":"taken","pictures":["alfa"],"state":false})", {5.0, 0});
  const auto picture = console.next(viewer, {5.0, 0});
  ASSERT_TRUE(picture);
  EXPECT_EQ(picture->bytes.back(), '3') << "the newest";
  EXPECT_TRUE(received(console, viewer, {6.0, 0}).empty());
  console.take(viewer, R"({"do":"taken","pictures":[],"state":true})", {6.0, 0});
  const auto state = received(console, viewer, {6.0, 0});
  ASSERT_EQ(state.size(), 1U);
  EXPECT_EQ(state[0].at("stations")[0].at("bearing").at("azimuth_deg"), 1.0);
}

TEST(Console, ACommandIsAnsweredWithTheStationsOwnWord) {
  Listening console;
  const auto viewer = console.open("ana", Role::kOperator);
  console.take(viewer, R"({"do":"command","number":4,"station":"alfa","command":"home"})",
               {1.0, 9});
  ASSERT_EQ(console.turn({1.0, 9}).size(), 1U);
  console.receive({.station = "alfa", .order = {0, 1}, .reason = "keep_out"});
  static_cast<void>(console.turn({1.2, 9}));
  const Json answer = answer_in(received(console, viewer, {1.2, 9}));
  EXPECT_EQ(answer.at("number"), 4);
  EXPECT_EQ(answer.at("why"), "refused: homing would sweep across a keep-out region");
  const Json event = console.state({1.2, 9}).at("events").back();
  EXPECT_EQ(event.at("who"), "ana");
  EXPECT_EQ(event.at("outcome"), "refused: homing would sweep across a keep-out region");
  EXPECT_EQ(event.at("refusal").at("parameters").at("reason"), "keep_out");
  EXPECT_EQ(answer.at("refusal"), event.at("refusal"));
}

TEST(Console, AViewerMayLookAndStopOnly) {
  Listening console;
  const auto viewer = console.open("guest", Role::kViewer);
  console.take(viewer, R"({"do":"command","number":1,"station":"alfa","command":"release"})",
               {0.0, 0});
  console.take(viewer, R"({"do":"take","number":2,"station":"alfa"})", {0.0, 0});
  EXPECT_TRUE(console.turn({0.0, 0}).empty());
  EXPECT_TRUE(console.state({0.0, 0}).at("events").empty()) << "it would push out what happened";
  EXPECT_EQ(answer_in(received(console, viewer, {0.0, 0})).at("why"),
            "refused: a viewer may only look and stop");
  console.take(viewer, R"({"do":"command","number":3,"station":"alfa","command":"stop"})",
               {0.0, 0});
  EXPECT_EQ(console.turn({0.0, 0}).size(), 1U);
}

TEST(Console, OneHolderAStationUntilAnotherTakesOver) {
  Listening console;
  const auto ana = console.open("ana", Role::kOperator);
  const auto ben = console.open("ben", Role::kOperator);
  const std::string release = R"({"do":"command","number":1,"station":"alfa","command":"release"})";
  console.take(ana, release, {0.0, 0});
  static_cast<void>(console.turn({0.0, 0}));
  EXPECT_EQ(console.state({0.0, 0}).at("stations")[0].at("control").at("by"), "ana");
  console.take(ben, release, {0.1, 0});
  EXPECT_TRUE(console.turn({0.1, 0}).empty());
  EXPECT_EQ(answer_in(received(console, ben, {0.1, 0})).at("accepted"), false);
  console.take(ben, R"({"do":"take","station":"alfa"})", {0.2, 0});
  static_cast<void>(console.turn({0.2, 0}));
  EXPECT_EQ(console.state({0.2, 0}).at("stations")[0].at("control").at("by"), "ben");
  console.close(ben);
  static_cast<void>(console.turn({0.3, 0}));
  EXPECT_TRUE(console.state({0.3, 0}).at("stations")[0].at("control").is_null());
}

std::vector<Json> told_of_hands(Console& console, std::uint64_t viewer, const Now& now) {
  auto messages = received(console, viewer, now);
  std::erase_if(messages, [](const Json& m) { return !m.is_object() || m.at("kind") != "hand"; });
  return messages;
}

TEST(Console, TwoBrowsersOfOneNameAreToldApart) {
  Listening console;
  const auto first = console.open("operator", Role::kOperator);
  const auto second = console.open("operator", Role::kOperator);
  EXPECT_EQ(received(console, second, {0.0, 0})[0].at("name"), "operator 2");
  EXPECT_EQ(console.person("operator", second).name, "operator 2");
  EXPECT_EQ(console.person("ana", second).name, "ana") << "not one of hers";
  console.close(first);
  const auto third = console.open("operator", Role::kOperator);
  EXPECT_EQ(received(console, third, {0.0, 0})[0].at("name"), "operator");
}

TEST(Console, WhoHoldsAStationIsToldWhenAnotherStopsItOrTakesItOver) {
  Listening console;
  console.receive(station("bravo"), {0.0, 0});
  const auto ana = console.open("ana", Role::kOperator), ben = console.open("ben", Role::kOperator);
  for (const char* id : {"alfa", "bravo"}) {
    console.take(ana, R"({"do":"take","station":")" + std::string(id) + "\"}", {0.0, 0});
  }
  console.take(ben, R"({"do":"stop_all"})", {0.1, 0});
  static_cast<void>(console.stop_all(console.person("ben", ben), {}, {0.1, 0}));
  console.take(ben, R"({"do":"take","station":"alfa"})", {0.2, 0});
  const auto told = told_of_hands(console, ana, {0.2, 0});
  ASSERT_EQ(told.size(), 2U) << "a stop of all is told once, though it came twice";
  EXPECT_EQ(told[0].at("by"), "ben");
  EXPECT_EQ(told[0].at("stations"), Json::parse(R"(["alfa","bravo"])"));
  EXPECT_EQ(told[1].at("what"), "take");
  EXPECT_TRUE(told_of_hands(console, ben, {0.2, 0}).empty());
}

TEST(Console, WhoHoldsAStationIsToldThatAnotherProgramStoppedItButNotOfTheirOwnStop) {
  Listening console;
  const auto ana = console.open("ana", Role::kOperator);
  console.take(ana, R"({"do":"take","station":"alfa"})", {0.0, 0});
  console.take(ana, R"({"do":"command","station":"alfa","command":"stop"})", {0.1, 0});
  static_cast<void>(console.turn({0.1, 0}));
  console.receive(stands("alfa", 1));
  static_cast<void>(console.turn({0.2, 0}));
  console.receive(station("alfa", true), {0.2, 0});
  EXPECT_TRUE(told_of_hands(console, ana, {0.2, 0}).empty());
  static_cast<void>(console.turn({0.3, 0}));
  console.receive(station("alfa", false), {0.4, 0});
  console.receive(station("alfa", true), {0.5, 0});
  const auto told = told_of_hands(console, ana, {0.5, 0});
  ASSERT_EQ(told.size(), 1U);
  EXPECT_EQ(told[0].at("by"), "");
}

TEST(Console, AnAcknowledgementIsSeenByAllAndGivenByOperatorsOnly) {
  Console console(60.0);
  ReceivedStation ailing = station("alfa");
  ailing.alarms = alarms_of({"camera: does not answer"});
  console.receive(ailing, {0.0, 0});
  const auto ana = console.open("ana", Role::kOperator), vera = console.open("vera", Role::kViewer);
  const std::string text = R"({"do":"acknowledge","number":1,"event":1})";
  console.take(vera, text, {0.1, 0});
  EXPECT_FALSE(answer_in(received(console, vera, {0.1, 0})).at("accepted"));
  EXPECT_EQ(console.state({0.1, 0}).at("events")[0].at("acknowledged"), "");
  console.take(ana, text, {0.2, 0});
  EXPECT_EQ(console.state({0.2, 0}).at("events")[0].at("acknowledged"), "ana");
  console.take(ana, R"({"do":"acknowledge","number":2,"event":7})", {0.3, 0});
  static_cast<void>(received(console, vera, {0.3, 0}));
}

TEST(Console, StopAllStopsEachStationUntilItStandsAndThoseHeardSoonAfter) {
  Console console(60.0);
  console.receive(station("alfa"), {0.0, 0});
  console.receive(station("bravo"), {0.0, 0});
  EXPECT_EQ(console.stop_all({"ana"}, {}, {1.0, 0}), (std::vector<std::string>{"alfa", "bravo"}));
  EXPECT_EQ(console.turn({1.0, 0}).size(), 2U);
  console.receive(stands("alfa", 1));
  console.receive(station("charlie"), {1.1, 0});
  std::vector<std::string> again;
  static_cast<void>(console.turn({1.1, 0}));
  for (const auto& order : console.turn({1.2, 0})) again.push_back(order.station);
  EXPECT_EQ(again, (std::vector<std::string>{"bravo", "charlie"}));
}

TEST(Console, AStopOfAllThatIsNotConfirmedIsToldToEverybody) {
  Listening console;
  console.receive(station("bravo"), {0.0, 0});
  const auto ana = console.open("ana", Role::kOperator), ben = console.open("ben", Role::kViewer);
  static_cast<void>(console.stop_all({"ana"}, {}, {1.0, 0}));
  console.take(ana, R"({"do":"stop_all","number":3})", {1.0, 0});
  EXPECT_EQ(console.turn({1.0, 0}).size(), 2U);
  EXPECT_EQ(console.state({1.0, 0}).at("events").size(), 2U) << "one person's stop is one event";
  console.receive(stands("alfa", 1));
  static_cast<void>(console.turn({2.0, 0}));
  static_cast<void>(console.turn({4.1, 0}));
  for (const auto viewer : {ana, ben}) {
    int told = 0;
    for (const Json& message : received(console, viewer, {4.1, 0})) {
      if (message.at("kind") != "stop_unconfirmed") continue;
      EXPECT_EQ(message.at("stations"), Json::parse(R"(["bravo"])"));
      ++told;
    }
    EXPECT_EQ(told, 1);
  }
}

TEST(Console, AStopWithoutABusSaysSo) {
  Listening console;
  const auto viewer = console.open("ana", Role::kOperator);
  console.bus_is(alarm::no_bus("connecting"));
  console.take(viewer, R"({"do":"stop_all","number":3})", {1.0, 0});
  EXPECT_EQ(answer_in(received(console, viewer, {1.0, 0})).at("why"), "no bus: connecting");
}

// A browser's link was cut during a hold: what it delivers afterwards moves nothing.
TEST(Console, ARateThatWasHeldUpIsRefusedAndAHoldIsOneEvent) {
  Listening console;
  const auto viewer = console.open("ana", Role::kOperator);
  const auto rate = [&](std::int64_t heard_us, const Now& now) {
    console.take(viewer,
                 R"({"do":"command","station":"alfa","command":"rate","pan_deg_s":5,)"
                 R"("tilt_deg_s":0,"heard_us":)" +
                     std::to_string(heard_us) + "}",
                 now);
    return console.turn(now).size();
  };
  EXPECT_EQ(rate(9'000'000, {1.0, 10'000'000}), 1U);
  EXPECT_EQ(rate(9'200'000, {1.1, 10'100'000}), 1U);
  EXPECT_EQ(rate(9'200'000, {2.0, 11'000'000}), 0U);
  EXPECT_EQ(answer_in(received(console, viewer, {2.1, 11'100'000})).at("why"),
            "refused: it came too late");
  int rates = 0;
  const Json state = console.state({2.1, 11'100'000});
  for (const Json& event : state.at("events")) rates += event.at("text") == "rate" ? 1 : 0;
  EXPECT_EQ(rates, 1);
}

// So does any other command that it delivers late, but for a stop, which comes never too late.
TEST(Console, ACommandThatWasHeldUpIsRefusedAndAStopIsNot) {
  Listening console;
  const auto viewer = console.open("ana", Role::kOperator);
  const auto orders = [&](const std::string& command, const Now& now) {
    console.take(viewer,
                 R"({"do":"command","number":5,"station":"alfa","heard_us":10000000,"command":")" +
                     command + "\"}",
                 now);
    return console.turn(now).size();
  };
  EXPECT_EQ(orders("home", {3.1, 13'100'000}), 0U);
  EXPECT_EQ(answer_in(received(console, viewer, {3.1, 13'100'000})).at("why"),
            "refused: it came too late");
  EXPECT_EQ(orders("stop", {3.2, 13'200'000}), 1U);
  EXPECT_EQ(orders("release", {2.9, 12'900'000}), 1U);
}

TEST(Console, MalformedMessagesAreRefusedInWordsAndCounted) {
  Console console(60.0);
  const auto viewer = console.open("ana", Role::kOperator);
  console.take(viewer, "nonsense", {0.0, 0});
  EXPECT_EQ(answer_in(received(console, viewer, {0.0, 0})).at("why"), "refused: not JSON");
  EXPECT_EQ(console.health({0.0, 0}).at("messages_refused"), 1);
}

TEST(Console, AnswersToAViewerThatDoesNotReadAreBounded) {
  Console console(60.0);
  const auto viewer = console.open("ana", Role::kOperator);
  for (int i = 0; i < 10000; ++i) console.take(viewer, "x", {0.0, 0});
  EXPECT_LE(received(console, viewer, {0.0, 0}).size(), 70U);
}

void watch(Console& console, std::uint64_t viewer, const std::string& stations) {
  console.take(viewer, R"({"do": "watch", "pictures": )" + stations + "}", {0.0, 0});
}

TEST(Console, PullsTheVideoOfStationsThatSomebodyLooksAt) {
  Console console(60.0);
  for (const char* id : {"alfa", "bravo", "charlie"}) {
    ReceivedStation heard = station(id);
    if (id != std::string("charlie")) heard.video_address = std::string("10.0.0.1:") + id;
    console.receive(heard, {0.0, 0});
  }
  EXPECT_TRUE(console.watched_video().empty());
  const auto viewer = console.open("ana", Role::kViewer);
  watch(console, viewer, R"(["bravo", "charlie"])");
  EXPECT_EQ(console.watched_video(), (WatchedVideos{{{"bravo", Codec::kJpeg}, "10.0.0.1:bravo"}}));
  console.take(viewer, R"({"do": "watch", "pictures": ["bravo"], "codec": "h264"})", {0.0, 0});
  EXPECT_EQ(console.watched_video(), (WatchedVideos{{{"bravo", Codec::kH264}, "10.0.0.1:bravo"}}));
  console.receive(station("bravo"), {0.0, 0});  // it serves none any more
  EXPECT_TRUE(console.watched_video().empty());
}

ReceivedProcedure asking(const std::string& station) {
  return {station, {{"state", "asking"}, {"question", 3}}, 3, {"confirm"}, "JPEG"};
}

TEST(Console, AProcedureIsPartOfItsStation) {
  Listening console;
  console.receive(asking("alfa"));
  console.receive(asking("unknown"));
  const Json state = console.state({0.0, 0});
  EXPECT_EQ(state.at("stations")[0].at("procedure").at("question"), 3);
  EXPECT_EQ(state.at("stations")[0].at("procedure").at("picture"), 1);
  ASSERT_TRUE(console.procedure_picture("alfa"));
  EXPECT_EQ(*console.procedure_picture("alfa"), "JPEG");
  EXPECT_FALSE(console.procedure_picture("unknown"));
}

TEST(Console, AnOperatorAnswersAProcedureAndAViewerDoesNot) {
  Listening console;
  console.receive(asking("alfa"));
  const char* const confirm =
      R"({"do":"answer","number":8,"station":"alfa","question":3,"choice":"confirm"})";
  const auto viewer = console.open("vera", Role::kViewer);
  console.take(viewer, confirm, {1.0, 5});
  EXPECT_FALSE(answer_in(received(console, viewer, {1.0, 5})).at("accepted"));
  EXPECT_TRUE(console.take_answers().empty());
  const auto operating = console.open("ana", Role::kOperator);
  console.take(operating, confirm, {1.0, 5});
  const Json answer = answer_in(received(console, operating, {1.0, 5}));
  EXPECT_TRUE(answer.at("accepted")) << answer;
  EXPECT_EQ(answer.at("number"), 8);
  const auto answers = console.take_answers();
  ASSERT_EQ(answers.size(), 1U);
  EXPECT_EQ(answers[0].choice, "confirm");
  EXPECT_EQ(console.state({1.0, 5}).at("events")[0].at("text"), "answers confirm");
}

TEST(Console, AnAnswerThatComesTooLateIsRefusedUnlessItEndsTheProcedure) {
  Listening console;
  console.receive(asking("alfa"));
  const auto operating = console.open("ana", Role::kOperator);
  const auto answered = [&](const std::string& choice, std::int64_t heard_us) {
    console.take(operating,
                 R"({"do":"answer","number":8,"station":"alfa","question":3,"choice":")" + choice +
                     R"(","heard_us":)" + std::to_string(heard_us) + "}",
                 {1.0, 10'000'000});
    return answer_in(received(console, operating, {1.0, 10'000'000}));
  };
  EXPECT_EQ(answered("confirm", 6'900'000).at("why"), "refused: it came too late");
  EXPECT_TRUE(console.take_answers().empty());
  EXPECT_TRUE(answered("abort", 6'900'000).at("accepted"));
  EXPECT_EQ(console.take_answers().size(), 1U);
  EXPECT_TRUE(answered("confirm", 7'100'000).at("accepted"));
  EXPECT_EQ(console.take_answers().size(), 1U);
}

TEST(Console, ACueIsAllowedAndControlIsTakenInTimeOrNotAtAll) {
  Listening console;
  const auto operating = console.open("ana", Role::kOperator);
  const auto says = [&](const std::string& what, std::int64_t heard_us) {
    const auto heard = R"(,"number":8,"heard_us":)" + std::to_string(heard_us) + "}";
    console.take(operating, R"({"do":)" + what + heard, {1.0, 10'000'000});
    for (const auto& order : console.take_cue_orders()) {
      console.receive(wire::Reply{.order = order.id, .is_accepted = true});
    }
    static_cast<void>(console.turn({1.0, 10'000'000}));
    return answer_in(received(console, operating, {1.0, 10'000'000})).at("accepted") == true;
  };
  for (const char* what : {R"("cue","cue":"a","allow":true)", R"("take","station":"alfa")"}) {
    EXPECT_TRUE(!says(what, 6'900'000) && says(what, 7'100'000)) << what;
  }
  EXPECT_TRUE(says(R"("cue","cue":"a","allow":false)", 6'900'000));
}

TEST(Console, AnOperatorsWordOnACueGoesOutAndAViewersDoesNot) {
  Console console(60.0);
  const char* const allow = R"({"do":"cue","number":8,"cue":"tak.a","allow":true})";
  const auto viewer = console.open("vera", Role::kViewer);
  console.take(viewer, allow, {1.0, 5});
  EXPECT_FALSE(answer_in(received(console, viewer, {1.0, 5})).at("accepted"));
  EXPECT_TRUE(console.take_cue_orders().empty());
  const auto operating = console.open("ana", Role::kOperator);
  console.take(operating, allow, {1.0, 5});
  const auto orders = console.take_cue_orders();
  ASSERT_EQ(orders.size(), 1U);
  EXPECT_EQ(orders[0].cue, "tak.a");
  const auto noted = [&] { return console.state({1.0, 5}).at("events")[0]; };
  EXPECT_EQ(noted().at("text"), "allows cue tak.a");
  EXPECT_EQ(noted().at("outcome"), "sent") << "the fusion has not said anything yet";
  console.receive(wire::Reply{.order = orders[0].id, .is_accepted = true});
  static_cast<void>(console.turn({1.1, 6}));
  EXPECT_EQ(noted().at("outcome"), "done");
  EXPECT_TRUE(answer_in(received(console, operating, {1.1, 6})).at("accepted"));
  console.take(operating, R"({"do":"cue","number":9,"cue":"12","allow":false})", {1.2, 6});
  EXPECT_EQ(console.take_cue_orders().at(0).cue, "12");
  EXPECT_EQ(console.state({1.2, 6}).at("events")[1].at("text"), "dismisses target 12");
  console.take(operating, R"({"do":"handover","number":9,"mode":"automatic"})", {1.3, 6});
  EXPECT_EQ(console.take_cue_orders().at(0).handover, "automatic");
  EXPECT_EQ(console.state({1.3, 6}).at("events")[2].at("text"), "sets the hand-over to automatic");
  console.replay_is({{"name", "x"}}, true);
  console.take(operating, allow, {2.0, 6});
  EXPECT_TRUE(console.take_cue_orders().empty()) << "what was is not commanded";
}

TEST(Console, AnIncidentIsShownRecordedAndJudgedByOperators) {
  Listening console;
  const auto says = [&](Role role, const std::string& what) {
    const auto viewer = console.open("ana", role);
    console.take(viewer, R"({"number":8,"do":)" + what + "}", {1.0, 5});
    const Json answer = answer_in(received(console, viewer, {1.0, 5}));
    console.close(viewer);
    return answer.at("accepted") == true;
  };
  const std::string area = R"("area","area":{"name":"Gate","polygon":[[11,48],[11.1,48],[11,48.1]],
      "lowest_m":0,"highest_m":900,"classes":[],"from":"00:00","to":"00:00"})";
  EXPECT_FALSE(says(Role::kViewer, area));
  EXPECT_TRUE(says(Role::kOperator, area));
  ReceivedTarget heard;
  heard.what = ReceivedTarget::What::kPosition;
  heard.boot_id = 9;
  heard.id = "7";
  heard.latitude_deg = 48.01, heard.longitude_deg = 11.01, heard.height_m = 100.0;
  heard.fields = {{"state", "confirmed"},
                  {"covariance_enu_m2", {1, 0, 0, 1, 0, 1}},
                  {"stations", {{{"id", "alfa"}, {"used", true}}}}};
  console.receive(heard, {1.0, 5});
  heard.boot_id = 10;
  heard.id = "8";
  console.receive(heard, {1.0, 5});  // of a second fusion: not believed
  const auto orders = console.turn({1.1, 6});
  ASSERT_EQ(orders.size(), 1U);
  EXPECT_EQ(orders[0].label, "incident-1");
  const auto state = [&] { return console.state({1.1, 6}); };
  EXPECT_EQ(state().at("areas")[0].at("name"), "Gate");
  ASSERT_EQ(state().at("incidents").size(), 1U);
  EXPECT_EQ(state().at("incidents")[0].at("target"), "9/7");
  EXPECT_FALSE(state().at("incidents")[0].contains("track"));
  const auto alarm = [&]() -> Json {
    const Json now = state();
    for (const Json& event : now.at("events")) {
      if (event.at("kind") == "alarm") return event;
    }
    return nullptr;
  };
  EXPECT_TRUE(alarm().at("over_us").is_null());
  EXPECT_FALSE(says(Role::kViewer, R"("judge","incident":1,"verdict":"dismissed")"));
  EXPECT_TRUE(says(Role::kOperator, R"("judge","incident":1,"verdict":"dismissed")"));
  static_cast<void>(console.turn({1.2, 7}));
  EXPECT_EQ(state().at("incidents")[0].at("judged_by"), "ana");
  EXPECT_EQ(alarm().at("over_us"), 7);
  EXPECT_TRUE(says(Role::kOperator, R"("remove_area","name":"Gate")"));
  static_cast<void>(console.turn({1.3, 8}));
  EXPECT_TRUE(state().at("areas").empty());
  console.replay_is({{"at_us", 1}}, true);
  EXPECT_FALSE(says(Role::kOperator, area));
}

TEST(Console, AnAnswerNeedsControlUnlessItEndsTheProcedure) {
  Listening console;
  console.receive(asking("alfa"));
  const auto holder = console.open("ana", Role::kOperator);
  console.take(holder, R"({"do":"take","station":"alfa"})", {1.0, 5});
  const auto other = console.open("otto", Role::kOperator);
  const auto answered = [&](const std::string& choice) {
    console.take(
        other,
        R"({"do":"answer","number":8,"station":"alfa","question":3,"choice":")" + choice + "\"}",
        {1.0, 5});
    return answer_in(received(console, other, {1.0, 5}));
  };
  EXPECT_FALSE(answered("confirm").at("accepted"));
  EXPECT_TRUE(console.take_answers().empty());
  EXPECT_TRUE(answered("abort").at("accepted"));
  EXPECT_EQ(console.take_answers().size(), 1U);
}

ReceivedTarget target(const std::string& id) {
  ReceivedTarget heard;
  heard.what = ReceivedTarget::What::kPosition;
  heard.boot_id = 9;
  heard.id = id;
  heard.fields = {{"state", "confirmed"}};
  return heard;
}

TEST(Console, ANameOfATargetIsForAllAndLastsAsLongAsTheTarget) {
  Listening console;
  const auto ana = console.open("ana", Role::kOperator), eva = console.open("eva", Role::kViewer);
  console.receive(target("7"), {0.0, 0});
  static_cast<void>(received(console, ana, {0.0, 0}));
  console.take(eva, R"({"do":"name","number":1,"target":"7","name":"mine"})", {0.1, 0});
  EXPECT_FALSE(answer_in(received(console, eva, {0.1, 0})).at("accepted")) << "may only look";
  console.take(ana, R"({"do":"name","number":2,"target":"8","name":"drone"})", {0.1, 0});
  EXPECT_FALSE(answer_in(received(console, ana, {0.1, 0})).at("accepted")) << "no such target";
  console.take(ana, R"({"do":"name","number":3,"target":"7","name":"drone"})", {0.2, 0});
  EXPECT_TRUE(answer_in(received(console, ana, {0.2, 0})).at("accepted"));
  console.receive(target("7"), {0.3, 0});
  EXPECT_EQ(console.state({0.3, 0}).at("targets")[0].at("name"), "drone");
  ReceivedTarget gone = target("7");
  gone.what = ReceivedTarget::What::kDropped;
  console.receive(gone, {0.4, 0});
  console.receive(target("7"), {0.5, 0});
  EXPECT_FALSE(console.state({0.5, 0}).at("targets")[0].contains("name"));
}

TEST(Console, WhatCannotBePointedAtIsRefusedInWords) {
  Listening console;
  const auto ana = console.open("ana", Role::kOperator);
  static_cast<void>(received(console, ana, {0.0, 0}));
  console.take(ana,
               R"({"do":"command","number":1,"station":"alfa","command":"point",)"
               R"("latitude_deg":49,"longitude_deg":16,"height_m":300})",
               {0.1, 0});
  EXPECT_TRUE(console.turn({0.1, 0}).empty());
  const Json answer = answer_in(received(console, ana, {0.1, 0}));
  EXPECT_EQ(answer.at("why"),
            "refused: the unit cannot point there, or the station does not know where it looks");
}

}  // namespace
}  // namespace ols::console
