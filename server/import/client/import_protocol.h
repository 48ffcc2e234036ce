// What importer and server say to each other: one JSON object per line on the child's standard output.
//   {"header": {"dataset": …, "voxel_bytes": n, "files": […]}}   the header is understood
//   {"progress": 0.42}
//   {"key": "…"}                                                 the entry is in the store: the last line
//   {"measured": {"header_seconds": …, "data_seconds": …, "voxel_bytes": n}}   the only line, with --measure
//   {"error": {"kind": …, "what": …, "why": …, "todo": …, "field": …}}   the last line of an import that
//   failed
// With --header-only there is one header or error line per file, in their order.
#pragma once

#include "base/errors.h"
#include "import/import_client.h"

#include <string>
#include <string_view>
#include <variant>

namespace voxsheet::import {

/// Goes into every key: raise it when a reader gives other voxels or other geometry for the same file than
/// before.
inline constexpr const char* kImporterVersion = "8";

struct ProgressMessage {
    double fraction = 0.0;
};
struct KeyMessage {
    std::string key;
};
struct ErrorMessage {
    ErrorKind kind = ErrorKind::Internal;
    std::string what;
    std::string why;
    std::string toDo;
    std::string field;
};
using ImporterMessage = std::variant<FilePreview, ProgressMessage, KeyMessage, ReadingTime, ErrorMessage>;

/// One line, without its end.
[[nodiscard]] std::string encodeMessage(const ImporterMessage& message);
/// The child has read a file that may be hostile: its words are checked like any input. Throws InvalidInput.
[[nodiscard]] ImporterMessage decodeMessage(std::string_view line);

[[nodiscard]] ErrorMessage errorMessage(const Error& error);
/// Throws the member of the error family that the kind names.
[[noreturn]] void throwError(const ErrorMessage& error);

} // namespace voxsheet::import
