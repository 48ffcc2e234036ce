// What is fuzzed: every parser of ours that takes bytes from outside. libFuzzer drives them in a build with
// VOXSHEET_FUZZ (fuzz_main.cpp); every build runs them over their seeds (seeds_test.cpp).
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace voxsheet::fuzz {

struct FuzzTarget {
    std::string name;
    std::vector<std::string> seeds; ///< valid inputs, and such as once went wrong
    /// Takes any bytes. An Error is an answer; anything else that it throws, and a broken promise, is a
    /// finding.
    std::function<void(std::string_view)> run;
};

/// Readers of files, one target per format.
[[nodiscard]] std::vector<FuzzTarget> formatTargets();
/// JSON documents, formulas, style values and requests.
[[nodiscard]] std::vector<FuzzTarget> textTargets();
/// Parsers that stand before or beside a reader: tables of labels, headers of VTK's XML files.
[[nodiscard]] std::vector<FuzzTarget> parserTargets();
/// All of them.
[[nodiscard]] std::vector<FuzzTarget> allTargets();

/// Throws std::logic_error: a parser gave something that its header excludes.
void promise(bool kept, const char* what);

} // namespace voxsheet::fuzz
