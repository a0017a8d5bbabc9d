// Complete answers for ols-setup, for a station and for a centre.
#pragma once

#include <string>

#include "tests/unit/base/trust/site_fixture.h"
#include "tools/key/invitation.h"

namespace ols::setup {

inline const trust::Site kSite;

inline std::string station_answers(const std::string& more = "") {
  return "role = \"station\"\n"
         "interface = \"eth0\"\n"
         "invitation = \"" +
         key::to_text({kSite.secret, kSite.root.public_key()}) +
         "\"\n"
         "[station]\n"
         "id = \"alfa\"\n"
         "[station.pose]\n"
         "latitude_deg = 49.2\n"
         "longitude_deg = 16.6\n"
         "height_m = 310.0\n"
         "heading_deg = 45.0\n"
         "[station.calibration.sd]\n"
         "heading_deg = 0.5\n"
         "mount_deg = 0.1\n"
         "[station.lens]\n"
         "fx_px = 13333.3\n"
         "fy_px = 13333.3\n" +
         more;
}

inline std::string devices(const std::string& camera = "Maker-1",
                           const std::string& ptu = "/dev/p") {
  return "[station.camera]\ndevice = \"" + camera + "\"\n[station.ptu]\ndevice = \"" + ptu + "\"\n";
}

inline const std::string kCentreAnswers =
    "role = \"centre\"\nsite = \"airfield\"\nroot = \"/media/root.key\"\ninterface = \"eth0\"\n"
    "[logger]\nquota_gb = 5.0\n";

}  // namespace ols::setup
