#include "import/vtk_xml/vti_header.h"

#include "base/errors.h"
#include "import/formats/geometry.h"
#include "import/formats/number_text.h"
#include "import/formats/xml_walk.h"

#include <algorithm>
#include <array>
#include <optional>

namespace voxsheet::import {

namespace {

constexpr std::size_t kInlineHead = 4U << 20U; // base64 digits: the lengths of 390,000 compressed blocks

using Attributes = XmlWalk::Attributes;

constexpr std::array<std::pair<std::string_view, ScalarType>, 10> kTypes{{
    {"Int8", ScalarType::I8},
    {"UInt8", ScalarType::U8},
    {"Int16", ScalarType::I16},
    {"UInt16", ScalarType::U16},
    {"Int32", ScalarType::I32},
    {"UInt32", ScalarType::U32},
    {"Int64", ScalarType::I64},
    {"UInt64", ScalarType::U64},
    {"Float32", ScalarType::F32},
    {"Float64", ScalarType::F64},
}};

bool isBase64(char c) {
    return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '+' ||
           c == '/' || c == '=';
}

class VtiParser {
public:
    explicit VtiParser(const InputFile& file)
        : file_(file),
          walk_(file.name(),
                {[this](auto& element, auto& attributes) { start(element, attributes); },
                 [this](auto& element) { end(element); }, [this](auto characters) { text(characters); }}) {}

    VtiHeader parse() {
        constexpr std::size_t chunk = 256 * 1024;
        bool last = false;
        for (std::uint64_t at = 0; !last && !walk_.stopped(); at += chunk) {
            const auto piece = file_.textAt(at, chunk);
            last = piece.size() < chunk;
            walk_.feed(piece, last);
        }
        if (!haveImage_) damaged("it has no element ImageData or RectilinearGrid");
        if (header_.rectilinear && header_.coordinates.size() != 3)
            damaged("it has not three arrays of coordinates");
        findAppendedData();
        return std::move(header_);
    }

private:
    [[noreturn]] void damaged(const std::string& why) const {
        throw InvalidInput(file_.name(), why, "the file is damaged or incomplete: copy or write it again");
    }

    void start(const std::string& element, const Attributes& attributes) {
        if (array_) {
            ++withinArray_; // InformationKey and its Values
            return;
        }
        if (element == "VTKFile") return startFile(attributes);
        if (element == "ImageData" || element == "RectilinearGrid") return startImage(element, attributes);
        if (element == "Piece") return startPiece(attributes);
        if (element == "PointData" || element == "CellData") {
            section_ = element == "CellData" ? Section::Cells : Section::Points;
            vectors_ = {valueOf(attributes, "Vectors"), valueOf(attributes, "Normals")};
        } else if (element == "Coordinates") {
            section_ = Section::Coordinates;
        } else if (element == "DataArray" && section_ != Section::None) {
            startArray(attributes);
        } else if (element == "AppendedData") {
            header_.appendedBase64 = valueOf(attributes, "encoding") != "raw";
            header_.appendedStart = walk_.bytePosition();
            walk_.stop(); // what follows need not be XML
        }
    }

    void end(const std::string& element) {
        if (withinArray_ > 0) {
            --withinArray_;
            return;
        }
        if (element == "PointData" || element == "CellData" || element == "Coordinates")
            section_ = Section::None;
        if (element == "DataArray" && array_) {
            finishWord();
            (section_ == Section::Coordinates ? header_.coordinates : header_.arrays)
                .push_back(std::move(*array_));
            array_.reset();
        }
    }

    void startFile(const Attributes& attributes) {
        const auto type = valueOf(attributes, "type");
        header_.rectilinear = type == "RectilinearGrid";
        if (type != "ImageData" && !header_.rectilinear)
            throw Unsupported(
                file_.name(), "it holds a VTK data set of the kind '" + printable(type) + "'",
                "only image data (.vti), rectilinear grids (.vtr) and AMR data sets of images can be "
                "read from VTK's XML files");
        header_.bigEndian = valueOf(attributes, "byte_order") == "BigEndian";
        header_.headerIntegerBytes = valueOf(attributes, "header_type") == "UInt64" ? 8 : 4;
        header_.compressed = !valueOf(attributes, "compressor").empty();
        haveFile_ = true;
    }

    void startImage(const std::string& element, const Attributes& attributes) {
        if (!haveFile_) damaged("its outermost element is not VTKFile");
        if ((element == "RectilinearGrid") != header_.rectilinear)
            damaged("its elements do not fit its type");
        extent_ = integers(attributes, "WholeExtent");
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto size = extent_[2 * axis + 1] - extent_[2 * axis] + 1;
            if (size < 1 || size > (1 << 24)) damaged("its WholeExtent is empty or too large");
            header_.points.dims[static_cast<int>(axis)] = static_cast<int>(size);
        }
        haveImage_ = true;
        if (header_.rectilinear) return validateGrid(header_.points); // its dims
        const auto spacing = numbers(attributes, "Spacing", {1, 1, 1});
        const auto origin = numbers(attributes, "Origin", {0, 0, 0});
        const auto direction = numbers(attributes, "Direction", {1, 0, 0, 0, 1, 0, 0, 0, 1});
        checkSpacing(file_.name(), spacing);
        AxisColumns columns;
        glm::dvec3 first(origin[0], origin[1], origin[2]);
        for (std::size_t axis = 0; axis < 3; ++axis) { // row-major in the file; extents may start anywhere
            columns[axis] =
                spacing[axis] * glm::dvec3(direction[axis], direction[3 + axis], direction[6 + axis]);
            first += static_cast<double>(extent_[2 * axis]) * columns[axis];
        }
        header_.points.worldFromIndex = affine(columns, first);
        validateGrid(header_.points);
    }

    void startPiece(const Attributes& attributes) {
        if (!haveImage_) damaged("a Piece stands outside ImageData");
        if (havePiece_ || integers(attributes, "Extent") != extent_)
            throw Unsupported(file_.name(), "its image is written in several pieces",
                              "write it as one piece");
        havePiece_ = true;
    }

    void startArray(const Attributes& attributes) {
        if (!havePiece_) damaged("a DataArray stands outside of a Piece");
        const bool isCoordinate = section_ == Section::Coordinates;
        VtiArray array;
        array.name = isCoordinate ? std::string("coordinates") : valueOf(attributes, "Name");
        const auto typeName = valueOf(attributes, "type");
        const auto type = std::find_if(kTypes.begin(), kTypes.end(),
                                       [&](const auto& entry) { return entry.first == typeName; });
        if (isCoordinate && (type == kTypes.end() || valueOf(attributes, "NumberOfComponents", "1") != "1"))
            damaged("its coordinates are no numbers");
        if (type == kTypes.end()) {
            header_.notes.push_back("The array '" + printable(array.name) + "' was left out: its type is " +
                                    printable(typeName) + ".");
            return;
        }
        array.type = type->second;
        const auto components = parseInteger(valueOf(attributes, "NumberOfComponents", "1"));
        if (!components || *components < 1 || *components > 1024)
            damaged("the array '" + printable(array.name) + "' has an impossible number of components");
        array.components = static_cast<int>(*components);
        array.ofCells = section_ == Section::Cells;
        array.isVector = std::find(vectors_.begin(), vectors_.end(), array.name) != vectors_.end();
        const auto format = valueOf(attributes, "format", "ascii");
        if (format == "appended") {
            const auto offset = parseInteger(trimmed(valueOf(attributes, "offset")));
            if (!offset || *offset < 0) damaged("the array '" + printable(array.name) + "' has no offset");
            array.encoding = VtiEncoding::Appended;
            array.appendedOffset = static_cast<std::uint64_t>(*offset);
        } else if (format == "binary") {
            array.encoding = VtiEncoding::Inline;
        } else if (format != "ascii") {
            damaged("the array '" + printable(array.name) + "' has the format '" + printable(format) + "'");
        }
        array_ = std::move(array);
    }

    void text(std::string_view characters) {
        if (!array_ || withinArray_ > 0 || array_->encoding == VtiEncoding::Appended) return;
        for (const char c : characters) {
            if (c == ' ' || (c >= '\t' && c <= '\r')) {
                finishWord();
            } else if (array_->encoding == VtiEncoding::Ascii) {
                word_ += c;
                if (word_.size() > 100)
                    damaged("the array '" + printable(array_->name) + "' holds no numbers");
            } else {
                if (!isBase64(c))
                    damaged("the array '" + printable(array_->name) +
                            "' holds characters that are not base64");
                ++array_->inlineCount;
                if (array_->inlineHead.size() < kInlineHead) array_->inlineHead += c;
            }
        }
    }

    /// VTK stops without a word at text that is no number.
    void finishWord() {
        if (word_.empty()) return;
        const auto number = parseNumber(word_);
        const bool fits = number && visitScalar(array_->type, [&]<typename T>() {
                              if constexpr (std::is_floating_point_v<T>)
                                  return true;
                              else
                                  return *number >= static_cast<double>(std::numeric_limits<T>::min()) &&
                                         *number <= static_cast<double>(std::numeric_limits<T>::max());
                          });
        if (!fits)
            damaged("the array '" + printable(array_->name) + "' holds '" + printable(word_) +
                    "', which is no number of its type");
        ++array_->inlineCount;
        word_.clear();
    }

    void findAppendedData() {
        const auto isAppended = [](const VtiArray& a) { return a.encoding == VtiEncoding::Appended; };
        const bool needed = std::any_of(header_.arrays.begin(), header_.arrays.end(), isAppended) ||
                            std::any_of(header_.coordinates.begin(), header_.coordinates.end(), isAppended);
        if (!walk_.stopped()) {
            if (needed) damaged("the appended data that it speaks of are missing");
            return;
        }
        const auto begin = file_.textAt(header_.appendedStart, 4096);
        const auto tagEnd = begin.find('>');
        const auto mark = tagEnd == std::string::npos ? tagEnd : begin.find('_', tagEnd);
        if (mark == std::string::npos) damaged("its appended data do not begin with '_'");
        header_.appendedStart += mark + 1;
        constexpr std::uint64_t tail = 1024;
        const auto end = file_.textAt(file_.bytes() > tail ? file_.bytes() - tail : 0, tail);
        if (end.find("</VTKFile>") == std::string::npos) damaged("its end is missing");
    }

    [[nodiscard]] std::vector<std::int64_t> integers(const Attributes& attributes,
                                                     const std::string& name) const {
        const auto list = parseIntegers(valueOf(attributes, name), 6);
        if (!list) damaged("its " + name + " is not six whole numbers");
        for (const auto n : *list)
            if (n < -(1LL << 31) || n > (1LL << 31)) damaged("its " + name + " is out of range");
        return *list;
    }

    [[nodiscard]] std::vector<double> numbers(const Attributes& attributes, const std::string& name,
                                              const std::vector<double>& fallback) const {
        if (!attributes.contains(name)) return fallback;
        const auto list = parseNumbers(valueOf(attributes, name), fallback.size());
        if (!list) damaged("its " + name + " is not " + std::to_string(fallback.size()) + " finite numbers");
        return *list;
    }

    enum class Section { None, Points, Cells, Coordinates };

    const InputFile& file_;
    XmlWalk walk_;
    VtiHeader header_;
    bool haveFile_ = false;
    bool haveImage_ = false;
    bool havePiece_ = false;
    Section section_ = Section::None;
    std::vector<std::int64_t> extent_;
    std::vector<std::string> vectors_;
    std::optional<VtiArray> array_;
    int withinArray_ = 0; ///< elements that are open in it: what they say are no data
    std::string word_;
};

} // namespace

VtiHeader parseVtiHeader(const InputFile& file) { return VtiParser(file).parse(); }

} // namespace voxsheet::import
