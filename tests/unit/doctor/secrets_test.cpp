#include "tools/doctor/secrets.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ols::doctor {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(Secrets, APlantedOneIsNowhere) {
  const std::string secret = "Zebra-77!", hex(64, 'a');
  for (const std::string& text : {
           "seed = \"" + secret + "\"",
           "site_key=\"" + hex + "\"",
           "invitation = \"" + hex + hex + "\"",
           "psk=" + secret,
           "wpa_passphrase: '" + secret + "'",
           "\"password\": \"" + secret + "\"",
           "ols-key make alfa --invitation " + secret,
           "PrivateKey = " + secret,
           "wifi-sec.psk:" + secret,
           "7316 SHA256 HEX:" + hex,
           "fetch https://me:" + secret + "@example.org/x",
           "-----BEGIN EC PRIVATE KEY-----\n" + secret + "\n-----END EC PRIVATE KEY-----",
           "password = \"two words " + secret + "\"",
       }) {
    const std::string shown = without_secrets(text);
    EXPECT_THAT(shown, Not(HasSubstr(secret))) << text;
    EXPECT_THAT(shown, Not(HasSubstr(hex))) << text;
    EXPECT_THAT(shown, HasSubstr("[removed]")) << text;
  }
}

TEST(Secrets, WhatHelpsStays) {
  const std::string text =
      "[pose]\nlatitude_deg = 49.2266  # WGS84 latitude.\nptu: no reply on /dev/ols/ptu\n"
      "Nov 23 10:00:00 alfa ols-station[12]: boot 7f3a clock 0.2 ms\n";
  EXPECT_EQ(without_secrets(text), text);
  const std::string after =
      without_secrets("-----BEGIN PRIVATE KEY-----\nabc\n-----END PRIVATE KEY-----\nstays = 1\n");
  EXPECT_THAT(after, HasSubstr("stays = 1"));
}

TEST(Secrets, ALongLineIsCut) {
  EXPECT_LE(without_secrets(std::string(1'000'000, 'x')).size(), kLongestLine + 1);
}

}  // namespace
}  // namespace ols::doctor
