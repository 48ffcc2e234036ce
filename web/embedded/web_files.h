// The page's files, built from web/ and embedded into the binary. With VOXSHEET_WEB=OFF there is one file, a
// page that says so.
#pragma once

#include "base/embedded.h"

#include <cstddef>

namespace voxsheet {

/// Paths are relative to the page's address: "index.html", "app.js", …; webFilesCount entries.
extern const EmbeddedFile webFiles[];
extern const std::size_t webFilesCount;

} // namespace voxsheet
