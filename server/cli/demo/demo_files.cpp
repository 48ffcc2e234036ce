#include "cli/demo/demo_files.h"

#include "base/errors.h"
#include "cli/demo/analytic_fields.h"
#include "cli/demo/crystal_density.h"
#include "cli/demo/demo_workbook.h"

#include <array>
#include <charconv>
#include <cstring>
#include <fstream>
#include <functional>
#include <sstream>

namespace voxsheet::cli {

namespace fs = std::filesystem;

namespace {

constexpr glm::ivec3 kCrystalDims{144, 50, 70}; // about 0.1 Å
constexpr int kFieldDims = 64;
constexpr double kBeatExtentBohr = 9.0;
constexpr double kAngstromPerBohr = 0.529177210903;

void appendNumber(std::string& out, double value, int digits) {
    std::array<char, 40> text{};
    const auto end =
        std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::scientific, digits)
            .ptr;
    out.append(text.data(), end);
}

/// CHGCAR as VASP 5 writes it: lattice, sites, then density times cell volume, x fastest, five to a line.
std::string chgcar(const std::string& comment, const Supercell& cell) {
    std::ostringstream head;
    head << comment << "\n   1.0\n" << std::fixed;
    head.precision(6);
    for (int axis = 0; axis < 3; ++axis) {
        glm::dvec3 vector(0.0);
        vector[axis] = cell.lengths[axis];
        head << "  " << vector.x << "  " << vector.y << "  " << vector.z << "\n";
    }
    std::array<int, 3> counts{};
    for (const auto& site : cell.sites)
        ++counts[static_cast<std::size_t>(site.element)];
    head << "   Mg   Si   O\n";
    for (const int count : counts)
        head << "   " << count;
    head << "\nDirect\n";
    for (const auto& site : cell.sites)
        head << "  " << site.fractional.x << "  " << site.fractional.y << "  " << site.fractional.z << "\n";
    head << "\n  " << kCrystalDims.x << "  " << kCrystalDims.y << "  " << kCrystalDims.z << "\n";
    std::string text = head.str();
    const auto density = electronDensity(cell, kCrystalDims);
    const double volume = cell.lengths.x * cell.lengths.y * cell.lengths.z;
    text.reserve(text.size() + density.size() * 14);
    for (std::size_t i = 0; i < density.size(); ++i) {
        text.push_back(' ');
        appendNumber(text, density[i] * volume, 6);
        if (i % 5 == 4 || i + 1 == density.size()) text.push_back('\n');
    }
    return text;
}

std::string bytesOf(const std::vector<float>& values) {
    std::string bytes(values.size() * sizeof(float), '\0');
    std::memcpy(bytes.data(), values.data(), bytes.size());
    return bytes;
}

std::string nrrd(const std::string& content, const std::vector<float>& values, int n, double low,
                 double spacing) {
    std::ostringstream head;
    head << "NRRD0004\ncontent: " << content
         << "\ntype: float\ndimension: 3\nspace dimension: 3\nsizes: " << n << ' ' << n << ' ' << n
         << "\nspace directions: (" << spacing << ",0,0) (0," << spacing << ",0) (0,0," << spacing
         << ")\nspace origin: (" << low << ',' << low << ',' << low
         << ")\nkinds: domain domain domain\nendian: little\n"
         << "encoding: raw\n\n";
    return head.str() + bytesOf(values);
}

std::string readWhole(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

/// Whole or not at all: a temporary name first.
void writeWhole(const fs::path& file, const std::string& bytes) {
    const fs::path part = file.string() + ".part";
    std::ofstream out(part, std::ios::binary | std::ios::trunc);
    out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    out.close();
    std::error_code error;
    if (out) fs::rename(part, file, error);
    if (!out || error)
        throw IoError(file.string(), "could not be written", "check the folder's permissions and free space");
}

class DemoWriter {
public:
    explicit DemoWriter(fs::path folder) : folder_(std::move(folder)) {
        std::error_code error;
        fs::create_directories(folder_, error);
        if (error)
            throw IoError(folder_.string(), "could not be made: " + error.message(),
                          "name a folder that you may write to");
    }

    void write(const std::string& name, const std::string& bytes) {
        const auto file = folder_ / name;
        if (fs::exists(file) && readWhole(file) == bytes) {
            report_.unchanged.push_back(file);
            return;
        }
        writeWhole(file, bytes);
        report_.written.push_back(file);
    }

    /// A workbook is the user's as soon as it was edited: it is never overwritten.
    void writeWorkbook(const std::string& text) {
        report_.workbook = folder_ / "demo.json";
        if (fs::exists(report_.workbook) && readWhole(report_.workbook) != text) {
            for (int n = 1; report_.keptWorkbook.empty(); ++n) {
                const auto aside = folder_ / ("demo-edited-" + std::to_string(n) + ".json");
                if (!fs::exists(aside)) report_.keptWorkbook = aside;
            }
            fs::rename(report_.workbook, report_.keptWorkbook);
        }
        write("demo.json", text);
    }

    [[nodiscard]] DemoReport report() const { return report_; }

private:
    fs::path folder_;
    DemoReport report_;
};

} // namespace

DemoReport writeDemo(const fs::path& folder) {
    DemoWriter writer(folder);
    const auto perfect = perovskite60();
    writer.write("perfect_CHGCAR", chgcar("MgSiO3 perovskite, 60 sites, independent atoms", perfect));
    for (const auto element : {Element::Mg, Element::Si, Element::O}) {
        const std::string name = elementName(element);
        writer.write("vacancy_" + name + "_CHGCAR",
                     chgcar("MgSiO3 perovskite, " + name + " vacancy, independent atoms, model relaxation",
                            withVacancy(perfect, element)));
    }
    writer.write("marschner_lobb.nrrd", nrrd("Marschner-Lobb test signal", marschnerLobb(kFieldDims),
                                             kFieldDims, -1.0, 2.0 / (kFieldDims - 1)));
    for (int step = 0; step < 3; ++step) {
        const double phase = step / 4.0;
        const double extent = kBeatExtentBohr * kAngstromPerBohr;
        writer.write("hydrogen_beat_" + std::to_string(step) + ".nrrd",
                     nrrd("hydrogen 1s + 2p, phase " + std::to_string(step) + "/4",
                          hydrogenBeat(kFieldDims, kBeatExtentBohr, phase), kFieldDims, -extent,
                          2.0 * extent / (kFieldDims - 1)));
    }
    writer.writeWorkbook(demoWorkbookText());
    return writer.report();
}

} // namespace voxsheet::cli
