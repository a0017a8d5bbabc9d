#include "export/sapient/sapient_dialogue.h"

#include <stdexcept>

#include "base/text/plain_text.h"
#include "export/sapient/frame.h"
#include "export/sapient/sapient_messages.h"
#include "sapient/sapient.pb.h"

namespace ols::exports {
namespace {

constexpr std::size_t kLongestWords = 200;

template <class Texts>
std::string in_one_line(const Texts& texts) {
  std::string all;
  for (const std::string& text : texts) all.append(all.empty() ? "" : "; ").append(text);
  if (all.size() > kLongestWords) all.resize(kLongestWords);
  return plain_text(all);
}

}  // namespace

void SapientDialogue::clear() {
  bytes_.clear();
  acceptance_.reset();
  refusal_.clear();
}

void SapientDialogue::read(const std::string& message, std::int64_t utime_us,
                           std::vector<std::string>& answers) {
  sapient::SapientMessage said;
  if (!said.ParseFromString(message)) throw std::runtime_error("does not speak SAPIENT");
  // Some receivers send to all, without a destination.
  if (said.has_destination_id() && said.destination_id() != node_id(settings_)) return;
  if (said.has_registration_ack()) {
    acceptance_ = said.registration_ack().acceptance();
    refusal_ = in_one_line(said.registration_ack().ack_response_reason());
  } else if (said.has_task()) {
    answers.push_back(
        sapient_task_refusal(settings_, said.task().task_id(), said.node_id(), utime_us));
  } else if (said.has_error()) {
    ++complaints_;
    complaint_ = in_one_line(said.error().error_message());
  }
}

std::vector<std::string> SapientDialogue::take(std::string_view bytes, std::int64_t utime_us) {
  bytes_.append(bytes);
  std::vector<std::string> answers;
  std::size_t taken = 0;
  while (const auto length = framed_length(std::string_view(bytes_).substr(taken))) {
    if (*length > kLongest_bytes) throw std::runtime_error("does not speak SAPIENT");
    const std::size_t begin = taken + kFrameHead_bytes;
    if (bytes_.size() - begin < *length) break;
    read(bytes_.substr(begin, *length), utime_us, answers);
    taken = begin + *length;
  }
  bytes_.erase(0, taken);
  return answers;
}

}  // namespace ols::exports
