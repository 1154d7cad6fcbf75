// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <system_error>

#include "c_api/handles.h"
#include "patchproof/contract.h"

namespace patchproof::c_api {
namespace {

std::atomic<Shell*> freed_shells{nullptr};

}  // namespace

void keep_for_ever(Shell& shell) noexcept {
  shell.next_freed = freed_shells.load(std::memory_order_relaxed);
  while (!freed_shells.compare_exchange_weak(shell.next_freed, &shell)) {
  }
}

void write_text(std::string_view text, char* buffer, std::size_t length, std::size_t* needed) {
  require_array(buffer, length, "buffer");
  require_place(needed, "needed");
  *needed = text.size() + 1;
  if (length < *needed)
    throw Failure{PATCHPROOF_BUFFER_TOO_SMALL,
                  {ErrorCode::usage, "length", "the buffer has to hold " + std::to_string(*needed) + " bytes",
                   std::to_string(length)}};
  std::memcpy(buffer, text.data(), text.size());
  buffer[text.size()] = '\0';
}

}  // namespace patchproof::c_api

using namespace patchproof;         // NOLINT: the file's functions are C's
using namespace patchproof::c_api;  // NOLINT

void patchproof_context::clear() noexcept {
  status = PATCHPROOF_OK;
  for (std::string* text : {&code, &where, &message, &values, &line}) text->clear();
}

void patchproof_context::set(patchproof_status failed, const Error& error) {
  status = failed;
  if (failed == PATCHPROOF_BAD_DATA) code = to_string(error.code);
  where = error.where;
  message = error.message;
  values = error.values;
  line = error.text();
  if (failed != PATCHPROOF_BAD_DATA)  // the code says nothing there
    line.replace(line.rfind(" ("), std::string::npos, std::string(" (") + patchproof_status_name(failed) + ")");
  for (char& c : line)  // names and values may hold anything
    if (static_cast<unsigned char>(c) < ' ') c = ' ';
}

patchproof_status patchproof_context::status_of_exception() noexcept {
  patchproof_status failed = PATCHPROOF_INTERNAL_ERROR;
  try {
    try {
      throw;
    } catch (const Failure& failure) {
      failed = failure.status;
      set(failed, failure.error);
    } catch (const std::bad_alloc&) {
      failed = PATCHPROOF_OUT_OF_MEMORY;
      set(failed, {ErrorCode::usage, "", "there is not enough memory", ""});
    } catch (const std::length_error&) {
      failed = PATCHPROOF_OUT_OF_MEMORY;
      set(failed, {ErrorCode::usage, "", "more would be needed than memory can hold", ""});
    } catch (const std::system_error& e) {
      failed = PATCHPROOF_OUT_OF_MEMORY;
      set(failed, {ErrorCode::usage, "", "the system has no more threads or memory to give", e.what()});
    } catch (const std::exception& e) {
      set(failed, {ErrorCode::usage, "", "an error of the library, please report it", e.what()});
    } catch (...) {
      set(failed, {ErrorCode::usage, "", "an error of the library, please report it", ""});
    }
  } catch (...) {  // no memory for the texts
    clear();
  }
  status = failed;
  return failed;
}

uint32_t patchproof_abi_version(void) noexcept { return PATCHPROOF_ABI_VERSION; }

const char* patchproof_version(void) noexcept { return PATCHPROOF_VERSION; }

const char* patchproof_status_name(patchproof_status status) noexcept {
  static constexpr std::array kNames{"PATCHPROOF_OK",
                                     "PATCHPROOF_BAD_DATA",
                                     "PATCHPROOF_BAD_ARGUMENT",
                                     "PATCHPROOF_BUFFER_TOO_SMALL",
                                     "PATCHPROOF_FREED_HANDLE",
                                     "PATCHPROOF_CONTEXT_BUSY",
                                     "PATCHPROOF_STOPPED",
                                     "PATCHPROOF_CALLBACK_THREW",
                                     "PATCHPROOF_OUT_OF_MEMORY",
                                     "PATCHPROOF_INTERNAL_ERROR"};
  return status >= 0 && static_cast<std::size_t>(status) < kNames.size() ? kNames[static_cast<std::size_t>(status)]
                                                                         : "unknown status";
}

patchproof_text patchproof_from(const char* text) noexcept { return {text, text == nullptr ? 0 : std::strlen(text)}; }

patchproof_status patchproof_context_create(uint32_t flags, patchproof_context** out) noexcept {
  if (out == nullptr || (flags & ~std::uint32_t{PATCHPROOF_KEEP_FREED_HANDLES}) != 0) return PATCHPROOF_BAD_ARGUMENT;
  patchproof_context* context = new (std::nothrow) patchproof_context((flags & PATCHPROOF_KEEP_FREED_HANDLES) != 0);
  if (context == nullptr) return PATCHPROOF_OUT_OF_MEMORY;
  *out = context;
  return PATCHPROOF_OK;
}

patchproof_status patchproof_context_free(patchproof_context* context) noexcept {
  if (context == nullptr) return PATCHPROOF_OK;
  if (!context->alive) return PATCHPROOF_FREED_HANDLE;
  if (context->busy.exchange(true)) return PATCHPROOF_CONTEXT_BUSY;
  if (!context->alive.exchange(false)) return PATCHPROOF_FREED_HANDLE;
  if (!context->keep) {
    delete context;
    return PATCHPROOF_OK;
  }
  for (std::string* text : {&context->code, &context->where, &context->message, &context->values, &context->line})
    std::string().swap(*text);
  keep_for_ever(*context);
  return PATCHPROOF_OK;
}

patchproof_status patchproof_last_error(const patchproof_context* context, patchproof_error* out) noexcept {
  if (context == nullptr || out == nullptr || out->struct_size < sizeof(patchproof_error))
    return PATCHPROOF_BAD_ARGUMENT;
  if (!context->alive) return PATCHPROOF_FREED_HANDLE;
  if (context->busy.load(std::memory_order_acquire)) return PATCHPROOF_CONTEXT_BUSY;  // its texts are being written
  *out = {out->struct_size,           context->status,          borrowed(context->code), borrowed(context->where),
          borrowed(context->message), borrowed(context->values)};
  return PATCHPROOF_OK;
}

const char* patchproof_error_text(const patchproof_context* context) noexcept {
  if (context == nullptr) return "PATCHPROOF_BAD_ARGUMENT: the context is NULL";
  if (!context->alive) return "PATCHPROOF_FREED_HANDLE: the context was freed before this call";
  if (context->busy.load(std::memory_order_acquire)) return "PATCHPROOF_CONTEXT_BUSY: another call uses the context";
  // Where there was no memory for the text.
  if (context->line.empty() && context->status != PATCHPROOF_OK) return patchproof_status_name(context->status);
  return context->line.c_str();
}
