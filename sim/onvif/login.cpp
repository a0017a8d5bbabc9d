#include "sim/onvif/login.h"

#include <openssl/evp.h>
#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <limits>
#include <vector>

namespace ols::sim {
namespace {

constexpr const char* kRealm = "onvif";
constexpr std::size_t kMostSeen = 1000, kMostIssued = 64;

std::string hashed(const EVP_MD* kind, std::string_view text) {
  std::string digest(EVP_MAX_MD_SIZE, '\0');
  unsigned size = 0;
  EVP_Digest(text.data(), text.size(), reinterpret_cast<unsigned char*>(digest.data()), &size, kind,
             nullptr);
  digest.resize(size);
  return digest;
}

std::string md5_hex(std::string_view text) {
  std::string hex;
  for (const char c : hashed(EVP_md5(), text))
    hex += fmt::format("{:02x}", static_cast<unsigned char>(c));
  return hex;
}

std::string base64(std::string_view bytes) {
  std::string text(4 * (bytes.size() / 3 + 1) + 1, '\0');
  const int size = EVP_EncodeBlock(reinterpret_cast<unsigned char*>(text.data()),
                                   reinterpret_cast<const unsigned char*>(bytes.data()),
                                   static_cast<int>(bytes.size()));
  text.resize(static_cast<std::size_t>(size));
  return text;
}

// Empty: not base64.
std::string from_base64(std::string_view text) {
  std::string bytes(3 * (text.size() / 4) + 1, '\0');
  const int size = EVP_DecodeBlock(reinterpret_cast<unsigned char*>(bytes.data()),
                                   reinterpret_cast<const unsigned char*>(text.data()),
                                   static_cast<int>(text.size()));
  const auto padding = static_cast<int>(std::ranges::count(text, '='));
  bytes.resize(static_cast<std::size_t>(std::max(0, size - padding)));
  return bytes;
}

// The parameters after "Digest": names with values, quoted or not.
std::map<std::string, std::string> parameters_of(std::string_view text) {
  std::map<std::string, std::string> found;
  while (true) {
    const auto begin = text.find_first_not_of(" ,");
    const auto equals = text.find('=');
    if (begin >= equals || equals == std::string_view::npos) return found;
    const std::string name(text.substr(begin, equals - begin));
    text.remove_prefix(equals + 1);
    const bool quoted = text.starts_with('"');
    if (quoted) text.remove_prefix(1);
    const auto end = std::min(text.find(quoted ? '"' : ','), text.size());
    found[name] = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
  }
}

}  // namespace

double utc_of(const std::string& date_time) {
  int year = 0, month = 0, day = 0, hour = 0, minute = 0;
  double second = 0.0;
  if (std::sscanf(date_time.c_str(), "%4d-%2d-%2dT%2d:%2d:%lf", &year, &month, &day, &hour, &minute,
                  &second) != 6) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  using namespace std::chrono;
  const sys_days date = std::chrono::year(year) / month / day;
  return static_cast<double>(date.time_since_epoch().count()) * 86400.0 + hour * 3600.0 +
         minute * 60.0 + second;
}

std::string date_time_of(std::int64_t utime_us) {
  using namespace std::chrono;
  const sys_time<microseconds> at{microseconds(utime_us)};
  const auto day = floor<days>(at);
  const year_month_day date(day);
  const hh_mm_ss time(floor<milliseconds>(at - day));
  return fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}.{:03}Z", int(date.year()),
                     unsigned(date.month()), unsigned(date.day()), time.hours().count(),
                     time.minutes().count(), time.seconds().count(), time.subseconds().count());
}

Login::Login(std::string user, std::string password, std::uint64_t seed)
    : user_(std::move(user)), password_(std::move(password)), random_(seed) {}

bool Login::accepts(const UsernameToken& token, double utc_s) {
  const std::string right =
      base64(hashed(EVP_sha1(), from_base64(token.nonce) + token.created + password_));
  if (token.user != user_ || token.digest != right) return false;
  if (!(std::abs(utc_of(token.created) - utc_s) <= kTokenAge_s)) return false;
  if (std::ranges::count(seen_, token.nonce) > 0) return false;
  seen_.push_back(token.nonce);
  if (seen_.size() > kMostSeen) seen_.pop_front();
  return true;
}

Login::Verdict Login::accepts(std::string_view authorization, const std::string& method,
                              const std::string& target, double now_s) {
  constexpr std::string_view kScheme = "Digest ";
  if (!authorization.starts_with(kScheme)) return Verdict::kWrong;
  auto given = parameters_of(authorization.substr(kScheme.size()));
  const std::string secret = md5_hex(user_ + ":" + kRealm + ":" + password_);
  const std::string request = md5_hex(method + ":" + target);
  const std::string right =
      md5_hex(fmt::format("{}:{}:{}:{}:{}:{}", secret, given["nonce"], given["nc"], given["cnonce"],
                          given["qop"], request));
  if (given["username"] != user_ || given["uri"] != target || given["qop"] != "auth" ||
      given["response"] != right) {
    return Verdict::kWrong;
  }
  const auto issued = issued_.find(given["nonce"]);
  if (issued == issued_.end() || now_s - issued->second.at_s > kNonceAge_s) return Verdict::kStale;
  std::uint64_t count = 0;
  const std::string& hex = given["nc"];
  std::from_chars(hex.data(), hex.data() + hex.size(), count, 16);
  if (count <= issued->second.count) return Verdict::kStale;
  issued->second.count = count;
  return Verdict::kGood;
}

std::string Login::challenge(bool is_stale, double now_s) {
  if (issued_.size() >= kMostIssued) {
    issued_.erase(
        std::ranges::min_element(issued_, {}, [](const auto& nonce) { return nonce.second.at_s; }));
  }
  const std::string nonce = fmt::format("{:016x}{:016x}", random_(), random_());
  issued_[nonce] = {now_s, 0};
  return fmt::format(R"(Digest realm="{}", qop="auth", algorithm=MD5, nonce="{}"{})", kRealm, nonce,
                     is_stale ? ", stale=true" : "");
}

}  // namespace ols::sim
