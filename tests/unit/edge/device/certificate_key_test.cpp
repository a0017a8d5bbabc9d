#include "edge/device/certificate_key.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "tests/unit/edge/device/made_certificate.h"

namespace ols::device {
namespace {

TEST(CertificateKey, IsThatOfOpenSsl) {
  const MadeCertificate made = made_certificate("camera");
  EXPECT_EQ(certificate_key(made.der), made.pin);
  EXPECT_EQ(certificate_key_of_pem("Cert:" + made.pem), made.pin);
  EXPECT_NE(made_certificate("camera").pin, made.pin);
  check_pinned_key(made.pin);
}

TEST(CertificateKey, WhatIsNoCertificateHasNone) {
  const auto der = made_certificate("camera").der;
  for (std::size_t bytes = 0; bytes < der.size(); ++bytes)
    EXPECT_EQ(certificate_key(std::span(der).first(bytes)), "") << bytes;
  const std::vector<std::uint8_t> endless{0x30, 0x84, 0xff, 0xff, 0xff, 0xff, 0x30};
  EXPECT_EQ(certificate_key(endless), "");
  EXPECT_EQ(certificate_key_of_pem("-----BEGIN CERTIFICATE-----\n!\n"), "");
  EXPECT_EQ(certificate_key_of_pem("nothing"), "");
}

TEST(CertificateKey, APinHasItsForm) {
  check_pinned_key("");
  for (const char* text : {"sha256//", "sha256//AAAA", "sha1//AAAA", "AAAA"})
    EXPECT_THROW(check_pinned_key(text), std::invalid_argument) << text;
}

}  // namespace
}  // namespace ols::device
