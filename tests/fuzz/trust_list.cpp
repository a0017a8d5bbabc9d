// Trust lists and key files as texts: refused with an error that names the file, or the same when
// written and read again. The list is read as one that its own root has signed, and as a body that
// the fuzzer's root signs: what is signed may be nonsense too.
#include "base/trust/trust_list.h"

#include <string>

#include "base/config/toml_config.h"
#include "base/trust/replay_marks.h"
#include "tests/fuzz/fuzz_input.h"

namespace {

namespace trust = ols::trust;

void read(const std::string& text, const trust::SigningKey& root) {
  try {
    const trust::TrustList list = trust::read_list(text, "trust.toml", root.public_key());
    const std::string again = trust::sign_list(list, root);
    const trust::TrustList same = trust::read_list(again, "again", root.public_key());
    ols::fuzz::require(same.members.size() == list.members.size() && same.number == list.number,
                       "what was read is written");
  } catch (const ols::ConfigError& error) {
    ols::fuzz::require(std::string(error.what()).starts_with("trust.toml"), "it names the file");
  }
}

std::string signed_text(const std::string& body, const trust::SigningKey& root) {
  const std::string text = "OLS-trust-v1" + body;
  const auto signature =
      root.sign({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
  return body + "# signature " + trust::to_hex(signature) + "\n";
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const trust::SigningKey kRoot(trust::Seed{1});
  const std::string text(ols::fuzz::text(data, size));
  read(text, kRoot);
  std::string body = text;
  if (!body.empty() && body.back() != '\n') body += '\n';
  const std::string root_line = "root = \"" + trust::to_hex(kRoot.public_key()) + "\"\n";
  read(signed_text(root_line + body, kRoot), kRoot);
  trust::ReplayMarks marks;
  marks.read(text);
  trust::ReplayMarks again;
  ols::fuzz::require(again.read(marks.text()) == 0, "marks are read as they were written");
  return 0;
}
