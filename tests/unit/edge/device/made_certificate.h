// A self-signed certificate, made by OpenSSL.
#pragma once

#include <openssl/evp.h>
#include <openssl/pem.h>
#include <openssl/sha.h>
#include <openssl/x509.h>
#include <openssl/x509v3.h>

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace ols::device {

struct MadeCertificate {
  std::string pem;  // certificate and private key
  std::vector<std::uint8_t> der;
  std::string pin;  // as curl's manual has it: openssl pkey -pubin -outform der | openssl dgst ...
};

// Valid from yesterday for `days`; negative: it has expired.
inline MadeCertificate made_certificate(const std::string& host, int days = 2) {
  constexpr long kDay_s = 86400;
  const std::unique_ptr<EVP_PKEY, decltype(&EVP_PKEY_free)> key(EVP_EC_gen("P-256"), EVP_PKEY_free);
  const std::unique_ptr<X509, decltype(&X509_free)> x509(X509_new(), X509_free);
  X509_set_version(x509.get(), 2);
  ASN1_INTEGER_set(X509_get_serialNumber(x509.get()), 1);
  X509_gmtime_adj(X509_getm_notBefore(x509.get()), -10 * kDay_s);
  X509_gmtime_adj(X509_getm_notAfter(x509.get()), days * kDay_s);
  X509_set_pubkey(x509.get(), key.get());
  X509_NAME* name = X509_get_subject_name(x509.get());
  X509_NAME_add_entry_by_txt(name, "CN", MBSTRING_ASC,
                             reinterpret_cast<const unsigned char*>(host.c_str()), -1, -1, 0);
  X509_set_issuer_name(x509.get(), name);
  X509_EXTENSION* names =
      X509V3_EXT_conf_nid(nullptr, nullptr, NID_subject_alt_name, ("DNS:" + host).c_str());
  X509_add_ext(x509.get(), names, -1);
  X509_EXTENSION_free(names);
  X509_sign(x509.get(), key.get(), EVP_sha256());

  MadeCertificate made;
  const std::unique_ptr<BIO, decltype(&BIO_free)> text(BIO_new(BIO_s_mem()), BIO_free);
  PEM_write_bio_X509(text.get(), x509.get());
  PEM_write_bio_PrivateKey(text.get(), key.get(), nullptr, nullptr, 0, nullptr, nullptr);
  char* bytes = nullptr;
  const long length = BIO_get_mem_data(text.get(), &bytes);
  made.pem.assign(bytes, static_cast<std::size_t>(length));
  unsigned char* der = nullptr;
  const int der_bytes = i2d_X509(x509.get(), &der);
  made.der.assign(der, der + der_bytes);
  OPENSSL_free(der);
  unsigned char* info = nullptr;
  const int info_bytes = i2d_X509_PUBKEY(X509_get_X509_PUBKEY(x509.get()), &info);
  std::array<unsigned char, SHA256_DIGEST_LENGTH> hash{};
  SHA256(info, static_cast<std::size_t>(info_bytes), hash.data());
  OPENSSL_free(info);
  std::array<unsigned char, 64> base64{};
  EVP_EncodeBlock(base64.data(), hash.data(), static_cast<int>(hash.size()));
  made.pin = "sha256//" + std::string(reinterpret_cast<const char*>(base64.data()));
  return made;
}

}  // namespace ols::device
