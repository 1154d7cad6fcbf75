// SPDX-License-Identifier: Apache-2.0
// Open CASCADE speaks to the user through printers, and in places through std::cout; its words are not ours. These belong to the
// whole process, as do the settings and tables of its readers and writers, so there is one Silence at a time: others wait.
#pragma once

#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <Message_Printer.hxx>

#include <iostream>
#include <mutex>
#include <streambuf>

namespace patchproof::occt {

class Silence {
 public:
  Silence()
      : turn_(one_at_a_time()),
        printers_(Message::DefaultMessenger()->Printers()),
        out_(std::cout.rdbuf(&nowhere_)),
        err_(std::cerr.rdbuf(&nowhere_)) {
    Message::DefaultMessenger()->RemovePrinters(STANDARD_TYPE(Message_Printer));
  }
  ~Silence() {
    std::cout.rdbuf(out_);
    std::cerr.rdbuf(err_);
    for (const auto& printer : printers_) Message::DefaultMessenger()->AddPrinter(printer);
  }
  Silence(const Silence&) = delete;
  Silence& operator=(const Silence&) = delete;

 private:
  struct Nowhere : std::streambuf {
    int overflow(int c) override { return c; }
  };

  static std::mutex& one_at_a_time() {
    static std::mutex mutex;
    return mutex;
  }

  const std::lock_guard<std::mutex> turn_;
  Nowhere nowhere_;
  const Message_SequenceOfPrinters printers_;
  std::streambuf *const out_, *const err_;
};

}  // namespace patchproof::occt
