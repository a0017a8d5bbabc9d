#include "base/trust/key_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "base/config/toml_config.h"
#include "base/files/small_file.h"
#include "base/trust/trust_words.h"

namespace ols::trust {
namespace {

constexpr std::size_t kLargest = 10'000;

std::string read_secret(const std::string& path) {
  const std::string text = read_small_file(path, kLargest);
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) {
    throw std::system_error(errno, std::generic_category(), path);
  }
  // systemd's credentials are 0440 of their own user.
  constexpr mode_t kOthers = S_IRWXO | S_IWGRP | S_IXGRP;
  if ((status.st_mode & kOthers) != 0) {
    throw ConfigError(path + ": others may read or change this private key: chmod 600");
  }
  return text;
}

void write_secret(const std::string& path, const std::string& text) {
  const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
  if (file < 0) throw std::system_error(errno, std::generic_category(), path);
  const bool written =
      ::write(file, text.data(), text.size()) == static_cast<ssize_t>(text.size()) &&
      ::fsync(file) == 0;
  const int why = errno;
  ::close(file);
  if (!written) throw std::system_error(why, std::generic_category(), path);
}

std::string line(const char* key, const std::string& value) {
  return std::string(key) + " = \"" + value + "\"\n";
}

}  // namespace

MemberKey read_member_key(const std::string& path) {
  ConfigFile file(read_secret(path), path);
  ConfigTable& table = file.root();
  table.refuse_unknown({"name", "seed", "site_key", "root"});
  MemberKey key;
  key.name = read_name(table, "name");
  key.seed = read_hex(table, "seed");
  key.site_key = read_hex(table, "site_key");
  key.root = read_hex(table, "root");
  return key;
}

RootKey read_root_key(const std::string& path) {
  ConfigFile file(read_secret(path), path);
  ConfigTable& table = file.root();
  table.refuse_unknown({"site", "seed", "site_key"});
  RootKey key;
  key.site = read_name(table, "site");
  key.seed = read_hex(table, "seed");
  key.site_key = read_hex(table, "site_key");
  return key;
}

void write_member_key(const std::string& path, const MemberKey& key) {
  write_secret(path, "# A private key: keep it to root alone, never copy it.\n" +
                         line("name", key.name) + line("seed", to_hex(key.seed)) +
                         line("site_key", to_hex(key.site_key)) + line("root", to_hex(key.root)));
}

void write_root_key(const std::string& path, const RootKey& key) {
  write_secret(path, "# The root of a site: keep it on a stick in a safe, not on any computer.\n" +
                         line("site", key.site) + line("seed", to_hex(key.seed)) +
                         line("site_key", to_hex(key.site_key)));
}

}  // namespace ols::trust
