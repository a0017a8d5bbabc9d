#include "edge/mount/onvif/http_link.h"

#include <curl/curl.h>
#include <strings.h>

#include <array>
#include <atomic>
#include <string_view>

#include "edge/device/certificate_key.h"

namespace ols::onvif {
namespace {

constexpr int kPoll_ms = 200;

struct Received {
  HttpLink::Answer answer;
  bool too_long = false;
};

std::size_t take_body(char* bytes, std::size_t, std::size_t size, void* to) {
  auto& received = *static_cast<Received*>(to);
  received.too_long = received.answer.body.size() + size > HttpLink::kLongestAnswer;
  if (received.too_long) return 0;
  received.answer.body.append(bytes, size);
  return size;
}

std::size_t take_header(char* bytes, std::size_t, std::size_t size, void* to) {
  constexpr std::string_view kOffer = "WWW-Authenticate: Digest";
  if (size >= kOffer.size() && strncasecmp(bytes, kOffer.data(), kOffer.size()) == 0)
    static_cast<Received*>(to)->answer.offers_digest = true;
  return size;
}

}  // namespace

struct HttpLink::Impl {
  explicit Impl(const Config& wanted) : config(wanted) {
    static const CURLcode started = curl_global_init(CURL_GLOBAL_DEFAULT);
    if (started == CURLE_OK) easy = curl_easy_init(), multi = curl_multi_init();
    if (easy == nullptr || multi == nullptr) throw HttpError("libcurl cannot be started");
    prepare();
  }
  ~Impl() {
    curl_easy_cleanup(easy);
    curl_multi_cleanup(multi);
  }

  // Forgets an earlier login: libcurl would try a refused one twice.
  void prepare() {
    curl_easy_reset(easy);
    const auto timeout_ms = static_cast<long>(1e3 * config.timeout_s);
    set(CURLOPT_NOSIGNAL, 1L);
    set(CURLOPT_TIMEOUT_MS, timeout_ms);
    set(CURLOPT_PROTOCOLS_STR, "http,https");
    set(CURLOPT_PROXY, "");
    set(CURLOPT_FOLLOWLOCATION, 0L);
    set(CURLOPT_WRITEFUNCTION, take_body);
    set(CURLOPT_HEADERFUNCTION, take_header);
    set(CURLOPT_ERRORBUFFER, trouble.data());
    if (config.pinned_key.empty()) return;
    set(CURLOPT_PINNEDPUBLICKEY, config.pinned_key.c_str());
    set(CURLOPT_SSL_VERIFYPEER, 0L);
    set(CURLOPT_SSL_VERIFYHOST, 0L);
  }

  template <class Value>
  void set(CURLoption option, Value value) {
    if (curl_easy_setopt(easy, option, value) != CURLE_OK)
      throw HttpError("libcurl refuses an option");
  }

  // The key of the camera's certificate. Nothing is sent to the camera.
  std::string key_at(const std::string& url) {
    prepare();
    set(CURLOPT_URL, url.c_str());
    set(CURLOPT_CONNECT_ONLY, 1L);
    set(CURLOPT_CERTINFO, 1L);
    set(CURLOPT_PINNEDPUBLICKEY, static_cast<const char*>(nullptr));
    set(CURLOPT_SSL_VERIFYPEER, 0L);
    set(CURLOPT_SSL_VERIFYHOST, 0L);
    std::string key;
    {
      const Added added(*this);
      curl_certinfo* chain = nullptr;
      if (run() == CURLE_OK && curl_easy_getinfo(easy, CURLINFO_CERTINFO, &chain) == CURLE_OK &&
          chain != nullptr && chain->num_of_certs > 0) {
        for (const curl_slist* line = chain->certinfo[0]; line != nullptr; line = line->next)
          if (key.empty()) key = device::certificate_key_of_pem(line->data);
      }
    }
    prepare();
    return key;
  }

  [[noreturn]] void refuse(const std::string& url) {
    std::string words = trouble.data();
    const std::string key = key_at(url);
    if (!config.pinned_key.empty()) words = "its key is not pinned_key";
    if (!key.empty()) words += "; its key is " + key;
    throw CertificateRefused("certificate refused: " + words, key);
  }

  struct Added {
    Impl& link;
    explicit Added(Impl& to) : link(to) { curl_multi_add_handle(link.multi, link.easy); }
    ~Added() { curl_multi_remove_handle(link.multi, link.easy); }
    Added(const Added&) = delete;
    Added& operator=(const Added&) = delete;
  };

  // Runs until the exchange has ended.
  CURLcode run() {
    for (;;) {
      int running = 0, left = 0;
      curl_multi_perform(multi, &running);
      while (const CURLMsg* message = curl_multi_info_read(multi, &left)) {
        if (message->msg == CURLMSG_DONE) return message->data.result;
      }
      if (interrupted) throw Interrupted();
      curl_multi_poll(multi, nullptr, 0, kPoll_ms, nullptr);
    }
  }

  const Config config;
  bool digest = false;  // the last exchange logged in by it
  CURL* easy = nullptr;
  CURLM* multi = nullptr;
  std::array<char, CURL_ERROR_SIZE> trouble{};
  std::atomic<bool> interrupted = false;
};

HttpLink::HttpLink(const Config& config) : impl_(std::make_unique<Impl>(config)) {}
HttpLink::~HttpLink() = default;

HttpLink::Answer HttpLink::post(const std::string& url, const std::string& action,
                                const std::string& text, const Credentials* digest) {
  Impl& link = *impl_;
  if (link.interrupted) throw Interrupted();
  Received received;
  link.trouble[0] = '\0';
  if ((digest != nullptr) != link.digest) link.prepare();
  link.digest = digest != nullptr;
  const std::string type =
      "Content-Type: application/soap+xml; charset=utf-8; action=\"" + action + "\"";
  const std::unique_ptr<curl_slist, decltype(&curl_slist_free_all)> headers(
      curl_slist_append(curl_slist_append(nullptr, type.c_str()), "Expect:"), curl_slist_free_all);
  link.set(CURLOPT_URL, url.c_str());
  link.set(CURLOPT_HTTPHEADER, headers.get());
  link.set(CURLOPT_POSTFIELDSIZE, static_cast<long>(text.size()));
  link.set(CURLOPT_POSTFIELDS, text.c_str());
  link.set(CURLOPT_WRITEDATA, &received);
  link.set(CURLOPT_HEADERDATA, &received);
  link.set(CURLOPT_HTTPAUTH, digest == nullptr ? CURLAUTH_NONE : CURLAUTH_DIGEST);
  link.set(CURLOPT_USERNAME, digest == nullptr ? nullptr : digest->user.c_str());
  link.set(CURLOPT_PASSWORD, digest == nullptr ? nullptr : digest->password.c_str());
  const CURLcode result = [&] {
    const Impl::Added added(link);
    return link.run();
  }();
  if (received.too_long) throw HttpError("the answer is too long");
  if (result == CURLE_PEER_FAILED_VERIFICATION || result == CURLE_SSL_PINNEDPUBKEYNOTMATCH)
    link.refuse(url);
  if (result != CURLE_OK)
    throw HttpError(link.trouble[0] == '\0' ? curl_easy_strerror(result) : link.trouble.data());
  curl_easy_getinfo(link.easy, CURLINFO_RESPONSE_CODE, &received.answer.status);
  return received.answer;
}

void HttpLink::interrupt() {
  impl_->interrupted = true;
  curl_multi_wakeup(impl_->multi);
}

void HttpLink::resume() { impl_->interrupted = false; }

}  // namespace ols::onvif
