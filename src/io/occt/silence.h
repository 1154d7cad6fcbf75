// SPDX-License-Identifier: Apache-2.0
// Open CASCADE speaks to the user through printers, and in places through std::cout; its words are not ours.
#pragma once

#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <Message_Printer.hxx>

#include <iostream>
#include <streambuf>

namespace patchproof::occt {

class Silence {
 public:
  Silence()
      : printers_(Message::DefaultMessenger()->Printers()),
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

  Nowhere nowhere_;
  const Message_SequenceOfPrinters printers_;
  std::streambuf *const out_, *const err_;
};

}  // namespace patchproof::occt
