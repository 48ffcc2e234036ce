#include "http/resource/format_guess.h"

#include "http/net/unique_fd.h"

#include <algorithm>
#include <bzlib.h>
#include <cctype>
#include <cstdint>
#include <cstring>
#include <fcntl.h>
#include <sstream>
#include <string_view>
#include <zlib.h>

namespace voxsheet::http {

namespace {

constexpr std::size_t kHeadBytes = std::size_t{16} << 10U;

/// bzip2 gives nothing out before a whole block of up to 900 kB has come in.
constexpr std::size_t kBzip2BlockBytes = 1'000'000;

std::string readHead(const std::filesystem::path& file, std::size_t bytes) {
    // Not blocking: the name may belong to a pipe by now.
    const UniqueFd fd(::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
    if (!fd.valid()) return {};
    std::string head(bytes, '\0');
    const auto count = ::pread(fd.get(), head.data(), head.size(), 0);
    head.resize(count > 0 ? static_cast<std::size_t>(count) : 0);
    return head;
}

/// The beginning of what a gzip file unpacks to; as it is otherwise.
std::string unpackedHead(std::string head) {
    if (head.size() < 2 || static_cast<unsigned char>(head[0]) != 0x1F ||
        static_cast<unsigned char>(head[1]) != 0x8B)
        return head;
    z_stream stream{};
    if (inflateInit2(&stream, 16 + MAX_WBITS) != Z_OK) return {};
    std::string out(kHeadBytes, '\0');
    stream.next_in = reinterpret_cast<Bytef*>(head.data());
    stream.avail_in = static_cast<uInt>(head.size());
    stream.next_out = reinterpret_cast<Bytef*>(out.data());
    stream.avail_out = static_cast<uInt>(out.size());
    inflate(&stream, Z_SYNC_FLUSH); // an incomplete stream is what we expect
    out.resize(out.size() - stream.avail_out);
    inflateEnd(&stream);
    return out;
}

/// The same for bzip2.
std::string unpackedBzip2Head(std::string head) {
    bz_stream stream{};
    if (BZ2_bzDecompressInit(&stream, 0, 0) != BZ_OK) return {};
    std::string out(kHeadBytes, '\0');
    stream.next_in = head.data();
    stream.avail_in = static_cast<unsigned>(head.size());
    stream.next_out = out.data();
    stream.avail_out = static_cast<unsigned>(out.size());
    while (stream.avail_in > 0 && stream.avail_out > 0 && BZ2_bzDecompress(&stream) == BZ_OK) {
    }
    out.resize(out.size() - stream.avail_out);
    BZ2_bzDecompressEnd(&stream);
    return out;
}

std::string contentsHead(const std::filesystem::path& file) {
    auto head = readHead(file, kHeadBytes);
    if (head.starts_with("BZh")) return unpackedBzip2Head(readHead(file, kBzip2BlockBytes));
    return unpackedHead(std::move(head));
}

bool isNifti(std::string_view head) {
    if (head.size() < 348) return false;
    const auto magic = head.substr(344, 3);
    if (magic == "n+1" || magic == "ni1") return true;
    return head.substr(4, 3) == "n+2" || head.substr(4, 3) == "ni2";
}

/// How many numbers the line holds; -1 if it holds anything else.
int countNumbers(std::string line) {
    std::replace(line.begin(), line.end(), 'D', 'E'); // Fortran's exponents
    std::istringstream in(line);
    double value = 0.0;
    int count = 0;
    while (in >> value)
        ++count;
    return in.eof() ? count : -1;
}

/// CHGCAR family: a comment, a scale, three lattice vectors.
bool isChgcar(const std::string& head) {
    std::istringstream lines(head);
    std::string line;
    if (!std::getline(lines, line) || !std::getline(lines, line)) return false;
    if (countNumbers(line) != 1) return false;
    for (int i = 0; i < 3; ++i)
        if (!std::getline(lines, line) || countNumbers(line) != 3) return false;
    return true;
}

/// Gaussian cube: two comments, atoms' number and origin (and values a voxel), three numbers of voxels with
/// vectors; a whole number begins each.
bool isCube(const std::string& head) {
    std::istringstream lines(head);
    std::string line;
    if (!std::getline(lines, line) || !std::getline(lines, line)) return false;
    for (int i = 0; i < 4; ++i) {
        if (!std::getline(lines, line)) return false;
        const int count = countNumbers(line);
        if (count != 4 && !(i == 0 && count == 5)) return false;
        std::string first;
        std::istringstream(line) >> first;
        if (first.find_first_not_of("+-0123456789") != std::string::npos) return false;
    }
    return true;
}

/// TIFF and BigTIFF in either byte order.
bool isTiff(std::string_view head) {
    using namespace std::string_view_literals;
    return head.starts_with("II*\0"sv) || head.starts_with("MM\0*"sv) || head.starts_with("II+\0"sv) ||
           head.starts_with("MM\0+"sv);
}

/// VolVis: the magic number, three sizes and the bits per voxel, as text.
bool isSlc(const std::string& head) {
    if (!head.starts_with("11111")) return false;
    std::istringstream words(head);
    std::string magic;
    std::int64_t number = 0;
    words >> magic;
    for (int i = 0; i < 4; ++i)
        words >> number;
    const int next = words.peek();
    return magic == "11111" && !words.fail() && next != EOF && std::isspace(next) != 0;
}

/// XSF: after comments a keyword alone in its line, then what may follow it.
bool isXsf(const std::string& head) {
    std::istringstream lines(head);
    std::string keyword;
    std::string next;
    const auto read = [&](std::string& line) {
        while (std::getline(lines, line)) {
            line.erase(0, line.find_first_not_of(" \t\r"));
            line.erase(line.find_last_not_of(" \t\r") + 1);
            if (!line.empty() && line[0] != '#') return true;
        }
        return false;
    };
    if (!read(keyword) || !read(next)) return false;
    if (keyword == "CRYSTAL" || keyword == "SLAB" || keyword == "POLYMER" || keyword == "MOLECULE")
        return std::isupper(static_cast<unsigned char>(next[0])) != 0;
    if (keyword == "PRIMVEC") return countNumbers(next) == 3;
    if (keyword == "DIM-GROUP") return countNumbers(next) == 2;
    return keyword == "ATOMS" || keyword.starts_with("BEGIN_BLOCK_DATAGRID_3D");
}

bool isMetaImage(std::string_view head) {
    const auto firstLine = head.substr(0, head.find('\n'));
    return firstLine.starts_with("ObjectType") || firstLine.starts_with("NDims") ||
           (head.find("ElementDataFile") != std::string_view::npos &&
            head.find("DimSize") != std::string_view::npos);
}

bool holdsOneOf(std::string_view text, std::initializer_list<std::string_view> words) {
    return std::any_of(words.begin(), words.end(),
                       [&](auto word) { return text.find(word) != std::string_view::npos; });
}

std::optional<std::string> vtkXmlFormat(std::string_view text) {
    if (holdsOneOf(text, {"\"ImageData\"", "\"RectilinearGrid\""})) return "vti";
    if (holdsOneOf(text,
                   {"\"vtkOverlappingAMR\"", "\"vtkNonOverlappingAMR\"", "\"vtkHierarchicalBoxDataSet\""}))
        return "amr";
    return std::nullopt;
}

/// Surfaces. A binary STL is known by its length: 80 bytes, a count of triangles and 50 bytes for each.
std::optional<std::string> meshFormat(const std::filesystem::path& file, std::string_view head) {
    if (head.starts_with("ply\n") || head.starts_with("ply\r")) return "ply";
    if (head.starts_with("solid") && head.find("facet") != std::string_view::npos) return "stl";
    if (head.size() >= 84) {
        std::uint32_t triangles = 0;
        std::memcpy(&triangles, head.data() + 80, sizeof(triangles));
        std::error_code error;
        if (std::filesystem::file_size(file, error) == 84 + std::uint64_t{triangles} * 50 && !error)
            return "stl";
    }
    if (file.extension() == ".obj" && head.find("v ") != std::string_view::npos) return "obj";
    return std::nullopt;
}

} // namespace

std::optional<std::string> guessFormat(const std::filesystem::path& file) {
    const auto head = contentsHead(file);
    const std::string_view text = head;
    if (text.starts_with("NRRD00")) return "nrrd";
    if (isNifti(text)) return "nifti";
    if (text.substr(0, 512).find("<VTKFile") != std::string_view::npos) return vtkXmlFormat(text);
    if (text.starts_with("# vtk DataFile"))
        return holdsOneOf(text, {"STRUCTURED_POINTS", "RECTILINEAR_GRID"}) ? std::optional<std::string>("vtk")
                                                                           : std::nullopt;
    if (const auto mesh = meshFormat(file, text)) return mesh;
    if (isMetaImage(text)) return "metaimage";
    if (isTiff(text)) return "tiff";
    if (isSlc(head)) return "slc";
    if (isXsf(head)) return "xsf";
    if (isCube(head)) return "cube";
    if (isChgcar(head)) return "chgcar";
    if (file.extension() == ".json" && text.find("\"dims\"") != std::string_view::npos) return "raw";
    return std::nullopt;
}

} // namespace voxsheet::http
