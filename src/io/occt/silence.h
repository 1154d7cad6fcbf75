// SPDX-License-Identifier: Apache-2.0
// Open CASCADE speaks to the user through printers; its words are not ours.
#pragma once

#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <Message_Printer.hxx>

namespace patchproof::occt {

class Silence {
 public:
  Silence() : printers_(Message::DefaultMessenger()->Printers()) {
    Message::DefaultMessenger()->RemovePrinters(STANDARD_TYPE(Message_Printer));
  }
  ~Silence() {
    for (const auto& printer : printers_) Message::DefaultMessenger()->AddPrinter(printer);
  }
  Silence(const Silence&) = delete;
  Silence& operator=(const Silence&) = delete;

 private:
  const Message_SequenceOfPrinters printers_;
};

}  // namespace patchproof::occt
