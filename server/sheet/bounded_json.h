// JSON from outside: bounded in size and depth, with no duplicate members.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include <nlohmann/json_fwd.hpp>

namespace voxsheet::sheet {

struct JsonLimits {
    std::size_t bytes = std::size_t{16} << 20;
    int depth =
        32; ///< of nested objects and lists: deep ones overflow the stack when they are written out again
};

/// Throws InvalidInput (what = `what`) if the text is not JSON in UTF-8, nests too deep or names a member
/// twice; LimitExceeded if it is too long.
[[nodiscard]] nlohmann::json parseBoundedJson(std::string_view text, const std::string& what,
                                              JsonLimits limits = {});

} // namespace voxsheet::sheet
