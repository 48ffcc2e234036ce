// STL (3D Systems, 1989): binary, an 80 byte header, a count and 50 bytes a triangle; or text.
#include "base/errors.h"
#include "import/mesh/mesh_formats.h"
#include "import/mesh/word_cursor.h"

#include <cstring>

namespace voxsheet::import {

namespace {

constexpr std::size_t headerBytes = 84;
constexpr std::size_t triangleBytes = 50; // normal, three corners, two bytes of attributes
constexpr const char* copyAgain = "the file is probably truncated: copy or write it again";

std::uint32_t statedTriangles(std::string_view bytes) {
    std::uint32_t count = 0;
    std::memcpy(&count, bytes.data() + 80, sizeof(count));
    return count;
}

TriangleMesh parseBinary(std::string_view bytes, const std::string& file) {
    if (bytes.size() < headerBytes)
        throw InvalidInput(file,
                           "a binary STL file has at least 84 bytes, it has " + std::to_string(bytes.size()),
                           copyAgain);
    const std::uint64_t count = statedTriangles(bytes);
    const auto expected = headerBytes + count * triangleBytes;
    if (expected != bytes.size())
        throw InvalidInput(file,
                           "its header says " + std::to_string(count) + " triangles, which are " +
                               std::to_string(expected) + " bytes, and it has " +
                               std::to_string(bytes.size()),
                           bytes.size() < expected ? copyAgain : "write the file again");
    checkTriangleCount(file, count);
    TriangleMesh mesh;
    mesh.points.reserve(3 * count);
    mesh.triangles.reserve(count);
    for (std::size_t t = 0; t < count; ++t) {
        std::array<float, 12> numbers{};
        std::memcpy(numbers.data(), bytes.data() + headerBytes + t * triangleBytes, sizeof(numbers));
        Triangle triangle{};
        for (std::size_t c = 0; c < 3; ++c)
            triangle[c] = addPoint(mesh, {numbers[3 * c + 3], numbers[3 * c + 4], numbers[3 * c + 5]}, file,
                                   "triangle " + std::to_string(t + 1));
        mesh.triangles.push_back(triangle);
    }
    return mesh;
}

/// solid NAME / facet normal x y z / outer loop / three times vertex x y z / endloop / endfacet / endsolid
class TextParser {
public:
    TextParser(std::string_view text, const std::string& file) : words_(text), file_(file) {}

    TriangleMesh parse() {
        for (auto word = next(); !word.empty(); word = next()) {
            if (word != "solid") fail("'solid'", word);
            (void)words_.line(); // its name
            word = next();
            for (; word == "facet"; word = next())
                facet();
            if (word != "endsolid") fail("'facet' or 'endsolid'", word);
            (void)words_.line();
        }
        return std::move(mesh_);
    }

private:
    void facet() {
        expect("normal");
        for (int i = 0; i < 3; ++i) // recomputed from the corners
            (void)words_.word();
        expect("outer");
        expect("loop");
        checkTriangleCount(file_, mesh_.triangles.size() + 1);
        Triangle triangle{};
        for (auto& corner : triangle) {
            expect("vertex");
            glm::dvec3 point;
            for (glm::length_t axis = 0; axis < 3; ++axis) {
                const auto number = words_.number();
                if (!number) throw InvalidInput(file_, words_.place() + " lacks a number", copyAgain);
                point[axis] = *number;
            }
            corner = addPoint(mesh_, point, file_, words_.place());
        }
        expect("endloop");
        expect("endfacet");
        mesh_.triangles.push_back(triangle);
    }

    std::string next() { return lowerCase(words_.word()); }

    void expect(const char* keyword) {
        const auto word = next();
        if (word != keyword) fail("'" + std::string(keyword) + "'", word);
    }

    [[noreturn]] void fail(const std::string& expected, const std::string& found) const {
        if (found.empty())
            throw InvalidInput(file_, "it ends where " + expected + " should follow", copyAgain);
        throw InvalidInput(
            file_, words_.place() + " has '" + printable(found) + "' where " + expected + " should be",
            "the file is damaged, or has polygons, which STL does not know");
    }

    WordCursor words_;
    const std::string& file_;
    TriangleMesh mesh_;
};

} // namespace

bool isWholeBinaryStl(std::string_view head, std::uint64_t fileBytes) {
    return head.size() >= headerBytes &&
           fileBytes == headerBytes + std::uint64_t{statedTriangles(head)} * triangleBytes;
}

TriangleMesh parseStl(std::string_view bytes, const std::string& file) {
    // Binary files may begin with "solid" too.
    const auto head = bytes.substr(0, 1024);
    const bool isText = lowerCase(trimmed(head)).starts_with("solid");
    if (isWholeBinaryStl(head, bytes.size()) || !isText || head.find('\0') != std::string_view::npos)
        return parseBinary(bytes, file);
    return TextParser(bytes, file).parse();
}

} // namespace voxsheet::import
