// SPDX-License-Identifier: Apache-2.0
// libFuzzer target: any bytes under the extension of one format (PATCHPROOF_FUZZ_EXTENSION), so that each reader has its
// own program and its own seeds.
//
// Checked: no crash, no leak, no undefined behaviour (by the sanitizers), no exception; an error has a place and a sentence;
// what was read is written as our JSON and comes back as the same bytes.
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>
#include <variant>

#include "patchproof/io/read.h"
#include "patchproof/io/write.h"

using namespace patchproof;

namespace {

void check(bool law) {
  if (!law) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  for (const Decimals decimals : {Decimals::exact, Decimals::binary64}) {
    const Result<ModelFile> file = read_model_text(bytes, "fuzz" PATCHPROOF_FUZZ_EXTENSION, decimals);
    if (!file) {
      check(file.error().where.rfind("fuzz", 0) == 0 && !file.error().message.empty());
      continue;
    }
    std::visit(
        [](const auto& model) {
          using M = std::decay_t<decltype(model)>;
          check(!model.patches.empty() || !model.curves.empty() || !model.gregory_patches.empty() ||
                !model.gerbs_patches.empty() || !model.gerbs_curves.empty());
          const std::string text = write_model_json(model);
          const Result<ModelFile> back = read_model_text(text, "back.json");
          if (!back) {  // only fractions with more characters than a number may have are refused (io/write.h)
            check(back.error().code == ErrorCode::bad_number && text.size() > kMaxDigits);
            return;
          }
          // A model read over Q(√d) whose roots all cancel comes back over Q.
          if (const M* same = std::get_if<M>(&back->model)) check(write_model_json(*same) == text);
        },
        file->model);
  }
  return 0;
}
