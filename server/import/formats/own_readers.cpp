#include "import/formats/own_readers.h"

#include "base/errors.h"
#include "import/formats/byte_stream.h"
#include "import/formats/chgcar_reader.h"
#include "import/formats/cube_reader.h"
#include "import/formats/metaimage_reader.h"
#include "import/formats/nifti_reader.h"
#include "import/formats/nrrd_reader.h"
#include "import/formats/raw_reader.h"
#include "import/formats/slc_reader.h"
#include "import/formats/xsf_reader.h"

namespace voxsheet::import {

namespace {

/// As much of the decompressed head as there is; damaged data give what came before the damage.
std::string inflatedHead(const InputFile& file, Compression compression) {
    constexpr std::size_t piece = 1024; // what a block yields before damage in it is not given back
    std::string text;
    try {
        const auto stream = openStream(file, 0, compression);
        while (text.size() < FileHead::headBytes) {
            const auto before = text.size();
            text.resize(before + piece);
            const auto got = stream->read(std::as_writable_bytes(std::span(text).subspan(before)));
            text.resize(before + got);
            if (got < piece) break;
        }
    } catch (const InvalidInput&) {
        text.resize(text.size() / piece * piece);
        if (text.size() >= piece) text.resize(text.size() - piece);
    }
    return text;
}

} // namespace

std::vector<std::unique_ptr<SourceReader>> makeOwnReaders() {
    std::vector<std::unique_ptr<SourceReader>> readers;
    // Magic words first; cube and CHGCAR files are known by their shape only, raw ones by name or option
    // only.
    readers.push_back(std::make_unique<NrrdReader>());
    readers.push_back(std::make_unique<MetaImageReader>());
    readers.push_back(std::make_unique<NiftiReader>());
    readers.push_back(std::make_unique<SlcReader>());
    readers.push_back(std::make_unique<XsfReader>());
    readers.push_back(std::make_unique<CubeReader>());
    readers.push_back(std::make_unique<ChgcarReader>());
    readers.push_back(std::make_unique<RawReader>());
    return readers;
}

FileHead readFileHead(const std::filesystem::path& path) {
    const InputFile file(path);
    if (file.bytes() == 0) throw InvalidInput(file.name(), "it is empty", "copy or write the file again");
    FileHead head;
    head.path = path;
    head.fileBytes = file.bytes();
    head.bytes = file.textAt(0, FileHead::headBytes);
    const auto compression = compressionOf(head.bytes);
    head.inflated = compression == Compression::None ? head.bytes : inflatedHead(file, compression);
    return head;
}

} // namespace voxsheet::import
