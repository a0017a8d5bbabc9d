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
           "password = \"\"\"\n" + secret + "\nx\"\"\"",
           "tokens = [\"a\", \"" + secret + "\"]",
           "tokens = [\n  \"a\",\n  \"" + secret + "\"]",
           R"(password = "a\"b )" + secret + "\"",
           R"(key_mgmt=WPA-PSK psk="two )" + secret + "\"",
           "wlan0 scan key 0 \"" + secret + "\"",
           "PASS=ab " + secret,
           "PASS=\"ab\n" + secret + "\"",
           "PASS=ab\\\n" + secret,
           "password=a b " + secret,
           "pwd = " + secret,
           "mosquitto_pub --password a " + secret,
           "the passwd is " + secret,
           "passphrase_2\t" + secret,
           "password_hash = x " + secret,
           "passwordHash: x " + secret,
           "me:$argon2id$v=19$m=65536$" + secret,
           "Authorization: Bearer " + secret,
           "curl -H 'Authorization: Basic " + secret + "'",
           "<password>" + secret + "</password>",
           "mqtt://me:p@" + secret + "@example.org/x",
       }) {
    const std::string shown = without_secrets(text);
    EXPECT_THAT(shown, Not(HasSubstr(secret))) << text;
    EXPECT_THAT(shown, Not(HasSubstr(hex))) << text;
    EXPECT_THAT(shown, HasSubstr("[removed]")) << text;
  }
}

TEST(Secrets, WhatIsOpenEnds) {
  EXPECT_EQ(without_secrets("A_KEY='x\ny'\nstays = 1\n"), "A_KEY=[removed]\n\nstays = 1\n");
  EXPECT_EQ(without_secrets("A_KEY=[x\ny]\nstays = 1\n"), "A_KEY=[removed]\n\nstays = 1\n");
  EXPECT_EQ(without_secrets("A_KEY=x\\\ny\nstays = 1\n"), "A_KEY=[removed]\n\nstays = 1\n");
}

TEST(Secrets, OfTomlAreFoundByItsGrammar) {
  const std::string text = R"(# The old password: Zebra-77
name = "ä"
password = """
Zebra-77
"""   # Zebra-77
users = [{ name = "ä", password = "Zebra-77", port = 1 }, { "ä token" = 'Zebra-77' }]
tokens = [ # two
  "a",
  ["Zebra-77"],
]
[passwords]
alfa = "Zebra-77"
more = { bravo = ["Zebra-77"] }
[link]
url = "mqtt://me:p@Zebra-77@example.org/x"
text = """
psk=Zebra-77
"""
stays = 1
)";
  const std::string shown = without_secrets_of_toml(text);
  EXPECT_EQ(shown, R"(# The old password: [removed]
name = "ä"
password = [removed]


users = [{ name = "ä", password = [removed]
tokens = [removed]



[passwords]
alfa = [removed]
more = { bravo = [removed]
[link]
url = "mqtt://[removed]@example.org/x"
text = """
psk=[removed]
"""
stays = 1
)");
}

TEST(Secrets, OfWhatIsNoTomlNothingIsShown) {
  EXPECT_EQ(without_secrets_of_toml("stays = 1\nx = \"\"\"Zebra-77\n"),
            "not TOML, and so not shown: line 2, column 17\n");
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
