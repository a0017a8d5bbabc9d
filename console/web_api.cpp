#include "console/web_api.h"

#include <charconv>
#include <exception>
#include <string_view>
#include <utility>

#include "conditions/alarm_json.h"
#include "conditions/sayings.h"
#include "console/accuracy_map.h"
#include "console/map_geometry.h"

namespace ols::console {
namespace {

WebResponse json(int status, const Json& body) {
  return {
      status, "application/json", body.dump(-1, ' ', false, Json::error_handler_t::replace), {}};
}

WebResponse refused(int status, const std::string& why) { return json(status, {{"error", why}}); }

// A refusal whose words the page has in its own language.
WebResponse refused(int status, const Outcome& why) {
  return json(status, {{"error", why.text}, {"refusal", why}});
}

WebResponse page_file(const PageFile& file) {
  return {200,
          std::string(file.content_type),
          std::string(file.gzipped),
          {{"Content-Encoding", "gzip"}, {"Cache-Control", "no-cache"}}};
}

WebResponse procedure_picture(const Console& console, const std::string& station) {
  const std::string* jpeg = console.procedure_picture(station);
  if (!jpeg) return refused(404, "no procedure of this station has a picture");
  return {200, "image/jpeg", *jpeg, {{"Cache-Control", "no-store"}}};
}

// "NUMBER" or "NUMBER/picture"
WebResponse incident(const Console& console, std::string_view path) {
  constexpr std::string_view kPicture = "/picture";
  const bool is_picture = path.ends_with(kPicture);
  if (is_picture) path.remove_suffix(kPicture.size());
  std::uint64_t number = 0;
  const auto [end, error] = std::from_chars(path.data(), path.data() + path.size(), number);
  const auto& incidents = console.incidents().watch().incidents();
  const auto known = incidents.find(number);
  if (error != std::errc() || end != path.data() + path.size() || known == incidents.end()) {
    return refused(404, "there is no such incident");
  }
  if (!is_picture) return json(200, json_of(known->second));
  const std::string* jpeg = console.incidents().picture(number);
  if (!jpeg) return refused(404, "this incident has no picture");
  return {200, "image/jpeg", *jpeg, {{"Cache-Control", "no-store"}}};
}

// Decodes escapes, such as %20.
std::optional<std::string> unescaped(std::string_view text) {
  std::string plain;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '%') {
      plain += text[i];
      continue;
    }
    unsigned code = 0;
    const char* const digits = text.data() + i + 1;
    if (i + 2 >= text.size()) return std::nullopt;
    const auto [end, error] = std::from_chars(digits, digits + 2, code, 16);
    if (error != std::errc() || end != digits + 2) return std::nullopt;
    plain += static_cast<char>(code);
    i += 2;
  }
  return plain;
}

// Takes "/ZOOM/COLUMN/ROW" off the end of a path.
bool take_tile(std::string_view& path, TileAddress& tile) {
  for (int* number : {&tile.row, &tile.column, &tile.zoom}) {
    const auto slash = path.rfind('/');
    const char* const end = path.data() + path.size();
    const auto [after, error] = std::from_chars(path.data() + slash + 1, end, *number);
    if (slash == 0 || error != std::errc() || after != end) return false;
    path = path.substr(0, slash);
  }
  return is_address(tile);
}

// "/api/maps", "/api/maps/MAP/accuracy" or "/api/maps/MAP/ZOOM/COLUMN/ROW".
std::optional<MapTask> map_task(std::string_view path) {
  constexpr std::string_view kMaps = "/api/maps", kAccuracy = "/accuracy";
  MapTask task;
  path.remove_prefix(kMaps.size());
  if (path.empty()) return task;
  task.accuracy = path.ends_with(kAccuracy);
  if (task.accuracy) path.remove_suffix(kAccuracy.size());
  if (path.empty() || (!task.accuracy && !take_tile(path, task.tile))) return std::nullopt;
  const auto name = unescaped(path.substr(1));
  if (!name || name->empty()) return std::nullopt;
  task.map = *name;
  return task;
}

std::string cookie(const std::string& token, bool is_secure, double length_s) {
  return std::string(kCookie) + "=" + token + "; Path=/; HttpOnly; SameSite=Strict; Max-Age=" +
         std::to_string(static_cast<long>(length_s)) + (is_secure ? "; Secure" : "");
}

}  // namespace

WebApi::WebApi(const ConsoleConfig& config, Users users, Console& console, DrawToken draw_token,
               SaveUsers save_users)
    : config_(config),
      users_(std::move(users)),
      console_(console),
      draw_token_(std::move(draw_token)),
      save_users_(std::move(save_users)),
      is_open_(users_.empty()),
      sessions_(config.session_s) {}

std::vector<std::pair<std::string, std::string>> WebApi::security_headers(bool is_tls) {
  std::vector<std::pair<std::string, std::string>> headers{
      {"Content-Security-Policy",
       "default-src 'self'; frame-ancestors 'none'; base-uri 'none'; form-action 'self'"},
      {"X-Content-Type-Options", "nosniff"},
      {"Referrer-Policy", "no-referrer"},
      {"Cross-Origin-Opener-Policy", "same-origin"},
      {"Cross-Origin-Resource-Policy", "same-origin"}};
  if (is_tls) headers.emplace_back("Strict-Transport-Security", "max-age=31536000");
  return headers;
}

std::optional<Session> WebApi::who(const WebRequest& request, const Now& now) const {
  if (is_open()) return Session{"operator", Role::kOperator, 0.0};
  return sessions_.find(token_in(request.cookies), now.monotonic_s);
}

// Browsers state the page that a request comes from; other programs do not.
std::optional<WebResponse> WebApi::foreign(const WebRequest& request) const {
  if (!is_own_host(config_, request.host)) {
    return refused(403, "this console is not called " + request.host +
                            ": add it to host_names in its configuration");
  }
  const std::string own = (config_.certificate.empty() ? "http://" : "https://") + request.host;
  if (request.origin.empty() || request.origin == own) return std::nullopt;
  return refused(403, "requests from pages of " + request.origin + " are refused");
}

WebResponse WebApi::session(const WebRequest& request, const Now& now) const {
  const auto session = who(request, now);
  if (!session) return refused(401, outcome::log_in_first());
  return json(
      200,
      {{"name", session->name}, {"role", std::string(name(session->role))}, {"open", is_open()}});
}

WebAnswer WebApi::get(const WebRequest& request, const Now& now) const {
  const std::string path = request.path.substr(0, request.path.find('?'));
  if (path == "/api/health") return json(200, console_.health(now));
  if (path == "/api/session") return session(request, now);
  if (const PageFile* file = page_file_at(path)) return page_file(*file);
  if (!path.starts_with("/api/")) return refused(404, "there is no " + path);
  if (!who(request, now)) return refused(401, outcome::log_in_first());
  if (path == "/api/state") return json(200, console_.state(now));
  if (path == "/api/users") return list_users(request, now);
  if (path == "/api/accuracy") {
    const auto map =
        accuracy_map(console_.state(now).at("stations"), request.path.substr(path.size()));
    return map ? json(200, *map)
               : refused(400, "box must be WEST,SOUTH,EAST,NORTH [deg], small; above a height [m]");
  }
  if (path == "/api/maps" || path.starts_with("/api/maps/")) {
    if (const auto task = map_task(path)) return *task;
    return refused(404,
                   "a tile is /api/maps/MAP/ZOOM/COLUMN/ROW, and there is /api/maps/MAP/accuracy");
  }
  if (path == "/api/land" || path.starts_with("/api/land/")) {
    return land(path, request.path.substr(path.size()));
  }
  constexpr std::string_view kProcedures = "/api/procedures/";
  if (path.starts_with(kProcedures)) {
    return procedure_picture(console_, unescaped(path.substr(kProcedures.size())).value_or(""));
  }
  constexpr std::string_view kIncidents = "/api/incidents/";
  if (path.starts_with(kIncidents)) {
    return incident(console_, std::string_view(path).substr(kIncidents.size()));
  }
  if (path == "/api/replay") {
    return console_.is_replay() ? json(200, console_.timeline())
                                : refused(404, "this is no replay: it shows the site as it is now");
  }
  if (path == "/api/measure") {
    const auto measured = measure(request.path.substr(path.size()));
    return measured ? json(200, *measured) : refused(400, "from and to must be LATITUDE,LONGITUDE");
  }
  if (path == "/api/grid") {
    const auto grid = utm_grid(request.path.substr(path.size()));
    return grid ? json(200, *grid) : refused(400, "box must be WEST,SOUTH,EAST,NORTH [deg], small");
  }
  return refused(404, "there is no " + path);
}

// "/api/land/skyline/STATION", "/api/land/seen/STATION" or "/api/land/profile/STATION", or what
// land_task() knows.
WebAnswer WebApi::land(const std::string& path, const std::string& query) const {
  if (const auto task = land_task(path, query)) return *task;
  const std::string_view rest = std::string_view(path).substr(std::string_view("/api/land").size());
  const auto slash = rest.find('/', 1);
  if (slash != std::string_view::npos) {
    const std::string id = unescaped(rest.substr(slash + 1)).value_or("");
    const Json* station = console_.fields_of(id);
    if (!station) return refused(404, outcome::no_such_station());
    if (rest.substr(1, slash - 1) == "seen") return json(200, console_.seen_skyline(id));
    const auto camera = camera_of(*station);
    if (!camera) return refused(409, outcome::camera_place_unknown());
    if (const auto task = land_task(rest.substr(1, slash - 1), query, id, *camera)) return *task;
  }
  return refused(
      400,
      "there are /api/land, /api/land/ground?at=LATITUDE,LONGITUDE, /api/land/heights?"
      "box=WEST,SOUTH,EAST,NORTH [deg], small, /api/land/skyline/STATION, "
      "/api/land/seen/STATION and /api/land/profile/STATION?to=LATITUDE,LONGITUDE,HEIGHT");
}

WebAnswer WebApi::log_in(const WebRequest& request, const Now& now) {
  const Json body = Json::parse(request.body, nullptr, false);
  if (!body.is_object() || !body.contains("name") || !body.at("name").is_string() ||
      !body.contains("password") || !body.at("password").is_string()) {
    return refused(400, "name and password are missing");
  }
  if (!limit_.admit(request.remote, now.monotonic_s)) {
    return refused(429, outcome::too_many_tries());
  }
  LoginTask task{body.at("name").get<std::string>(), body.at("password").get<std::string>(), ""};
  const auto user = users_.find(task.name);
  if (user != users_.end()) task.hash = user->second.hash;
  return task;
}

WebResponse WebApi::finish(const LoginTask& task, bool is_verified, const Now& now) {
  const auto user = users_.find(task.name);
  if (!is_verified || user == users_.end()) {
    console_.note("", note::log_in_refused(), now);
    return refused(401, outcome::wrong_password());
  }
  const std::string token = draw_token_();
  sessions_.begin(token, user->first, user->second.role, now.monotonic_s);
  console_.note(user->first, note::logged_in(), now);
  WebResponse response =
      json(200, {{"name", user->first}, {"role", std::string(name(user->second.role))}});
  response.headers.emplace_back("Set-Cookie",
                                cookie(token, !config_.certificate.empty(), config_.session_s));
  return response;
}

WebAnswer WebApi::post(const WebRequest& request, const Now& now) {
  if (request.path == "/api/session") {
    if (is_open()) return session(request, now);
    return log_in(request, now);
  }
  const auto session = who(request, now);
  if (!session) return refused(401, outcome::log_in_first());
  if (request.path == "/api/users") return enter_user(request, now);
  if (request.path != "/api/stop") return refused(404, "there is no " + request.path);
  if (console_.is_replay()) return refused(409, console_.bus_trouble());
  // The page says which browser it is in. The stop is carried out whatever it says.
  const Json body = Json::parse(request.body, nullptr, false);
  const Json viewer = body.is_object() ? body.value("viewer", Json(0)) : Json(0);
  const Person by =
      console_.person(session->name, viewer.is_number_unsigned() ? viewer.get<std::uint64_t>() : 0);
  Json said{{"stopping", console_.stop_all(by, {}, now)}};
  if (const Outcome& trouble = console_.bus_trouble(); !trouble.empty()) {
    said["problem"] = trouble.text;
    said["refusal"] = trouble;
  }
  return json(200, said);
}

// Why this person may not manage users; empty: may.
Outcome WebApi::admin_problem(const WebRequest& request, const Now& now) const {
  if (is_open()) return outcome::no_users_yet();
  const auto session = who(request, now);
  if (!session) return outcome::log_in_first();
  return session->role == Role::kAdmin ? Outcome{} : outcome::admins_only();
}

WebResponse WebApi::list_users(const WebRequest& request, const Now& now) const {
  if (const auto problem = admin_problem(request, now); !problem.empty()) {
    return refused(403, problem);
  }
  const auto sessions = sessions_.counts(now.monotonic_s);
  Json list = Json::array();
  for (const auto& [user, entry] : users_) {
    const auto count = sessions.find(user);
    list.push_back({{"name", user},
                    {"role", std::string(name(entry.role))},
                    {"sessions", count == sessions.end() ? 0 : count->second}});
  }
  return json(200, {{"users", std::move(list)}});
}

WebAnswer WebApi::enter_user(const WebRequest& request, const Now& now) {
  if (const auto problem = admin_problem(request, now); !problem.empty()) {
    return refused(403, problem);
  }
  const Json body = Json::parse(request.body, nullptr, false);
  for (const char* key : {"name", "role", "password"}) {
    if (!body.is_object() || !body.contains(key) || !body.at(key).is_string()) {
      return refused(400, "name, role and password are needed");
    }
  }
  UserTask task{who(request, now)->name, body.at("name"), body.at("password"), Role::kViewer};
  const auto role = role_named(body.at("role").get<std::string>());
  if (!role) return refused(400, "the role must be viewer, operator or admin");
  task.role = *role;
  if (const auto problem = name_problem(task.name); !problem.empty()) return refused(400, problem);
  if (const auto problem = password_problem(task.password); !problem.empty()) {
    return refused(400, problem);
  }
  return task;
}

// Also ends the sessions of the user who is changed.
WebResponse WebApi::change_users(Users users, const std::string& by, const std::string& of,
                                 const Alarm& what, const Now& now) {
  if (const auto problem = users_problem(users); !problem.empty()) return refused(409, problem);
  try {
    save_users_(users);
  } catch (const std::exception& error) {
    return refused(500, std::string("not changed: ") + error.what());
  }
  users_ = std::move(users);
  sessions_.end_of(of);
  console_.note(by, what, now);
  return json(200, {{"name", of}});
}

WebResponse WebApi::finish(const UserTask& task, const std::string& hash, const Now& now) {
  Users users = users_;
  users[task.name] = {task.role, hash};
  return change_users(std::move(users), task.by, task.name, note::enters_user(task.name), now);
}

// Removes the caller's session, a user, or all sessions of a user.
WebAnswer WebApi::remove(const WebRequest& request, const Now& now) {
  if (request.path == "/api/session") {
    sessions_.end(token_in(request.cookies));
    WebResponse response = json(200, {{"name", nullptr}});
    response.headers.emplace_back("Set-Cookie", cookie("", !config_.certificate.empty(), 0.0));
    return response;
  }
  constexpr std::string_view kUsers = "/api/users/", kSessions = "/api/sessions/";
  const bool is_user = request.path.starts_with(kUsers);
  if (!is_user && !request.path.starts_with(kSessions)) {
    return refused(404, "there is no " + request.path);
  }
  if (const auto problem = admin_problem(request, now); !problem.empty()) {
    return refused(403, problem);
  }
  const std::string of = request.path.substr(is_user ? kUsers.size() : kSessions.size());
  if (!users_.contains(of)) return refused(404, outcome::no_such_user());
  const std::string by = who(request, now)->name;
  if (!is_user) {
    sessions_.end_of(of);
    console_.note(by, note::ends_sessions(of), now);
    return json(200, {{"name", of}});
  }
  Users users = users_;
  users.erase(of);
  return change_users(std::move(users), by, of, note::removes_user(of), now);
}

WebAnswer WebApi::answer(const WebRequest& request, const Now& now) {
  if (auto refusal = foreign(request)) return *refusal;
  if (request.method == "GET" || request.method == "HEAD") return get(request, now);
  if (request.method == "DELETE") return remove(request, now);
  if (request.method != "POST") return refused(405, "this method is not known here");
  // A form on a foreign page could send other types without a preflight request.
  if (!request.content_type.starts_with("application/json")) {
    return refused(415, "the content must be application/json");
  }
  return post(request, now);
}

std::variant<Session, WebResponse> WebApi::admit(const WebRequest& request, const Now& now) const {
  if (auto refusal = foreign(request)) return *refusal;
  if (request.path != "/api/live") return refused(404, "there is no " + request.path);
  if (auto session = who(request, now)) return *session;
  return refused(401, outcome::log_in_first());
}

}  // namespace ols::console
