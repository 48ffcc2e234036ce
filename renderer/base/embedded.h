// Files that the build embeds into the binary (shaders, the page, colour maps); see
// .cmake/VoxsheetEmbed.cmake.
#pragma once

#include <cstddef>
#include <string_view>

namespace voxsheet {

struct EmbeddedFile {
    const char* path; ///< relative to the embedding's base folder, '/'-separated
    const char* begin;
    const char* end;
    [[nodiscard]] std::string_view bytes() const { return {begin, static_cast<std::size_t>(end - begin)}; }
};

} // namespace voxsheet
