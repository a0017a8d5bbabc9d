#include "export/address.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace ols::exports {
namespace {

TEST(ExportAddress, UdpWithItsOptions) {
  const Address address = parse_address("udp://239.2.3.1:6969?ttl=3&interface=10.0.0.5");
  EXPECT_EQ(address.scheme, Scheme::kUdp);
  EXPECT_EQ(address.host, "239.2.3.1");
  EXPECT_EQ(address.port, 6969);
  EXPECT_EQ(address.ttl, 3);
  EXPECT_EQ(address.interface, "10.0.0.5");
}

TEST(ExportAddress, BrokersHaveAPortOfTheirOwn) {
  EXPECT_EQ(parse_address("mqtt://broker").port, 1883);
  EXPECT_EQ(parse_address("mqtts://broker").port, 8883);
  EXPECT_EQ(parse_address("mqtt://broker:99").port, 99);
}

TEST(ExportAddress, IPv6StandsInBrackets) {
  const Address address = parse_address("tls://[fd00::1]:8089");
  EXPECT_EQ(address.host, "fd00::1");
  EXPECT_EQ(address.port, 8089);
}

TEST(ExportAddress, AFileIsNamedByItsWholePath) {
  EXPECT_EQ(parse_address("file:///srv/site.kml").path, "/srv/site.kml");
  EXPECT_THROW(parse_address("file://site.kml"), std::invalid_argument);
  EXPECT_THROW(parse_address("file:///srv/"), std::invalid_argument);
}

TEST(ExportAddress, RefusesWhatIsNone) {
  for (const char* text :
       {"", "http://a:1", "udp:/1.2.3.4:5", "udp://name:5", "udp://1.2.3.4", "tcp://:5",
        "tcp://a:0", "tcp://a:65536", "tcp://a:5x", "tcp://a b:5", "tcp://a:5?ttl=1",
        "udp://1.2.3.4:5?hops=1", "udp://1.2.3.4:5?ttl=256", "udp://1.2.3.4:5?interface=eth0",
        "udp://239.2.3.1:5?interface=fe80::1", "udp://1.2.3.4:5?interface=1.2.3.4",
        "udp://[ff02::1]:5?interface=10.0.0.5", "tls://[fd00::1:8089"}) {
    EXPECT_THROW(parse_address(text), std::invalid_argument) << text;
  }
}

}  // namespace
}  // namespace ols::exports
