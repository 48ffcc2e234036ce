// Wavefront OBJ: the statements v and f; what is about looks and lines is passed over.
#include "base/errors.h"
#include "import/mesh/mesh_formats.h"
#include "import/mesh/word_cursor.h"

#include <algorithm>

namespace voxsheet::import {

namespace {

constexpr std::string_view passedOver[] = {"vn",       "vt",       "g",         "s",         "o",     "mg",
                                           "usemtl",   "mtllib",   "usemap",    "maplib",    "bevel", "lod",
                                           "c_interp", "d_interp", "l",         "p",         "ctech", "stech",
                                           "call",     "csh",      "trace_obj", "shadow_obj"};
constexpr std::string_view freeForm[] = {"vp",   "cstype", "deg",  "bmat", "step", "curv", "curv2", "surf",
                                         "parm", "trim",   "hole", "scrv", "sp",   "end",  "con"};

bool isOneOf(std::string_view word, std::span<const std::string_view> words) {
    return std::find(words.begin(), words.end(), word) != words.end();
}

class ObjParser {
public:
    ObjParser(std::string_view text, const std::string& file) : lines_(text), file_(file) {}

    TriangleMesh parse() {
        while (!lines_.atEnd())
            statement(logicalLine());
        if (polygons_ > 0)
            mesh_.notes.push_back(std::to_string(polygons_) +
                                  " polygons were divided into triangles about their first corners.");
        if (freeForm_) mesh_.notes.emplace_back("Its free-form curves and surfaces were left out.");
        return std::move(mesh_);
    }

private:
    /// A backslash at its end continues a line.
    std::string_view logicalLine() {
        auto line = lines_.line();
        if (!line.ends_with('\\')) return line;
        joined_.clear();
        while (line.ends_with('\\') && joined_.size() < (1U << 20U)) {
            joined_ += line.substr(0, line.size() - 1);
            joined_ += ' ';
            line = lines_.line();
        }
        joined_ += line;
        return joined_;
    }

    void statement(std::string_view line) {
        WordCursor words(line.substr(0, line.find('#')));
        const auto keyword = words.word();
        if (keyword == "v")
            vertex(words);
        else if (keyword == "f" || keyword == "fo")
            face(words);
        else if (isOneOf(keyword, freeForm))
            freeForm_ = true;
        else if (!keyword.empty() && !isOneOf(keyword, passedOver))
            fail("'" + printable(keyword) + "' is no statement of an OBJ file");
    }

    void vertex(WordCursor& words) {
        glm::dvec3 point;
        for (glm::length_t axis = 0; axis < 3; ++axis) {
            const auto number = words.number();
            if (!number) fail("a point needs three numbers");
            point[axis] = *number;
        }
        addPoint(mesh_, point, file_, lines_.place());
    }

    /// Corners are "v", "v/vt", "v//vn" or "v/vt/vn": counted from 1, or back from the last point so far.
    void face(WordCursor& words) {
        corners_.clear();
        for (auto word = words.word(); !word.empty(); word = words.word()) {
            const auto index = parseInteger(word.substr(0, word.find('/')));
            if (!index) fail("'" + printable(word) + "' is no index of a point");
            const auto count = static_cast<std::int64_t>(mesh_.points.size());
            const auto point = *index < 0 ? count + *index : *index - 1;
            if (point < 0 || point >= count)
                fail("it names point " + std::to_string(*index) + ", and there are " + std::to_string(count) +
                     " so far");
            corners_.push_back(static_cast<std::uint32_t>(point));
        }
        if (corners_.size() < 3) fail("a face needs three corners or more");
        if (corners_.size() > 3) ++polygons_;
        addPolygon(mesh_, corners_, file_);
    }

    [[noreturn]] void fail(const std::string& why) const {
        throw InvalidInput(file_, lines_.place() + ": " + why, "the file is damaged, or no OBJ file");
    }

    WordCursor lines_;
    const std::string& file_;
    std::string joined_;
    std::vector<std::uint32_t> corners_;
    TriangleMesh mesh_;
    std::size_t polygons_ = 0;
    bool freeForm_ = false;
};

} // namespace

TriangleMesh parseObj(std::string_view bytes, const std::string& file) {
    return ObjParser(bytes, file).parse();
}

} // namespace voxsheet::import
