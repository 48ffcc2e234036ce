#include "import/mesh/mesh_formats.h"

#include "base/errors.h"
#include "import/formats/number_text.h"
#include "import/mesh/word_cursor.h"

namespace voxsheet::import {

namespace {

bool hasExtension(const FileHead& head, const char* extension) {
    return lowerCase(head.path.extension().string()) == extension;
}

bool looksLikeTextStl(std::string_view bytes) {
    const auto beginning = lowerCase(trimmed(bytes.substr(0, 4096)));
    return beginning.starts_with("solid") &&
           (beginning.find("facet") != std::string::npos || beginning.find("endsolid") != std::string::npos);
}

/// Comments, names and materials, then a point of three numbers.
bool looksLikeObj(std::string_view bytes) {
    WordCursor lines(bytes);
    while (!lines.atEnd()) {
        WordCursor words(lines.line());
        const auto keyword = words.word();
        if (keyword == "v") return words.number() && words.number() && words.number();
        const bool before = keyword.empty() || keyword.starts_with('#') || keyword == "mtllib" ||
                            keyword == "o" || keyword == "g" || keyword == "s" || keyword == "usemtl";
        if (!before) return false;
    }
    return false;
}

} // namespace

std::optional<MeshFormat> meshFormatOf(const FileHead& head) {
    const std::string_view bytes = head.bytes;
    if (bytes.starts_with("ply\n") || bytes.starts_with("ply\r\n")) return MeshFormat::Ply;
    if (looksLikeTextStl(bytes) || hasExtension(head, ".stl")) return MeshFormat::Stl;
    if (head.fileBytes > 84 && isWholeBinaryStl(bytes, head.fileBytes)) return MeshFormat::Stl;
    if (looksLikeObj(bytes)) return MeshFormat::Obj;
    // Object files of compilers have this ending as well.
    if (hasExtension(head, ".obj") && bytes.find('\0') == std::string_view::npos) return MeshFormat::Obj;
    return std::nullopt;
}

TriangleMesh readMesh(const InputFile& file, MeshFormat format) {
    const auto bytes = file.textAt(0, static_cast<std::size_t>(file.bytes()));
    if (bytes.size() != file.bytes()) throw IoError(file.name(), "it became shorter while it was read");
    auto mesh = format == MeshFormat::Stl   ? parseStl(bytes, file.name())
                : format == MeshFormat::Ply ? parsePly(bytes, file.name())
                                            : parseObj(bytes, file.name());
    if (mesh.triangles.empty())
        throw InvalidInput(file.name(), "it has no triangle", "save a surface into it, not points or lines");
    return mesh;
}

} // namespace voxsheet::import
