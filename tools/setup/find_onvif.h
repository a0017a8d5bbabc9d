// Finds ONVIF cameras on the networks of this host, and queries what a camera offers. Moves
// nothing.
#pragma once

#include <string>
#include <vector>

#include "edge/mount/onvif/discovery.h"
#include "edge/mount/onvif/onvif_link.h"
#include "tools/setup/host.h"

namespace ols::setup {

// Finds the cameras. Prints the answers that it cannot use.
std::vector<onvif::FoundCamera> find_onvif();

// A camera in words, such as "PTZ 4 at http://10.0.0.5/onvif/device_service".
std::string words_of(const onvif::FoundCamera& camera);

// Queries what a camera offers. `url`: of its device service. Throws onvif::LoginRefused,
// onvif::AnswerError, onvif::HttpError.
onvif::Offer learn_onvif(const std::string& url, const onvif::Credentials& login,
                         const std::string& pinned_key);

// Asks a person for a login. The password is not shown while it is typed.
onvif::Credentials ask_login();

// Stores the password in a file that only the host's services can read; returns the path.
std::string keep_password(const Host& host, const std::string& station,
                          const std::string& password);

}  // namespace ols::setup
