// The surface formats: how they are recognised, and the way to their parsers.
#pragma once

#include "import/formats/input_file.h"
#include "import/mesh/triangle_mesh.h"
#include "import/source_reader.h"

#include <optional>

namespace voxsheet::import {

enum class MeshFormat { Stl, Ply, Obj };

/// By content; by the name only for what has no beginning of its own: a binary STL of the wrong length, an
/// OBJ that begins with unknown statements.
[[nodiscard]] std::optional<MeshFormat> meshFormatOf(const FileHead& head);

/// Whether the bytes are those of a binary STL of exactly this length. \param head  at least 84 bytes
[[nodiscard]] bool isWholeBinaryStl(std::string_view head, std::uint64_t fileBytes);

/// Reads and checks the whole file. The result has at least one triangle. Throws InvalidInput (truncated,
/// counts that do not fit the file, indices out of range, coordinates that are not finite, no triangle),
/// Unsupported, LimitExceeded, IoError.
[[nodiscard]] TriangleMesh readMesh(const InputFile& file, MeshFormat format);

/// The parsers of readMesh. \param bytes  the whole file; `file` is the subject of errors
[[nodiscard]] TriangleMesh parseStl(std::string_view bytes, const std::string& file);
[[nodiscard]] TriangleMesh parsePly(std::string_view bytes, const std::string& file);
[[nodiscard]] TriangleMesh parseObj(std::string_view bytes, const std::string& file);

} // namespace voxsheet::import
