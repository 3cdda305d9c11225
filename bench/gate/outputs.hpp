// A verdict as people and machines read it. Each is a whole text; nothing here decides anything.
#pragma once

#include <string>

#include "bench/gate/verdict.hpp"

namespace bench::gate {

/// For a terminal: layers, then findings, worst first, a line for what a kernel changed in a counter. \param colour
/// whether the terminal shows it
[[nodiscard]] std::string to_table(const Verdict& verdict, bool colour);

/// {"schema": "glsum-gate-1", ...}: everything, for programs.
[[nodiscard]] std::string to_json(const Verdict& verdict);

/// One test case a row, with a failure where the row fails; the conditions are a test case of their own.
[[nodiscard]] std::string to_junit(const Verdict& verdict);

/// For a step summary (GitHub's $GITHUB_STEP_SUMMARY, 1 MiB at most): long lists are cut and say so.
[[nodiscard]] std::string to_markdown(const Verdict& verdict);

/// GitHub workflow commands, ::error file=...,line=...,title=...::..., at the kernel's line of the registry; at most
/// ten of a kind, as many as GitHub shows.
[[nodiscard]] std::string to_annotations(const Verdict& verdict);

}  // namespace bench::gate
