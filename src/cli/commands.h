// SPDX-License-Identifier: Apache-2.0
// The program's commands. Each adds its options to the command line and returns the exit code when it is called:
// 0 everything proven or within, 1 something refuted or exceeds, 2 bad input or usage, 3 undecided remains.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "patchproof/error.h"
#include "patchproof/scalar/parse_scalar.h"

namespace patchproof::cli {

inline constexpr int kProven = 0, kRefuted = 1, kBadInput = 2, kUndecided = 3;

void add_animate(CLI::App& app, int& exit_code);
void add_certify(CLI::App& app, int& exit_code);
void add_evaluate(CLI::App& app, int& exit_code);
void add_info(CLI::App& app, int& exit_code);
void add_convert(CLI::App& app, int& exit_code);
void add_fill(CLI::App& app, int& exit_code);
void add_fit(CLI::App& app, int& exit_code);
void add_plot(CLI::App& app, int& exit_code);
void add_tessellate(CLI::App& app, int& exit_code);
void add_validate(CLI::App& app, int& exit_code);

// Prints the error on standard error and returns kBadInput.
int report_error(const Error& error);

// --decimals exact|binary64, for every command that reads a model.
void add_decimals(CLI::App& command, Decimals& decimals);

// Writes `text` to a file, or to standard output for "-": whole or not at all (a temporary file is renamed;
// devices and pipes are written to).
// Returns an Error's exit code or 0.
int write_output(const std::string& path, const std::string& text);

}  // namespace patchproof::cli
