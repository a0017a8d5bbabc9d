#include "tools/setup/find_onvif.h"

#include <fcntl.h>
#include <grp.h>
#include <sys/stat.h>
#include <termios.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <iostream>
#include <system_error>

#include "base/files/atomic_file.h"
#include "base/text/plain_text.h"
#include "edge/mount/onvif/discovery_link.h"
#include "tools/setup/dialogue.h"

namespace ols::setup {
namespace {

constexpr double kLook_s = 2.0, kPatience_s = 5.0;
constexpr const char* kNobody = "none";

// Hides what is typed at the terminal.
class Unseen {
 public:
  Unseen() : changed_(::tcgetattr(STDIN_FILENO, &before_) == 0) {
    if (!changed_) return;  // no terminal
    termios quiet = before_;
    quiet.c_lflag &= ~static_cast<tcflag_t>(ECHO);
    ::tcsetattr(STDIN_FILENO, TCSAFLUSH, &quiet);
  }
  ~Unseen() {
    if (!changed_) return;
    ::tcsetattr(STDIN_FILENO, TCSAFLUSH, &before_);
    std::cout << "\n";
  }
  Unseen(const Unseen&) = delete;
  Unseen& operator=(const Unseen&) = delete;

 private:
  termios before_{};
  bool changed_;
};

}  // namespace

std::vector<onvif::FoundCamera> find_onvif() {
  try {
    const onvif::Discovery found = onvif::look_for_cameras(kLook_s);
    for (const std::string& refused : found.refused())
      std::printf("not used: %s\n", plain_text(refused).c_str());
    return found.cameras();
  } catch (const std::system_error& error) {  // a host without a network
    std::printf("no ONVIF cameras: %s\n", error.what());
    return {};
  }
}

std::string words_of(const onvif::FoundCamera& camera) {
  return plain_text((camera.name.empty() ? "ONVIF camera" : camera.name) + " at " + camera.url);
}

onvif::Offer learn_onvif(const std::string& url, const onvif::Credentials& login,
                         const std::string& pinned_key) {
  return onvif::OnvifLink({kPatience_s, pinned_key}, url, login).offer();
}

onvif::Credentials ask_login() {
  onvif::Credentials login;
  login.user = ask_text(std::cin, std::cout, "User name at the camera, or \"none\":");
  if (login.user == kNobody) return {};
  const Unseen unseen;
  login.password = ask_text(std::cin, std::cout, "That user's password:");
  return login;
}

std::string keep_password(const Host& host, const std::string& station,
                          const std::string& password) {
  const std::string path = "/etc/ols/" + station + ".camera-password";
  host.folder("/etc/ols", 0755);
  // First the file with its mode and group: AtomicFile keeps both.
  constexpr mode_t kOwnerAndGroup = 0640;
  const int file = ::open(host.path(path).c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, kOwnerAndGroup);
  if (file < 0) throw std::system_error(errno, std::generic_category(), host.path(path));
  const group* services = host.is_this_host() ? ::getgrnam("ols") : nullptr;
  const bool kept = ::fchmod(file, kOwnerAndGroup) == 0 &&
                    (services == nullptr || ::fchown(file, 0, services->gr_gid) == 0);
  ::close(file);
  if (!kept) throw std::system_error(errno, std::generic_category(), host.path(path));
  AtomicFile text(host.path(path));
  text.stream() << password << "\n";
  text.commit();
  return path;
}

}  // namespace ols::setup
