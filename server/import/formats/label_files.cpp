#include "import/formats/label_files.h"

#include "base/errors.h"
#include "import/formats/label_lookup.h"
#include "import/formats/label_names.h"

#include <array>

namespace voxsheet::import {

namespace fs = std::filesystem;

namespace {

constexpr std::uint64_t kMostBytes = 1U << 20; // FreeSurfer's own table has 120 kB

std::string stemOf(const fs::path& file) {
    auto name = file.filename();
    if (name.extension() == ".gz" || name.extension() == ".bz2") name = name.stem();
    return name.stem().string();
}

std::optional<fs::path> besideIfThere(const fs::path& file, const std::string& name) {
    std::error_code error;
    if (!fs::exists(file.parent_path() / name, error)) return std::nullopt;
    return resolveBeside(file, name);
}

/// False if the file is something else.
bool addLookup(const fs::path& path, SourceHeader& header) {
    const InputFile file(path);
    if (file.bytes() > kMostBytes) return false;
    const auto lookup = parseLabelLookup(file.textAt(0, kMostBytes));
    if (!lookup) return false;
    header.meta.labels = lookup->labels;
    header.files.push_back(path);
    const auto name = printable(path.filename().string());
    header.meta.notes.push_back("Names of labels come from " + name + ".");
    if (lookup->linesLeftOut > 0)
        header.meta.notes.push_back(std::to_string(lookup->linesLeftOut) + " lines of " + name +
                                    " were left out: they are no rows of its table, or name a value again.");
    return true;
}

} // namespace

void addLabelFiles(const fs::path& file, SourceHeader& header) {
    const auto stem = stemOf(file);
    if (const auto sidecar = besideIfThere(file, stem + ".labels.json")) {
        header.meta.labels = readLabelSidecar(InputFile(*sidecar));
        header.files.push_back(*sidecar);
        return;
    }
    if (!header.meta.labels.empty()) return;
    constexpr std::array endings{".label", ".lut", ".ctbl",           ".tsv", ".txt", ".niml.lt",
                                 ".lt",    ".xml", "_ColorTable.ctbl"};
    for (const auto* ending : endings) {
        try {
            const auto found = besideIfThere(file, stem + ending);
            if (found && *found != header.files.front() && addLookup(*found, header)) return;
        } catch (const Error&) { // a folder, a link elsewhere, not to be read: no file of ours
        }
    }
}

} // namespace voxsheet::import
