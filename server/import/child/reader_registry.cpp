#include "import/child/reader_registry.h"

#include "base/errors.h"
#include "import/formats/own_readers.h"
#include "import/mesh/mesh_reader.h"
#include "import/tiff/tiff_reader.h"
#include "import/vtk_legacy/legacy_vtk_reader.h"
#ifdef VOXSHEET_HAS_VTK
#include "import/vtk/amr_reader.h"
#include "import/vtk/vti_reader.h"
#endif

#include <array>
#include <string_view>

namespace voxsheet::import {

namespace {

using namespace std::string_view_literals;

struct Signature {
    std::size_t offset;
    std::string_view bytes;
    const char* format;
};

// Beginnings of formats that people have volumes in and that no reader here is for: naming them helps more
// than "unknown".
constexpr std::array<Signature, 10> kKnownButNotRead{{
    {128, "DICM"sv, "a DICOM image"},
    {0, "\x89HDF\r\n\x1a\n"sv, "an HDF5 or NetCDF-4 file"},
    {0, "CDF\x01"sv, "a NetCDF or Exodus file"},
    {0, "CDF\x02"sv, "a NetCDF or Exodus file"},
    {0, "\x89PNG\r\n"sv, "a PNG image"},
    {0, "\x76\x2f\x31\x01"sv, "an OpenEXR image"},
    {0, "\xff\xd8\xff"sv, "a JPEG image"},
    {0, "PK\x03\x04"sv, "a ZIP archive"},
    {0, "%PDF"sv, "a PDF document"},
    {0,
     "\x7f"
     "ELF"sv,
     "a program"},
}};

} // namespace

ReaderRegistry::ReaderRegistry() : readers_(makeOwnReaders()) {
    // Before the last one, for raw voxels, which takes any file when options describe it.
    const auto insert = [&](std::unique_ptr<SourceReader> reader) {
        readers_.insert(readers_.end() - 1, std::move(reader));
    };
    insert(makeLegacyVtkReader());
    insert(makeTiffReader());
#ifdef VOXSHEET_HAS_VTK
    insert(makeAmrReader()); // before the one that takes all XML of VTK
    insert(makeVtiReader());
#endif
    // Last: a binary STL is known by its length only.
    for (auto& reader : makeMeshReaders())
        readers_.push_back(std::move(reader));
}

const SourceReader& ReaderRegistry::choose(const std::filesystem::path& path,
                                           const ImportOptions& options) const {
    const auto head = readFileHead(path);
    for (const auto& reader : readers_)
        if (reader->recognises(head, options)) return *reader;
    for (const auto& [offset, bytes, format] : kKnownButNotRead)
        if (head.bytes.size() >= offset + bytes.size() &&
            head.bytes.compare(offset, bytes.size(), bytes) == 0)
            throw Unsupported(path.string(), std::string("it is ") + format + ", which cannot be read",
                              "convert it to one of: " + descriptions());
    if (head.bytes.find("<VTKFile") != std::string::npos) // only where the reader for it is left out
        throw Unsupported(path.string(), "it is a VTK XML file, and this build was made without VTK",
                          "build with -DVOXSHEET_VTK=ON");
    throw InvalidInput(path.string(), "it is in no format that is known here",
                       "formats are: " + descriptions());
}

std::string ReaderRegistry::descriptions() const {
    std::string text;
    for (const auto& reader : readers_)
        text += (text.empty() ? "" : ", ") + std::string(reader->description());
    return text;
}

} // namespace voxsheet::import
