// The elements of a PLY file: points from "vertex", triangles from "face"; others are passed over.
#include "base/errors.h"
#include "import/mesh/mesh_formats.h"
#include "import/mesh/ply_header.h"
#include "import/mesh/word_cursor.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace voxsheet::import {

namespace {

/// Numbers one after another, whatever the encoding. nullopt at the end of the file or if a word is none.
class PlyNumbers {
public:
    PlyNumbers(std::string_view data, PlyEncoding encoding)
        : words_(data), bytes_(data), encoding_(encoding) {}

    [[nodiscard]] std::optional<double> next(ScalarType type) {
        if (encoding_ == PlyEncoding::Ascii) return words_.number();
        const auto size = scalarBytes(type);
        if (bytes_.size() < size) return std::nullopt;
        std::array<char, 8> raw{};
        std::memcpy(raw.data(), bytes_.data(), size);
        bytes_.remove_prefix(size);
        if (encoding_ == PlyEncoding::BigEndian)
            std::reverse(raw.begin(), raw.begin() + static_cast<std::ptrdiff_t>(size));
        return visitScalar(type, [&]<typename T>() {
            T value{};
            std::memcpy(&value, raw.data(), sizeof(T));
            return static_cast<double>(value);
        });
    }

private:
    WordCursor words_;
    std::string_view bytes_;
    PlyEncoding encoding_;
};

class PlyParser {
public:
    PlyParser(std::string_view bytes, const std::string& file)
        : header_(parsePlyHeader(bytes, file)), numbers_(bytes.substr(header_.bytes), header_.encoding),
          file_(file) {}

    TriangleMesh parse() {
        for (const auto& element : header_.elements) {
            if (element.name == "vertex")
                readVertices(element);
            else if (element.name == "face")
                readFaces(element);
            else if (element.name == "tristrips" && element.count > 0)
                throw Unsupported(file_, "its triangles are in strips", "save it with single faces");
            else
                passOver(element);
        }
        checkIndices();
        if (polygons_ > 0)
            mesh_.notes.push_back(std::to_string(polygons_) +
                                  " polygons were divided into triangles about their first corners.");
        return std::move(mesh_);
    }

private:
    void readVertices(const PlyElement& element) {
        constexpr std::string_view axes[] = {"x", "y", "z"};
        std::vector<int> axisOf(element.properties.size(), -1);
        int found = 0;
        for (std::size_t p = 0; p < axisOf.size(); ++p)
            for (int axis = 0; axis < 3; ++axis)
                if (element.properties[p].name == axes[axis] && !element.properties[p].countType) {
                    axisOf[p] = axis;
                    ++found;
                }
        if (found != 3) throw InvalidInput(file_, "its points lack one of x, y and z", "write it again");
        mesh_.points.reserve(element.count);
        for (std::uint64_t v = 0; v < element.count; ++v) {
            glm::dvec3 point(0.0);
            for (std::size_t p = 0; p < axisOf.size(); ++p) {
                if (element.properties[p].countType) {
                    readList(element, element.properties[p], v);
                } else if (const double value = number(element, element.properties[p].type, v);
                           axisOf[p] >= 0) {
                    point[axisOf[p]] = value;
                }
            }
            addPoint(mesh_, point, file_, "point " + std::to_string(v + 1));
        }
    }

    void readFaces(const PlyElement& element) {
        const auto isIndices = [](const PlyProperty& p) {
            return p.countType && (p.name == "vertex_indices" || p.name == "vertex_index");
        };
        if (std::none_of(element.properties.begin(), element.properties.end(), isIndices))
            throw InvalidInput(file_, "its faces lack the list 'vertex_indices'", "write it again");
        for (std::uint64_t f = 0; f < element.count; ++f)
            for (const auto& property : element.properties) {
                if (!property.countType) {
                    (void)number(element, property.type, f);
                    continue;
                }
                readList(element, property, f);
                if (isIndices(property)) addFace(f);
            }
    }

    void addFace(std::uint64_t face) {
        if (list_.size() < 3)
            throw InvalidInput(file_, "face " + std::to_string(face + 1) + " has fewer than three corners",
                               "write it again");
        corners_.clear();
        for (const double index : list_) {
            if (!(index >= 0.0 && index < 4294967295.0 && std::floor(index) == index))
                throw InvalidInput(file_, "face " + std::to_string(face + 1) + " has an impossible index",
                                   "the file is damaged: copy or write it again");
            corners_.push_back(static_cast<std::uint32_t>(index));
        }
        if (corners_.size() > 3) ++polygons_;
        addPolygon(mesh_, corners_, file_);
    }

    void passOver(const PlyElement& element) {
        for (std::uint64_t i = 0; i < element.count; ++i)
            for (const auto& property : element.properties) {
                if (property.countType)
                    readList(element, property, i);
                else
                    (void)number(element, property.type, i);
            }
    }

    double number(const PlyElement& element, ScalarType type, std::uint64_t index) {
        if (const auto value = numbers_.next(type)) return *value;
        throw InvalidInput(file_,
                           "its '" + printable(element.name) + "' " + std::to_string(index + 1) + " of " +
                               std::to_string(element.count) + " is not whole, or has a word for a number",
                           "the file is probably truncated: copy or write it again");
    }

    void readList(const PlyElement& element, const PlyProperty& property, std::uint64_t index) {
        const double length = number(element, *property.countType, index);
        if (!(length >= 0.0 && length <= 1e6 && std::floor(length) == length))
            throw InvalidInput(file_,
                               "its '" + printable(element.name) + "' " + std::to_string(index + 1) +
                                   " has a list of an impossible length",
                               "the file is damaged: copy or write it again");
        list_.clear();
        for (double i = 0; i < length; ++i)
            list_.push_back(number(element, property.type, index));
    }

    /// Faces may stand before the points.
    void checkIndices() const {
        for (std::size_t t = 0; t < mesh_.triangles.size(); ++t)
            for (const auto corner : mesh_.triangles[t])
                if (corner >= mesh_.points.size())
                    throw InvalidInput(file_,
                                       "a face names point " + std::to_string(corner) +
                                           ", counted from 0, and there are " +
                                           std::to_string(mesh_.points.size()),
                                       "the file is damaged: copy or write it again");
    }

    PlyHeader header_;
    PlyNumbers numbers_;
    const std::string& file_;
    TriangleMesh mesh_;
    std::vector<double> list_;
    std::vector<std::uint32_t> corners_;
    std::size_t polygons_ = 0;
};

} // namespace

TriangleMesh parsePly(std::string_view bytes, const std::string& file) {
    return PlyParser(bytes, file).parse();
}

} // namespace voxsheet::import
