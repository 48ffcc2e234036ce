#include "cli/bench/format_files.h"

#include "base/errors.h"
#include "cli/demo/analytic_fields.h"

#include <bzlib.h>
#include <zlib.h>

#include <algorithm>
#include <charconv>
#include <cstring>
#include <fstream>
#include <functional>
#include <random>

namespace voxsheet::cli {

namespace fs = std::filesystem;

namespace {

/// The volume, in the forms that files hold.
class Samples {
public:
    explicit Samples(int dim) : values_(marschnerLobb(dim)) {
        std::mt19937 random(1);
        for (auto& value : values_)
            value = value * 0.99F + 0.01F * static_cast<float>(random() % 1024) / 1024.0F;
    }

    [[nodiscard]] std::size_t count() const { return values_.size(); }

    [[nodiscard]] std::string shorts(bool bigEndian = false) const {
        std::string bytes(values_.size() * 2, '\0');
        for (std::size_t i = 0; i < values_.size(); ++i) {
            const auto value = static_cast<std::uint16_t>(values_[i] * 4095.0F);
            const auto low = static_cast<char>(value & 0xFFU);
            const auto high = static_cast<char>(value >> 8U);
            bytes[2 * i] = bigEndian ? high : low;
            bytes[2 * i + 1] = bigEndian ? low : high;
        }
        return bytes;
    }

    [[nodiscard]] std::string chars() const {
        std::string bytes(values_.size(), '\0');
        for (std::size_t i = 0; i < values_.size(); ++i)
            bytes[i] = static_cast<char>(static_cast<unsigned char>(values_[i] * 255.0F));
        return bytes;
    }

    /// "1.23456E-01", `digits` after the point, `perLine` in a line.
    [[nodiscard]] std::string decimals(int digits, int perLine) const {
        std::string text;
        text.reserve(values_.size() * static_cast<std::size_t>(digits + 8));
        char word[64];
        int column = 0;
        for (const float value : values_) {
            const auto end = std::to_chars(word, word + sizeof word, static_cast<double>(value),
                                           std::chars_format::scientific, digits);
            text += ' ';
            text.append(word, end.ptr);
            if (++column % perLine == 0) text += '\n';
        }
        return text + '\n';
    }

private:
    std::vector<float> values_;
};

std::string zipped(const std::string& bytes, int windowBits) {
    z_stream stream{};
    if (deflateInit2(&stream, 6, Z_DEFLATED, windowBits, 8, Z_DEFAULT_STRATEGY) != Z_OK)
        throw InternalError("bench import", "zlib could not be started");
    std::string out(deflateBound(&stream, static_cast<uLong>(bytes.size())) + 64, '\0');
    std::string in(bytes);
    stream.next_in = reinterpret_cast<Bytef*>(in.data());
    stream.avail_in = static_cast<uInt>(in.size());
    stream.next_out = reinterpret_cast<Bytef*>(out.data());
    stream.avail_out = static_cast<uInt>(out.size());
    const int result = deflate(&stream, Z_FINISH);
    out.resize(stream.total_out);
    deflateEnd(&stream);
    if (result != Z_STREAM_END) throw InternalError("bench import", "zlib does not compress");
    return out;
}

std::string bzipped(std::string bytes) {
    auto size = static_cast<unsigned>(bytes.size() + bytes.size() / 50 + 1024);
    std::string out(size, '\0');
    if (BZ2_bzBuffToBuffCompress(out.data(), &size, bytes.data(), static_cast<unsigned>(bytes.size()), 9, 0,
                                 0) != BZ_OK)
        throw InternalError("bench import", "libbz2 does not compress");
    out.resize(size);
    return out;
}

/// NIfTI-1 of unsigned shorts, a single file.
std::string niftiHeader(int dim) {
    std::string bytes(352, '\0');
    const auto set = [&](std::size_t at, auto value) {
        std::memcpy(bytes.data() + at, &value, sizeof value);
    };
    set(0, std::int32_t{348});
    set(40, std::int16_t{3});
    for (std::size_t axis = 1; axis < 8; ++axis) {
        set(40 + 2 * axis, static_cast<std::int16_t>(axis <= 3 ? dim : 1));
        set(76 + 4 * axis, 1.0F);
    }
    constexpr std::int16_t unsignedShort = 512;
    set(70, unsignedShort);
    set(72, std::int16_t{16});
    set(108, 352.0F);
    bytes.replace(344, 4, std::string("n+1\0", 4));
    return bytes;
}

class Writer {
public:
    Writer(const fs::path& folder, int dim, const std::string& only)
        : folder_(folder), dim_(dim), size_(std::to_string(dim)), only_(only), samples_(dim) {}

    void addBinary() {
        const auto raw = samples_.shorts();
        const auto nrrd =
            "NRRD0004\ntype: ushort\nendian: little\ndimension: 3\nsizes: " + sizes() + "\nencoding: ";
        const auto meta = "NDims = 3\nDimSize = " + sizes() + "\nElementType = MET_USHORT\n";
        const auto shorts = samples_.count() * 2;
        add(
            "nrrd raw", "a.nrrd", [&] { return nrrd + "raw\n\n"; }, [&] { return raw; }, PlainMethod::Read,
            shorts);
        add(
            "nrrd gzip", "gz.nrrd", [&] { return nrrd + "gzip\n\n"; }, [&] { return zipped(raw, 31); },
            PlainMethod::Zlib, shorts);
        add(
            "nrrd bzip2", "bz.nrrd", [&] { return nrrd + "bzip2\n\n"; }, [&] { return bzipped(raw); },
            PlainMethod::Bzip2, shorts);
        add(
            "metaimage raw", "a.mha", [&] { return meta + "ElementDataFile = LOCAL\n"; }, [&] { return raw; },
            PlainMethod::Read, shorts);
        add(
            "metaimage zlib", "z.mha",
            [&] { return meta + "CompressedData = True\nElementDataFile = LOCAL\n"; },
            [&] { return zipped(raw, 15); }, PlainMethod::Zlib, shorts);
        add(
            "nifti raw", "a.nii", [&] { return niftiHeader(dim_); }, [&] { return raw; }, PlainMethod::Read,
            shorts);
        add(
            "nifti gzip", "a.nii.gz", [] { return std::string(); },
            [&] { return zipped(niftiHeader(dim_) + raw, 31); }, PlainMethod::Zlib, shorts);
        add(
            "slc", "a.slc", [&] { return "11111\n" + sizes() + " 8\n1 1 1\n1 6 0 0\n0 0 X"; },
            [&] { return samples_.chars(); }, PlainMethod::Read, samples_.count());
        add(
            "vtk binary", "a.vtk", [&] { return vtk("BINARY", "unsigned_short"); },
            [&] { return samples_.shorts(true); }, PlainMethod::Read, shorts);
    }

    void addText() {
        const auto doubles = samples_.count() * sizeof(double);
        const auto floats = samples_.count() * sizeof(float);
        const auto six = [this] { return samples_.decimals(5, 6); };
        add(
            "nrrd ascii", "ascii.nrrd",
            [&] {
                return "NRRD0004\ntype: float\ndimension: 3\nsizes: " + sizes() + "\nencoding: ascii\n\n";
            },
            six, PlainMethod::Read, floats, true);
        add(
            "vtk ascii", "ascii.vtk", [&] { return vtk("ASCII", "float"); }, six, PlainMethod::Read, floats,
            true);
        add(
            "chgcar", "CHGCAR",
            [&] { return "x\n1\n9 0 0\n0 9 0\n0 0 9\nH\n1\nDirect\n0 0 0\n\n " + sizes() + "\n"; },
            [this] { return samples_.decimals(11, 5); }, PlainMethod::Read, doubles, true);
        add(
            "cube", "a.cube",
            [&] {
                return "x\ny\n1 0 0 0\n" + size_ + " 1 0 0\n" + size_ + " 0 1 0\n" + size_ +
                       " 0 0 1\n1 1 0 0 0\n";
            },
            six, PlainMethod::Read, doubles, true);
        add(
            "xsf", "a.xsf",
            [&] {
                return "BEGIN_BLOCK_DATAGRID_3D\nx\nBEGIN_DATAGRID_3D_x\n" + sizes() +
                       "\n0 0 0\n9 0 0\n0 9 0\n0 0 9\n";
            },
            [&] { return six() + "END_DATAGRID_3D\nEND_BLOCK_DATAGRID_3D\n"; }, PlainMethod::Read, doubles,
            true);
    }

    [[nodiscard]] std::vector<FormatFile> all() && { return std::move(files_); }

private:
    using Text = std::function<std::string()>;

    [[nodiscard]] std::string sizes() const { return size_ + " " + size_ + " " + size_; }

    [[nodiscard]] std::string vtk(const std::string& encoding, const std::string& type) const {
        return "# vtk DataFile Version 3.0\nx\n" + encoding + "\nDATASET STRUCTURED_POINTS\nDIMENSIONS " +
               sizes() + "\nSPACING 1 1 1\nORIGIN 0 0 0\nPOINT_DATA " + std::to_string(samples_.count()) +
               "\nSCALARS s " + type + " 1\nLOOKUP_TABLE default\n";
    }

    void add(const std::string& name, const std::string& fileName, const Text& header, const Text& data,
             PlainMethod plain, std::uint64_t voxelBytes, bool text = false) {
        if (name.find(only_) == std::string::npos) return;
        FormatFile file{name, folder_ / fileName, folder_ / fileName, 0, plain, text, voxelBytes};
        const auto head = header();
        file.dataOffset = head.size();
        std::ofstream out(file.file, std::ios::binary);
        out << head << data();
        if (!out.flush()) throw IoError(file.file.string(), "could not be written");
        files_.push_back(std::move(file));
    }

    fs::path folder_;
    int dim_;
    std::string size_;
    std::string only_;
    Samples samples_;
    std::vector<FormatFile> files_;
};

} // namespace

std::vector<FormatFile> writeFormatFiles(const fs::path& folder, int dim, const std::string& only) {
    Writer writer(folder, dim, only);
    writer.addBinary();
    writer.addText();
    return std::move(writer).all();
}

} // namespace voxsheet::cli
