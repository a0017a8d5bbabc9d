// Finds ONVIF cameras on the networks of this host, and learns what one can do. Nothing is moved.
#pragma once

#include <string>
#include <vector>

#include "edge/mount/onvif/discovery.h"
#include "edge/mount/onvif/onvif_link.h"
#include "tools/setup/host.h"

namespace ols::setup {

// Reports the answers that were refused.
std::vector<onvif::FoundCamera> find_onvif();

// "PTZ 4 at http://10.0.0.5/onvif/device_service"
std::string words_of(const onvif::FoundCamera& camera);

// What the camera offers whose device service is at `url`. Throws onvif::LoginRefused,
// onvif::AnswerError, onvif::HttpError.
onvif::Offer learn_onvif(const std::string& url, const onvif::Credentials& login,
                         const std::string& pinned_key);

// A person's login. The password is not shown while it is typed.
onvif::Credentials ask_login();

// Keeps the password in a file of the host that only the services can read; returns its path.
std::string keep_password(const Host& host, const std::string& station,
                          const std::string& password);

}  // namespace ols::setup
