#include "sim/onvif/login.h"

#include <fmt/format.h>
#include <sodium.h>

#include <algorithm>
#include <boost/uuid/detail/md5.hpp>
#include <boost/uuid/detail/sha1.hpp>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <limits>

namespace ols::sim {
namespace {

constexpr const char* kRealm = "onvif";
constexpr std::size_t kMostSeen = 1000, kMostIssued = 64;

// Boost's words have the first byte uppermost.
template <class Hash>
std::string hashed(const std::string& text) {
  Hash hash;
  hash.process_bytes(text.data(), text.size());
  typename Hash::digest_type words{};
  hash.get_digest(words);
  std::string bytes;
  for (const unsigned word : words)
    for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(word >> shift & 0xffU);
  return bytes;
}

std::string md5_hex(const std::string& text) {
  std::string hex;
  for (const char c : hashed<boost::uuids::detail::md5>(text))
    hex += fmt::format("{:02x}", static_cast<unsigned char>(c));
  return hex;
}

std::string base64(const std::string& bytes) {
  std::string text(sodium_base64_ENCODED_LEN(bytes.size(), sodium_base64_VARIANT_ORIGINAL), '\0');
  sodium_bin2base64(text.data(), text.size(), reinterpret_cast<const unsigned char*>(bytes.data()),
                    bytes.size(), sodium_base64_VARIANT_ORIGINAL);
  text.pop_back();  // the zero at its end
  return text;
}

// Empty: not base64.
std::string from_base64(const std::string& text) {
  std::string bytes(text.size(), '\0');
  std::size_t size = 0;
  const bool good =
      sodium_base642bin(reinterpret_cast<unsigned char*>(bytes.data()), bytes.size(), text.data(),
                        text.size(), nullptr, &size, nullptr, sodium_base64_VARIANT_ORIGINAL) == 0;
  bytes.resize(good ? size : 0);
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
  std::tm parts{};
  double second = 0.0;
  if (std::sscanf(date_time.c_str(), "%4d-%2d-%2dT%2d:%2d:%lf", &parts.tm_year, &parts.tm_mon,
                  &parts.tm_mday, &parts.tm_hour, &parts.tm_min, &second) != 6) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  parts.tm_year -= 1900;
  parts.tm_mon -= 1;
  return static_cast<double>(timegm(&parts)) + second;
}

std::string date_time_of(std::int64_t utime_us) {
  const std::time_t utc_s = utime_us / 1'000'000;
  std::tm parts{};
  gmtime_r(&utc_s, &parts);
  return fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}.{:03}Z", parts.tm_year + 1900,
                     parts.tm_mon + 1, parts.tm_mday, parts.tm_hour, parts.tm_min, parts.tm_sec,
                     utime_us / 1000 % 1000);
}

Login::Login(std::string user, std::string password, std::uint64_t seed)
    : user_(std::move(user)), password_(std::move(password)), random_(seed) {}

bool Login::accepts(const UsernameToken& token, double utc_s) {
  const std::string right = base64(
      hashed<boost::uuids::detail::sha1>(from_base64(token.nonce) + token.created + password_));
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
