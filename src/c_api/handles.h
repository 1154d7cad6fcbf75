// SPDX-License-Identifier: Apache-2.0
// What is behind the C API's handles, and how every one of its functions runs: call() checks the context, turns what is thrown
// into a status and its error, and gives the floating-point environment back.
#pragma once

#include <atomic>
#include <cfenv>
#include <cstring>
#include <memory>
#include <new>
#include <string>
#include <string_view>

#include "patchproof/c_api.h"
#include "patchproof/deadline.h"
#include "patchproof/error.h"
#include "patchproof/parallel.h"

namespace patchproof::c_api {

// What all handles begin with. A kept one is never given back to the system once it is freed: it tells that it is dead.
struct Shell {
  explicit Shell(bool keep_freed) : keep(keep_freed) {}
  std::atomic<bool> alive{true};
  const bool keep;
  Shell* next_freed = nullptr;
};

// Kept shells stay reachable, so that they are no leak.
void keep_for_ever(Shell& shell) noexcept;

// C: what never changes while the handle lives.
template <class C>
struct Handle : Shell {
  Handle(bool keep_freed, C value) : Shell(keep_freed), content(std::make_unique<const C>(std::move(value))) {}
  std::unique_ptr<const C> content;
};

template <class H>
patchproof_status free_handle(H* handle) noexcept {
  if (handle == nullptr) return PATCHPROOF_OK;
  if (!handle->alive.exchange(false)) return PATCHPROOF_FREED_HANDLE;
  if (!handle->keep) {
    delete handle;
    return PATCHPROOF_OK;
  }
  handle->content.reset();
  keep_for_ever(*handle);
  return PATCHPROOF_OK;
}

// What makes a call end with a status. `code` counts for PATCHPROOF_BAD_DATA only.
struct Failure {
  patchproof_status status;
  Error error;
};

[[noreturn]] inline void bad_argument(std::string where, std::string message, std::string values = "") {
  throw Failure{PATCHPROOF_BAD_ARGUMENT, {ErrorCode::usage, std::move(where), std::move(message), std::move(values)}};
}
[[noreturn]] inline void bad_data(Error error) { throw Failure{PATCHPROOF_BAD_DATA, std::move(error)}; }

// The value, or the end of the call.
template <class T>
T take(Result<T> result) {
  if (!result) bad_data(result.error());
  return std::move(*result);
}

template <class C>
const C& content_of(const Handle<C>* handle, const char* name) {
  if (handle == nullptr) bad_argument(name, "is NULL");
  if (!handle->alive)
    throw Failure{PATCHPROOF_FREED_HANDLE, {ErrorCode::usage, name, "was freed before this call", ""}};
  return *handle->content;
}

// The floating-point environment that the library is built for, as long as it lives.
class FloatingPointGuard {
 public:
  FloatingPointGuard() {
    std::fegetenv(&callers_);
    std::fesetenv(FE_DFL_ENV);
  }
  FloatingPointGuard(const FloatingPointGuard&) = delete;
  FloatingPointGuard& operator=(const FloatingPointGuard&) = delete;
  ~FloatingPointGuard() { std::fesetenv(&callers_); }

 private:
  std::fenv_t callers_;
};

template <class Body>
patchproof_status call(patchproof_context* context, const Body& body) noexcept;

// ---- arguments -----------------------------------------------------------------------------------------------------------

inline std::string_view view(patchproof_text text, const char* name) {
  if (text.length == 0) return {};
  if (text.data == nullptr) bad_argument(name, "is NULL, with a length that is not 0", std::to_string(text.length));
  return {text.data, text.length};
}
// Texts that go out belong to the content of a handle.
inline patchproof_text borrowed(const std::string& text) { return {text.c_str(), text.size()}; }
inline constexpr patchproof_text kNoText{"", 0};

template <class T>
void require_array(const T* data, std::size_t length, const std::string& name) {
  if (data == nullptr && length > 0) bad_argument(name, "is NULL, with a length that is not 0", std::to_string(length));
}
template <class T>
void require_place(const T* place, const char* name) {
  if (place == nullptr) bad_argument(name, "is NULL");
}
inline void require_value(std::int32_t value, std::int32_t largest, const char* name) {
  if (value < 0 || value > largest)
    bad_argument(name, "is none of the values 0 to " + std::to_string(largest), std::to_string(value));
}
inline void require_index(std::size_t index, std::size_t count, const char* name) {
  if (index >= count)
    bad_argument(name, count == 0 ? "there is none" : "the last one is " + std::to_string(count - 1),
                 std::to_string(index));
}

inline std::size_t known_size(std::size_t struct_size, std::size_t ours, const char* name) {
  constexpr std::size_t kLargest = 4096;  // no struct of any version is as large
  if (struct_size < ours || struct_size > kLargest || struct_size % alignof(double) != 0)
    bad_argument(std::string(name) + ".struct_size", "is the size of no version of this struct; set it to sizeof",
                 std::to_string(struct_size));
  return ours;
}

// A struct of options as this version knows it. NULL: all defaults. What a newer header has added must be 0.
template <class S>
S options_of(const S* in, const char* name) {
  S out{};
  out.struct_size = sizeof(S);
  if (in == nullptr) return out;
  std::memcpy(&out, in, known_size(in->struct_size, sizeof(S), name));
  const char* bytes = reinterpret_cast<const char*>(in);
  for (std::size_t i = sizeof(S); i < in->struct_size; ++i)
    if (bytes[i] != 0) bad_argument(name, "asks for something that this version of the library does not know");
  return out;
}

// Writes an info struct, and leaves alone what a newer header has added.
template <class S>
void write_struct(S* out, S value, const char* name) {
  require_place(out, name);
  value.struct_size = out->struct_size;
  std::memcpy(out, &value, known_size(out->struct_size, sizeof(S), name));
}

// Bytes and a zero behind them, into a buffer of the caller's.
void write_text(std::string_view text, char* buffer, std::size_t length, std::size_t* needed);

}  // namespace patchproof::c_api

struct patchproof_context : patchproof::c_api::Shell {
  using Shell::Shell;
  std::atomic<bool> busy{false};
  patchproof_status status = PATCHPROOF_OK;
  // Of the last call. What did not fit in memory is empty.
  std::string code, where, message, values, line;
  void clear() noexcept;
  void set(patchproof_status failed, const patchproof::Error& error);
  // From within a catch block: what was thrown.
  patchproof_status status_of_exception() noexcept;
};

namespace patchproof::c_api {

template <class Body>
patchproof_status call(patchproof_context* context, const Body& body) noexcept {
  if (context == nullptr) return PATCHPROOF_BAD_ARGUMENT;
  if (!context->alive) return PATCHPROOF_FREED_HANDLE;
  if (context->busy.exchange(true, std::memory_order_acquire)) return PATCHPROOF_CONTEXT_BUSY;
  {
    const FloatingPointGuard guard;
    context->clear();
    try {
      body();
    } catch (...) {
      context->status = context->status_of_exception();
    }
  }
  const patchproof_status status = context->status;
  context->busy.store(false, std::memory_order_release);
  return status;
}

// A new handle of type H for the caller. REQUIRES out, which require_place has looked at.
template <class H, class C>
void hand_over(const patchproof_context* context, C content, H** out) {
  *out = new H(context->keep, std::move(content));
}

}  // namespace patchproof::c_api
