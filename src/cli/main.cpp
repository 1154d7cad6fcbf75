// SPDX-License-Identifier: Apache-2.0
// patchproof: certifies how the patches of a model join, and evaluates them exactly.
#include <cstdio>
#include <exception>

#include "cli/commands.h"
#include "cli/interrupt.h"

int main(int argc, char** argv) {
  using namespace patchproof::cli;
  end_cleanly_on_signals();
  CLI::App app{"patchproof: proves how the patches of a model join", "patchproof"};
  app.set_version_flag("--version", "patchproof " PATCHPROOF_VERSION);
  app.require_subcommand(1);
  app.footer(
      "Exit codes: 0 everything proven or within, 1 something refuted or exceeds, 2 bad input or usage,\n"
      "3 undecided remains, 130 interrupted. Formats: docs/formats.md.");
  int exit_code = kProven;
  add_animate(app, exit_code);
  add_certify(app, exit_code);
  add_evaluate(app, exit_code);
  add_fill(app, exit_code);
  add_fit(app, exit_code);
  add_info(app, exit_code);
  add_convert(app, exit_code);
  add_plot(app, exit_code);
  add_tessellate(app, exit_code);
  add_validate(app, exit_code);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    const int code = app.exit(e);
    return code == 0 ? kProven : kBadInput;
  } catch (const std::bad_alloc&) {
    std::fputs("patchproof: out of memory\n", stderr);
    return kBadInput;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "patchproof: internal error: %s\n", e.what());
    return kBadInput;
  }
  return exit_code;
}
