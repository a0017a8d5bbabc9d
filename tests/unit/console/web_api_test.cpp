#include "console/web_api.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "conditions/alarms.h"

namespace ols::console {
namespace {

constexpr Now kNow{100.0, 5};

class WebApiTest : public testing::Test {
 protected:
  WebApi open_api() {
    return {config_, {}, console_, [] { return std::string("token"); }, save_};
  }
  WebApi closed_api() {
    return {config_,
            {{"ana", {Role::kAdmin, hash_}}},
            console_,
            [] { return std::string("token"); },
            save_};
  }
  static WebRequest get(const std::string& path) {
    return {.method = "GET", .path = path, .host = "127.0.0.1:8080", .remote = "127.0.0.1"};
  }
  static WebRequest post(const std::string& path, const std::string& body) {
    return {.method = "POST",
            .path = path,
            .host = "127.0.0.1:8080",
            .content_type = "application/json",
            .body = body,
            .remote = "127.0.0.1"};
  }
  static WebResponse response(WebApi& api, const WebRequest& request) {
    return std::get<WebResponse>(api.answer(request, kNow));
  }

  ConsoleConfig config_;
  Users saved_;
  WebApi::SaveUsers save_ = [this](const Users& users) { saved_ = users; };
  Console console_{60.0};
  std::string hash_ = "$argon2id$hash";
};

TEST_F(WebApiTest, WithoutUsersEverybodyOnThisHostIsAnOperator) {
  WebApi api = open_api();
  EXPECT_EQ(response(api, get("/api/state")).status, 200);
  EXPECT_EQ(Json::parse(response(api, get("/api/session")).body).at("role"), "operator");
  EXPECT_EQ(std::get<Session>(api.admit(get("/api/live"), kNow)).role, Role::kOperator);
}

TEST_F(WebApiTest, WithUsersNothingIsShownBeforeTheLogIn) {
  WebApi api = closed_api();
  for (const char* path : {"/api/state", "/api/session", "/api/measure?from=1,1&to=2,2"}) {
    EXPECT_EQ(response(api, get(path)).status, 401) << path;
  }
  EXPECT_EQ(response(api, post("/api/stop", "{}")).status, 401);
  EXPECT_EQ(std::get<WebResponse>(api.admit(get("/api/live"), kNow)).status, 401);
  const Json said = Json::parse(response(api, get("/api/state")).body);
  EXPECT_EQ(said.at("refusal").at("id"), "log_in_first");
  EXPECT_EQ(said.at("error"), "log in first");
  EXPECT_EQ(response(api, get("/")).status, 200) << "the page itself, to log in";
  EXPECT_EQ(response(api, get("/api/health")).status, 200);
}

TEST_F(WebApiTest, ALogInGivesACookieThatNoScriptSees) {
  WebApi api = closed_api();
  const auto task = std::get<LoginTask>(
      api.answer(post("/api/session", R"({"name":"ana","password":"p"})"), kNow));
  EXPECT_EQ(task.hash, hash_);
  const WebResponse done = api.finish(task, true, kNow);
  EXPECT_EQ(done.status, 200);
  EXPECT_EQ(done.headers.at(0).second,
            "ols_session=token; Path=/; HttpOnly; SameSite=Strict; Max-Age=43200");
  WebRequest request = get("/api/state");
  request.cookies = "ols_session=token";
  EXPECT_EQ(response(api, request).status, 200);
  request.method = "DELETE";
  request.path = "/api/session";
  EXPECT_EQ(response(api, request).status, 200);
  request.method = "GET";
  EXPECT_EQ(response(api, request).status, 401);
}

TEST_F(WebApiTest, AWebSocketLastsNoLongerThanItsSession) {
  WebApi api = closed_api();
  const auto task = std::get<LoginTask>(
      api.answer(post("/api/session", R"({"name":"ana","password":"p"})"), kNow));
  EXPECT_FALSE(api.lasts("token", kNow));
  static_cast<void>(api.finish(task, true, kNow));
  EXPECT_TRUE(api.lasts("token", kNow));
  EXPECT_FALSE(api.lasts("", kNow));
  EXPECT_FALSE(api.lasts("token", {kNow.monotonic_s + config_.session_s, 0})) << "its time is over";
  WebRequest log_out = get("/api/session");
  log_out.method = "DELETE";
  log_out.cookies = "ols_session=token";
  static_cast<void>(response(api, log_out));
  EXPECT_FALSE(api.lasts("token", kNow));
  EXPECT_TRUE(open_api().lasts("", kNow));
}

TEST_F(WebApiTest, AWrongPasswordAndAnUnknownUserAreToldAlike) {
  WebApi api = closed_api();
  const auto known = std::get<LoginTask>(
      api.answer(post("/api/session", R"({"name":"ana","password":"p"})"), kNow));
  const auto unknown = std::get<LoginTask>(
      api.answer(post("/api/session", R"({"name":"eve","password":"p"})"), kNow));
  EXPECT_EQ(unknown.hash, "");
  EXPECT_EQ(api.finish(known, false, kNow).body, api.finish(unknown, false, kNow).body);
  EXPECT_EQ(api.finish(unknown, true, kNow).status, 401) << "whatever the verification says";
}

TEST_F(WebApiTest, PasswordsCannotBeTriedWithoutEnd) {
  WebApi api = closed_api();
  const WebRequest request = post("/api/session", R"({"name":"ana","password":"p"})");
  for (int i = 0; i < 5; ++i)
    EXPECT_TRUE(std::holds_alternative<LoginTask>(api.answer(request, kNow)));
  EXPECT_EQ(response(api, request).status, 429);
}

TEST_F(WebApiTest, ForeignPagesAndNamesAreRefused) {
  WebApi api = open_api();
  WebRequest request = post("/api/stop", "{}");
  request.origin = "http://evil.example";
  EXPECT_EQ(response(api, request).status, 403);
  request.origin = "http://127.0.0.1:8080";
  EXPECT_EQ(response(api, request).status, 200);
  request.host = request.origin = "evil.example:8080";
  EXPECT_EQ(response(api, request).status, 403);
  WebRequest live = get("/api/live");
  live.origin = "http://evil.example";
  EXPECT_EQ(std::get<WebResponse>(api.admit(live, kNow)).status, 403);
}

TEST_F(WebApiTest, WhatIsNotUnderstoodIsRefused) {
  WebApi api = closed_api();
  EXPECT_EQ(response(api, post("/api/session", "{")).status, 400);
  EXPECT_EQ(response(api, post("/api/session", R"({"name":1,"password":"p"})")).status, 400);
  WebRequest form = post("/api/session", "name=ana");
  form.content_type = "application/x-www-form-urlencoded";
  EXPECT_EQ(response(api, form).status, 415);
  WebRequest put = get("/");
  put.method = "PUT";
  EXPECT_EQ(response(api, put).status, 405);
  EXPECT_EQ(response(api, get("/nothing")).status, 404);
  EXPECT_EQ(response(api, get("/../main.cpp")).status, 404);
}

TEST_F(WebApiTest, StopSaysWhichStationsItStops) {
  WebApi api = open_api();
  ReceivedStation alfa;
  alfa.id = "alfa";
  alfa.fields = {{"state", "tracking"}};
  console_.receive(alfa, kNow);
  EXPECT_EQ(Json::parse(response(api, post("/api/stop", "{}")).body).at("stopping"),
            Json::parse(R"(["alfa"])"));
  EXPECT_EQ(console_.turn(kNow).size(), 1U);
}

TEST_F(WebApiTest, StopSaysWhenThereIsNoBus) {
  WebApi api = open_api();
  EXPECT_FALSE(Json::parse(response(api, post("/api/stop", "{}")).body).contains("problem"));
  console_.bus_is(alarm::no_bus("connecting"));
  EXPECT_EQ(Json::parse(response(api, post("/api/stop", "{}")).body).at("problem"),
            "no bus: connecting");
}

TEST_F(WebApiTest, AnAdminSaysWhoMayLogIn) {
  WebApi api = closed_api();
  EXPECT_EQ(response(api, get("/api/users")).status, 401);
  const auto login = std::get<LoginTask>(
      api.answer(post("/api/session", R"({"name":"ana","password":"p"})"), kNow));
  static_cast<void>(api.finish(login, true, kNow));
  const auto as_ana = [](WebRequest request) {
    request.cookies = "ols_session=token";
    return request;
  };
  const auto bob = post("/api/users", R"({"name":"bob","role":"viewer","password":"long enough"})");
  EXPECT_EQ(response(api, bob).status, 401) << "nobody is logged in";
  const auto task = std::get<UserTask>(api.answer(as_ana(bob), kNow));
  EXPECT_EQ(task.role, Role::kViewer);
  EXPECT_EQ(api.finish(task, "$argon2id$bob", kNow).status, 200);
  EXPECT_EQ(saved_.at("bob").hash, "$argon2id$bob");
  const Json users = Json::parse(response(api, as_ana(get("/api/users"))).body).at("users");
  ASSERT_EQ(users.size(), 2U);
  EXPECT_EQ(users[0].at("sessions"), 1);
  EXPECT_FALSE(users[0].contains("hash"));
  WebRequest remove = as_ana(get("/api/users/bob"));
  remove.method = "DELETE";
  EXPECT_EQ(response(api, remove).status, 200);
  EXPECT_FALSE(saved_.contains("bob"));
  EXPECT_EQ(response(api, remove).status, 404);
  remove.path = "/api/users/ana";
  EXPECT_EQ(response(api, remove).status, 409) << "the last admin";
  WebApi of_viewer = {config_,
                      {{"eve", {Role::kViewer, hash_}}, {"ana", {Role::kAdmin, hash_}}},
                      console_,
                      [] { return std::string("token"); },
                      save_};
  const auto eve = std::get<LoginTask>(
      of_viewer.answer(post("/api/session", R"({"name":"eve","password":"p"})"), kNow));
  static_cast<void>(of_viewer.finish(eve, true, kNow));
  for (const WebRequest& request : {as_ana(get("/api/users")), as_ana(bob), remove}) {
    EXPECT_EQ(response(of_viewer, request).status, 403) << "a viewer says nothing of users";
  }
  remove.path = "/api/sessions/ana";
  EXPECT_EQ(response(api, remove).status, 200);
  EXPECT_FALSE(api.lasts("token", kNow));
}

TEST_F(WebApiTest, AUserThatCannotBeKeptIsNotChanged) {
  WebApi api = closed_api();
  const auto login = std::get<LoginTask>(
      api.answer(post("/api/session", R"({"name":"ana","password":"p"})"), kNow));
  static_cast<void>(api.finish(login, true, kNow));
  for (const char* body : {"{}", R"({"name":"b c","role":"viewer","password":"long enough"})",
                           R"({"name":"bob","role":"king","password":"long enough"})",
                           R"({"name":"bob","role":"viewer","password":"short"})"}) {
    WebRequest request = post("/api/users", body);
    request.cookies = "ols_session=token";
    EXPECT_EQ(response(api, request).status, 400) << body;
  }
  WebApi full(
      config_, {{"ana", {Role::kAdmin, hash_}}}, console_, [] { return std::string("token"); },
      [](const Users&) { throw std::runtime_error("disk full"); });
  const WebResponse failed = full.finish(UserTask{"ana", "bob", "", Role::kViewer}, "h", kNow);
  EXPECT_EQ(failed.status, 500);
  EXPECT_NE(failed.body.find("disk full"), std::string::npos);
}

TEST_F(WebApiTest, MapsAndTheirTilesAreAskedForByName) {
  WebApi api = open_api();
  EXPECT_EQ(std::get<MapTask>(api.answer(get("/api/maps"), kNow)).map, "");
  const auto task =
      std::get<MapTask>(api.answer(get("/api/maps/old%20town.mbtiles/7/10/20"), kNow));
  EXPECT_EQ(task.map, "old town.mbtiles");
  EXPECT_EQ(task.tile.zoom, 7);
  EXPECT_EQ(task.tile.column, 10);
  EXPECT_EQ(task.tile.row, 20);
  EXPECT_FALSE(task.accuracy);
  const auto plan = std::get<MapTask>(api.answer(get("/api/maps/a%20plan.geojson/accuracy"), kNow));
  EXPECT_TRUE(plan.accuracy);
  EXPECT_EQ(plan.map, "a plan.geojson");
  for (const char* path : {"/api/maps/", "/api/maps/a/1/2", "/api/maps/a/2/9/0",
                           "/api/maps/a/1/x/0", "/api/maps/%zz/1/0/0", "/api/maps//1/0/0",
                           "/api/maps/1/0/0", "/api/maps/accuracy", "/api/maps//accuracy"}) {
    EXPECT_EQ(response(api, get(path)).status, 404) << path;
  }
  WebApi closed = closed_api();
  EXPECT_EQ(response(closed, get("/api/maps")).status, 401);
}

TEST_F(WebApiTest, ReplaysAndAccuracyAreAnsweredInWords) {
  WebApi api = open_api();
  EXPECT_EQ(response(api, get("/api/replay")).status, 404);
  EXPECT_EQ(response(api, get("/api/accuracy?box=1,1,2,2&above=50")).status, 200);
  EXPECT_EQ(response(api, get("/api/accuracy?box=1")).status, 400);
  console_.replay_is({{"at_us", 1}}, true);
  console_.timeline_is({{"marks", Json::array()}});
  EXPECT_EQ(response(api, get("/api/replay")).status, 200);
  EXPECT_EQ(response(api, post("/api/stop", "{}")).status, 409);
}

TEST_F(WebApiTest, ThePageIsCompressedAndFromHereAlone) {
  WebApi api = open_api();
  for (const char* path : {"/", "/page.js", "/page.css", "/land.json"}) {
    const WebResponse file = response(api, get(path));
    EXPECT_EQ(file.body.substr(0, 2), "\x1f\x8b") << path;
  }
  EXPECT_EQ(WebApi::security_headers(false).at(0).second.substr(0, 18), "default-src 'self'");
  EXPECT_EQ(WebApi::security_headers(true).back().first, "Strict-Transport-Security");
}

TEST_F(WebApiTest, TheNewestPictureOfAProcedure) {
  WebApi api = open_api();
  EXPECT_EQ(response(api, get("/api/procedures/alfa")).status, 404);
  ReceivedStation station;
  station.id = "alfa";
  console_.receive(station, kNow);
  console_.receive(ReceivedProcedure{"alfa", Json::object(), 1, {}, "JPEG"});
  const WebResponse picture = response(api, get("/api/procedures/alfa?picture=1"));
  EXPECT_EQ(picture.status, 200);
  EXPECT_EQ(picture.content_type, "image/jpeg");
  EXPECT_EQ(picture.body, "JPEG");
  WebApi closed = closed_api();
  EXPECT_EQ(response(closed, get("/api/procedures/alfa")).status, 401);
}

}  // namespace
}  // namespace ols::console
