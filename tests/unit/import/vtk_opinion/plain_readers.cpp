#include "plain_readers.h"

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkPointData.h>
#include <vtkRectilinearGrid.h>
#include <vtkRectilinearGridReader.h>
#include <vtkSLCReader.h>
#include <vtkSmartPointer.h>
#include <vtkStructuredPoints.h>
#include <vtkStructuredPointsReader.h>
#include <vtkXMLImageDataReader.h>
#include <vtkXMLRectilinearGridReader.h>

#include <bzlib.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <map>
#include <sstream>
#include <stdexcept>

namespace voxsheet::import::testing {

namespace fs = std::filesystem;

namespace {

std::string rawBytes(const fs::path& path) {
    std::ifstream in(path, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(in), {});
}

/// gzip or zlib.
std::string inflated(std::string bytes) {
    z_stream stream{};
    inflateInit2(&stream, 15 + 32);
    stream.next_in = reinterpret_cast<Bytef*>(bytes.data());
    stream.avail_in = static_cast<uInt>(bytes.size());
    std::string out;
    std::array<char, 65536> block{};
    int status = Z_OK;
    while (status == Z_OK) {
        stream.next_out = reinterpret_cast<Bytef*>(block.data());
        stream.avail_out = static_cast<uInt>(block.size());
        status = inflate(&stream, Z_NO_FLUSH);
        out.append(block.data(), block.size() - stream.avail_out);
    }
    inflateEnd(&stream);
    if (status != Z_STREAM_END) throw std::runtime_error("inflate");
    return out;
}

std::string bunzipped(std::string bytes, std::size_t most) {
    std::string out(most, '\0');
    auto size = static_cast<unsigned>(most);
    if (BZ2_bzBuffToBuffDecompress(out.data(), &size, bytes.data(), static_cast<unsigned>(bytes.size()), 0,
                                   0) != BZ_OK)
        throw std::runtime_error("bunzip2");
    out.resize(size);
    return out;
}

/// The number at `index` of an array of `type`.
double numberAt(const std::string& bytes, std::size_t index, ScalarType type, bool bigEndian) {
    return visitScalar(type, [&]<typename T>() {
        std::array<char, sizeof(T)> raw{};
        std::memcpy(raw.data(), bytes.data() + index * sizeof(T), sizeof(T));
        if (bigEndian) std::reverse(raw.begin(), raw.end());
        T value{};
        std::memcpy(&value, raw.data(), sizeof(T));
        return static_cast<double>(value);
    });
}

/// Component fastest, then voxels, steps, and outer fields.
void splitArrays(PlainVolume& volume, const std::string& bytes, std::size_t components, std::size_t steps,
                 std::size_t outer, bool bigEndian) {
    const auto voxels = static_cast<std::size_t>(volume.dims.x * volume.dims.y * volume.dims.z);
    volume.steps = static_cast<int>(steps);
    volume.arrays.assign(components * outer * steps, std::vector<double>(voxels));
    std::size_t index = 0;
    for (std::size_t field = 0; field < outer; ++field)
        for (std::size_t step = 0; step < steps; ++step)
            for (std::size_t voxel = 0; voxel < voxels; ++voxel)
                for (std::size_t c = 0; c < components; ++c)
                    volume.arrays[(field * components + c) * steps + step][voxel] =
                        numberAt(bytes, index++, volume.type, bigEndian);
}

std::vector<double> numbersOf(const std::string& text) {
    std::vector<double> numbers;
    const char* at = text.c_str();
    for (char* end = nullptr;; at = end) {
        const double value = std::strtod(at, &end);
        if (end == at) return numbers;
        numbers.push_back(value);
    }
}

std::string replaced(std::string text, const std::string& characters, char by) {
    for (auto& c : text)
        if (characters.find(c) != std::string::npos) c = by;
    return text;
}

template <typename T>
T headerMember(const std::string& bytes, std::size_t offset, bool swap) {
    std::array<char, sizeof(T)> raw{};
    std::memcpy(raw.data(), bytes.data() + offset, sizeof(T));
    if (swap) std::reverse(raw.begin(), raw.end());
    T value{};
    std::memcpy(&value, raw.data(), sizeof(T));
    return value;
}

fs::path imageOf(const fs::path& header) {
    auto name = header.string();
    if (name.ends_with(".gz")) name.resize(name.size() - 3);
    name.resize(name.size() - 4);
    for (const auto* ending : {".img", ".img.gz"})
        if (fs::exists(name + ending)) return name + ending;
    return {};
}

fs::path headerOf(const fs::path& image) {
    auto name = image.string();
    const auto at = name.rfind(".img");
    if (at == std::string::npos) return image;
    for (const auto* ending : {".hdr", ".hdr.gz"})
        if (fs::exists(name.substr(0, at) + ending)) return name.substr(0, at) + ending;
    return image;
}

std::string fileOf(const fs::path& header, const std::string& value) {
    std::istringstream words(value);
    std::string name;
    words >> name;
    const auto number = name.find("%d");
    if (number == std::string::npos) return rawBytes(header.parent_path() / value);
    std::string all;
    int first = 0;
    int last = 0;
    int step = 1;
    words >> first >> last >> step;
    for (int i = first; i <= last; i += step)
        all += rawBytes(header.parent_path() /
                        (name.substr(0, number) + std::to_string(i) + name.substr(number + 2)));
    return all;
}

} // namespace

std::string plainBytes(const fs::path& path) {
    auto bytes = rawBytes(path);
    return bytes.starts_with("\x1f\x8b") ? inflated(std::move(bytes)) : bytes;
}

PlainVolume plainNifti(const fs::path& path) {
    const auto bytes = plainBytes(headerOf(path));
    const auto size = headerMember<std::int32_t>(bytes, 0, false);
    const bool swap = size != 348 && size != 540;
    const bool second = headerMember<std::int32_t>(bytes, 0, swap) == 540;
    const auto dim = [&](std::size_t i) {
        return second ? static_cast<std::size_t>(headerMember<std::int64_t>(bytes, 16 + 8 * i, swap))
                      : static_cast<std::size_t>(headerMember<std::int16_t>(bytes, 40 + 2 * i, swap));
    };
    const auto size1 = [&](std::size_t axis) { return axis <= dim(0) ? dim(axis) : std::size_t{1}; };
    const auto real = [&](std::size_t at1, std::size_t at2, std::size_t i) {
        return second ? headerMember<double>(bytes, at2 + 8 * i, swap)
                      : static_cast<double>(headerMember<float>(bytes, at1 + 4 * i, swap));
    };
    static const std::map<int, std::pair<ScalarType, std::size_t>> types{
        {2, {ScalarType::U8, 1}},     {4, {ScalarType::I16, 1}},    {8, {ScalarType::I32, 1}},
        {16, {ScalarType::F32, 1}},   {32, {ScalarType::F32, 2}},   {64, {ScalarType::F64, 1}},
        {128, {ScalarType::U8, 3}},   {256, {ScalarType::I8, 1}},   {512, {ScalarType::U16, 1}},
        {768, {ScalarType::U32, 1}},  {1024, {ScalarType::I64, 1}}, {1280, {ScalarType::U64, 1}},
        {1792, {ScalarType::F64, 2}}, {2304, {ScalarType::U8, 4}}};
    const auto [type, components] = types.at(headerMember<std::int16_t>(bytes, second ? 12 : 70, swap));
    PlainVolume volume;
    volume.type = type;
    volume.dims = glm::ivec3(size1(1), size1(2), size1(3));
    const bool affine = (second ? headerMember<std::int32_t>(bytes, 348, swap)
                                : headerMember<std::int16_t>(bytes, 254, swap)) > 0;
    for (glm::length_t axis = 0; axis < 3; ++axis) {
        const auto column = static_cast<std::size_t>(axis);
        volume.spacing[axis] = affine ? glm::length(glm::dvec3(real(280, 400, column), real(296, 432, column),
                                                               real(312, 464, column)))
                                      : std::abs(real(76, 104, column + 1));
    }
    const int unit = (second ? headerMember<std::int32_t>(bytes, 500, swap) : bytes[123]) & 7;
    volume.spacing *= unit == 1 ? 1000.0 : unit == 3 ? 0.001 : 1.0;
    const auto offset = second ? static_cast<std::size_t>(headerMember<std::int64_t>(bytes, 168, swap))
                               : static_cast<std::size_t>(headerMember<float>(bytes, 108, swap));
    const bool pair = bytes.compare(second ? 4 : 344, 2, "ni") == 0;
    const auto voxels = (pair ? plainBytes(imageOf(headerOf(path))) : bytes).substr(offset);
    splitArrays(volume, voxels, components, size1(4), size1(5), swap);
    return volume;
}

PlainVolume plainNrrd(const fs::path& path) {
    const auto bytes = rawBytes(path);
    std::map<std::string, std::string> fields;
    std::istringstream lines(bytes);
    std::string line;
    while (std::getline(lines, line) && !line.empty())
        if (const auto colon = line.find(": "); colon != std::string::npos && line[0] != '#')
            fields[line.substr(0, colon)] = line.substr(colon + 2);
    static const std::map<std::string, ScalarType> types{{"unsigned char", ScalarType::U8},
                                                         {"unsigned short", ScalarType::U16},
                                                         {"short", ScalarType::I16},
                                                         {"int16", ScalarType::I16},
                                                         {"double", ScalarType::F64}};
    PlainVolume volume;
    volume.type = types.at(fields.at("type"));
    const auto sizes = numbersOf(fields.at("sizes"));
    for (std::size_t axis = 0; axis < std::min<std::size_t>(sizes.size(), 3); ++axis)
        volume.dims[static_cast<glm::length_t>(axis)] = static_cast<int>(sizes[axis]);
    const auto values = static_cast<std::size_t>(volume.dims.x * volume.dims.y * volume.dims.z);

    const auto directions = numbersOf(replaced(fields["space directions"], "(),", ' '));
    const auto spacings = numbersOf(fields["spacings"]);
    for (std::size_t axis = 0; axis < 3; ++axis)
        volume.spacing[static_cast<glm::length_t>(axis)] =
            directions.size() >= 9   ? glm::length(glm::dvec3(directions[3 * axis], directions[3 * axis + 1],
                                                              directions[3 * axis + 2]))
            : axis < spacings.size() ? spacings[axis]
                                     : 0.0;

    const auto encoding = fields.at("encoding");
    auto data = fields.contains("data file") ? fileOf(path, fields["data file"])
                                             : bytes.substr(bytes.find("\n\n") + 2);
    for (int skip = std::atoi(fields["line skip"].c_str()); skip > 0; --skip)
        data.erase(0, data.find('\n') + 1);
    if (encoding == "gzip") data = inflated(data);
    if (encoding == "bzip2") data = bunzipped(data, values * scalarBytes(volume.type));
    if (encoding == "ASCII") {
        volume.arrays.push_back(numbersOf(data));
        return volume;
    }
    const auto needed = values * scalarBytes(volume.type);
    if (fields["byte skip"] == "-1") data.erase(0, data.size() - needed);
    splitArrays(volume, data, 1, 1, 1, fields["endian"] == "big");
    return volume;
}

PlainVolume plainMetaImage(const fs::path& path) {
    std::map<std::string, std::string> tags;
    std::istringstream lines(rawBytes(path));
    for (std::string line; std::getline(lines, line);) {
        line = replaced(line, "\r", ' ');
        const auto equals = line.find(" = ");
        auto value = line.substr(equals + 3);
        value.erase(value.find_last_not_of(' ') + 1);
        tags[line.substr(0, equals)] = value;
    }
    PlainVolume volume;
    const auto dims = numbersOf(tags.at("DimSize"));
    volume.dims = glm::ivec3(dims.at(0), dims.at(1), dims.at(2));
    const auto spacing = numbersOf(tags.at("ElementSpacing"));
    volume.spacing = {spacing.at(0), spacing.at(1), spacing.at(2)};
    volume.type = tags.at("ElementType") == "MET_UCHAR" ? ScalarType::U8 : ScalarType::I16;
    auto data = rawBytes(path.parent_path() / tags.at("ElementDataFile"));
    if (tags["CompressedData"] == "True") data = inflated(data);
    splitArrays(volume, data, 1, 1, 1, false);
    return volume;
}

PlainVolume plainVasp(const fs::path& path) {
    std::istringstream text(plainBytes(path));
    std::string line;
    std::getline(text, line);
    double scale = 0.0;
    text >> scale;
    std::array<glm::dvec3, 3> lattice;
    for (auto& vector : lattice)
        text >> vector.x >> vector.y >> vector.z;
    while (std::getline(text, line)) // the grid comes after the first empty line behind the atoms
        if (line.find_first_not_of(" \r") == std::string::npos && text.tellg() > 200) break;
    PlainVolume volume;
    text >> volume.dims.x >> volume.dims.y >> volume.dims.z;
    volume.type = ScalarType::F64;
    for (glm::length_t axis = 0; axis < 3; ++axis)
        volume.spacing[axis] =
            scale * glm::length(lattice[static_cast<std::size_t>(axis)]) / volume.dims[axis];
    auto& values = volume.arrays.emplace_back(static_cast<std::size_t>(volume.dims.x) *
                                              static_cast<std::size_t>(volume.dims.y * volume.dims.z));
    for (auto& value : values) {
        std::string word; // streams read fewer forms of numbers than strtod
        text >> word;
        value = std::strtod(word.c_str(), nullptr);
    }
    return volume;
}

PlainVolume plainCube(const fs::path& path) {
    constexpr double bohr = 0.529177210903;
    std::istringstream text(plainBytes(path));
    std::string line;
    std::getline(text, line);
    std::getline(text, line);
    int atoms = 0;
    glm::dvec3 origin;
    text >> atoms >> origin.x >> origin.y >> origin.z;
    PlainVolume volume;
    volume.type = ScalarType::F64;
    for (glm::length_t axis = 0; axis < 3; ++axis) {
        glm::dvec3 edge;
        text >> volume.dims[axis] >> edge.x >> edge.y >> edge.z;
        volume.spacing[axis] = bohr * glm::length(edge);
    }
    std::getline(text, line);
    for (int atom = 0; atom < atoms; ++atom)
        std::getline(text, line);
    const auto [nx, ny, nz] = std::array{volume.dims.x, volume.dims.y, volume.dims.z};
    auto& values = volume.arrays.emplace_back(static_cast<std::size_t>(nx * ny * nz));
    for (int x = 0; x < nx; ++x)
        for (int y = 0; y < ny; ++y)
            for (int z = 0; z < nz; ++z)
                text >> values[static_cast<std::size_t>(x + nx * (y + ny * z))];
    return volume;
}

namespace {

vtkSmartPointer<vtkDataSet> vtkDataSetOf(const fs::path& path) {
    const auto read = [&](auto reader) -> vtkSmartPointer<vtkDataSet> {
        reader->SetFileName(path.c_str());
        reader->Update();
        return reader->GetOutput();
    };
    if (path.extension() == ".vti") return read(vtkSmartPointer<vtkXMLImageDataReader>::New());
    if (path.extension() == ".vtr") return read(vtkSmartPointer<vtkXMLRectilinearGridReader>::New());
    if (path.extension() == ".slc") return read(vtkSmartPointer<vtkSLCReader>::New());
    if (rawBytes(path).find("RECTILINEAR_GRID") != std::string::npos)
        return read(vtkSmartPointer<vtkRectilinearGridReader>::New());
    return read(vtkSmartPointer<vtkStructuredPointsReader>::New());
}

double vtkSpacing(vtkDataSet* set, int axis) {
    if (auto* const image = vtkImageData::SafeDownCast(set)) return image->GetSpacing()[axis];
    auto* const grid = vtkRectilinearGrid::SafeDownCast(set);
    const std::array axes{grid->GetXCoordinates(), grid->GetYCoordinates(), grid->GetZCoordinates()};
    auto* const points = axes[static_cast<std::size_t>(axis)];
    return points->GetNumberOfTuples() < 2 ? 0.0 : points->GetTuple1(1) - points->GetTuple1(0);
}

} // namespace

PlainVolume vtkVolume(const fs::path& path) {
    const auto image = vtkDataSetOf(path);
    std::array<int, 3> points{};
    if (auto* const grid = vtkRectilinearGrid::SafeDownCast(image))
        grid->GetDimensions(points.data());
    else
        vtkImageData::SafeDownCast(image)->GetDimensions(points.data());
    const bool ofCells = image->GetPointData()->GetNumberOfArrays() == 0;
    PlainVolume volume;
    for (int axis = 0; axis < 3; ++axis) {
        volume.dims[axis] = std::max(1, points[static_cast<std::size_t>(axis)] - (ofCells ? 1 : 0));
        volume.spacing[axis] = vtkSpacing(image, axis);
    }
    vtkDataSetAttributes* const data =
        ofCells ? static_cast<vtkDataSetAttributes*>(image->GetCellData()) : image->GetPointData();
    static const std::map<int, ScalarType> types{{VTK_UNSIGNED_CHAR, ScalarType::U8},
                                                 {VTK_SIGNED_CHAR, ScalarType::I8},
                                                 {VTK_CHAR, ScalarType::I8},
                                                 {VTK_FLOAT, ScalarType::F32},
                                                 {VTK_DOUBLE, ScalarType::F64}};
    volume.type = types.at(data->GetArray(0)->GetDataType());
    for (int index = 0; index < data->GetNumberOfArrays(); ++index)
        for (int c = 0; c < data->GetArray(index)->GetNumberOfComponents(); ++c) {
            auto& values = volume.arrays.emplace_back();
            for (vtkIdType tuple = 0; tuple < data->GetArray(index)->GetNumberOfTuples(); ++tuple)
                values.push_back(data->GetArray(index)->GetComponent(tuple, c));
        }
    return volume;
}

} // namespace voxsheet::import::testing
