// DatasetMeta <-> JSON: meta.json of a store entry, and what the importer prints.
#pragma once

#include "volume/dataset.h"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <string_view>

namespace voxsheet::store {

/// All of `meta` but its key, which is the entry's name. Bytes that are not UTF-8 in texts become U+FFFD when
/// the result is dumped with error_handler_t::replace. Throws InvalidInput if a number is not finite (JSON
/// has none such).
[[nodiscard]] nlohmann::json metaToJson(const DatasetMeta& meta);
/// Inverse; checks everything that the program relies on: the grid, the number of steps, types. Throws
/// InvalidInput.
[[nodiscard]] DatasetMeta metaFromJson(const nlohmann::json& json);

/// A whole number from 0 on, as written: 1.0 is none, nor is one that 64 bits do not hold (nlohmann-json
/// would convert either, with no check of its range). Throws InvalidInput that names `what`.
[[nodiscard]] std::uint64_t countFromJson(const nlohmann::json& json, const char* what);

/// Parses text with at most 32 nested levels (nlohmann-json 3.11 parses any depth, then overflows the stack
/// in its destructor or dump). Throws InvalidInput.
[[nodiscard]] nlohmann::json parseJson(std::string_view text, std::string_view what);

} // namespace voxsheet::store
