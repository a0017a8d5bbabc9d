// The console's web interface without sockets: answers HTTP requests, knows the logged-in users,
// and decides who may open a WebSocket. Pure, except for drawing session tokens.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "console/console.h"
#include "console/console_config.h"
#include "console/land_task.h"
#include "console/login_limit.h"
#include "console/maps/tile_store.h"
#include "console/page_files.h"
#include "console/sessions.h"

namespace ols::console {

struct WebRequest {
  std::string method = {}, path = {};
  std::string host = {}, origin = {}, cookies = {}, content_type = {};
  std::string body = {};
  std::string remote = {};  // address of the client
};

struct WebResponse {
  int status = 200;
  std::string content_type = "application/json";
  std::string body;
  std::vector<std::pair<std::string, std::string>> headers;
};

// A log-in whose password must still be verified. The caller does so in another thread, because it
// takes long.
struct LoginTask {
  std::string name, password, hash;
};

// A user to be added or changed. The caller hashes the password in another thread, because it takes
// long.
struct UserTask {
  std::string by, name, password;
  Role role = Role::kViewer;
};

// A request for the users' own maps. The caller answers it in another thread, because it may wait
// for a disk.
struct MapTask {
  std::string map = {};  // empty: the list of maps
  TileAddress tile = {};
  // true: for a planned site's expected accuracy (console/maps/accuracy_file.h); false: for a map
  // tile.
  bool accuracy = false;
};

using WebAnswer = std::variant<WebResponse, LoginTask, UserTask, MapTask, LandTask>;

class WebApi {
 public:
  using DrawToken = std::function<std::string()>;  // returns 64 random hexadecimal digits
  // Stores the users; throws an exception on failure.
  using SaveUsers = std::function<void(const Users&)>;
  WebApi(const ConsoleConfig& config, Users users, Console& console, DrawToken draw_token,
         SaveUsers save_users);

  WebAnswer answer(const WebRequest& request, const Now& now);
  WebResponse finish(const LoginTask& task, bool is_verified, const Now& now);
  WebResponse finish(const UserTask& task, const std::string& hash, const Now& now);

  // The session that may open a WebSocket with this request, or the response that refuses it.
  std::variant<Session, WebResponse> admit(const WebRequest& request, const Now& now) const;

  // Whether the session of a WebSocket still lasts. A session ends after its time, or when the user
  // logs out or is changed.
  bool lasts(const std::string& token, const Now& now) const {
    return is_open() || sessions_.find(token, now.monotonic_s).has_value();
  }

  // Whether no log-in is needed, because there are no users. This is allowed only on loopback.
  bool is_open() const { return is_open_; }
  // Headers for every response. They restrict what the browser does with the response.
  static std::vector<std::pair<std::string, std::string>> security_headers(bool is_tls);

 private:
  std::optional<Session> who(const WebRequest& request, const Now& now) const;
  std::optional<WebResponse> foreign(const WebRequest& request) const;
  WebAnswer post(const WebRequest& request, const Now& now);
  WebAnswer log_in(const WebRequest& request, const Now& now);
  WebAnswer get(const WebRequest& request, const Now& now) const;
  WebAnswer land(const std::string& path, const std::string& query) const;
  WebResponse session(const WebRequest& request, const Now& now) const;
  Outcome admin_problem(const WebRequest& request, const Now& now) const;
  WebResponse list_users(const WebRequest& request, const Now& now) const;
  WebAnswer enter_user(const WebRequest& request, const Now& now);
  WebAnswer remove(const WebRequest& request, const Now& now);
  WebResponse change_users(Users users, const std::string& by, const std::string& of,
                           const Alarm& what, const Now& now);

  ConsoleConfig config_;
  Users users_;
  Console& console_;
  DrawToken draw_token_;
  SaveUsers save_users_;
  bool is_open_;
  Sessions sessions_;
  LoginLimit limit_;
};

inline constexpr std::size_t kMostBodyBytes = 4096;

}  // namespace ols::console
