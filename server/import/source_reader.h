// What every reader of a source file offers to the importer. Two phases: the header says what is in the file
// and is checked against the file's size and the limits; only then are voxels allocated and read.
#pragma once

#include "volume/dataset.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace voxsheet::import {

/// What several files make together.
enum class SeriesKind {
    Stack, ///< slices, or slabs, of one volume
    Steps, ///< volumes that follow each other in time
};

/// What a user may say about a file. Members starting with "raw" describe a file without a header and serve
/// only there.
struct ImportOptions {
    std::optional<glm::ivec3> rawDims; ///< x, y, z samples
    std::optional<ScalarType> rawType;
    bool rawBigEndian = false;
    std::uint64_t rawSkipBytes = 0; ///< before the first voxel
    int rawComponents = 1;          ///< interleaved values per voxel, one field each

    std::optional<glm::dvec3> spacing; ///< lengths of the voxel edges, world units, > 0; directions stay
    std::optional<std::string>
        orientation; ///< "LPI": where the index axes x, y, z lead: R or L, A or P, S or I, each once
    std::optional<glm::dvec3> origin; ///< world position of sample (0, 0, 0)
    glm::bvec3 flip{false};           ///< mirrors the volume along an index axis, within its own box
    std::optional<glm::bvec3> periodic;
    std::optional<std::uint64_t> bitMask; ///< these bits of stored whole numbers are kept; not 0
    std::optional<double> noDataValue;    ///< this source number becomes NaN, after bitMask
    std::optional<int> resolution; ///< of the volume made from a surface: samples along its longest axis
    std::optional<bool>
        divideByCellVolume; ///< CHGCAR family; by default decided by the name (LOCPOT, ELFCAR: no)
    std::optional<SeriesKind>
        series; ///< of several files; by default single slices are stacked, volumes are steps
};

struct ImportLimits {
    std::uint64_t maxBytes = 16ULL << 30; ///< of level-0 voxels, all fields and steps together
};

/// The beginning of a file, for recognition.
struct FileHead {
    std::filesystem::path path;
    std::uint64_t fileBytes = 0;
    std::string bytes; ///< at most headBytes, as on disk
    std::string
        inflated; ///< the same of the decompressed contents if the file is gzip; otherwise equal to bytes

    static constexpr std::size_t headBytes = 64 * 1024;
};

/// Result of the header phase.
struct SourceHeader {
    /// Geometry, fields (FieldMeta::steps empty), times, crystal, notes. key and sourcePath are left empty.
    DatasetMeta meta;
    /// Every file that the voxels depend on, the opened one first, canonical: the store's key covers them
    /// all.
    std::vector<std::filesystem::path> files;
    /// What the reader itself needs to know for readData; nobody else looks inside.
    std::shared_ptr<const void> plan;

    /// Bytes of one level-0 array of a field: dims.x * dims.y * dims.z * scalarBytes(storedType).
    [[nodiscard]] std::uint64_t arrayBytes(int field) const;
    /// Sum of arrayBytes over all fields and steps.
    [[nodiscard]] std::uint64_t totalBytes() const;
};

/// Receives each level-0 array once, in any order: x fastest, native little-endian, header.arrayBytes(field)
/// bytes.
using ArraySink = std::function<void(int field, int step, std::vector<std::byte>&& voxels)>;
/// Fraction of the source read, 0..1, never decreasing. May throw to stop the import.
using ReadProgress = std::function<void(double fraction)>;

/// Stateless; one object serves any number of files and threads.
class SourceReader {
public:
    virtual ~SourceReader() = default;

    /// DatasetMeta::format of what it reads: "nrrd", "metaimage", …
    [[nodiscard]] virtual const char* format() const = 0;
    /// For people: "NRRD (.nrrd, .nhdr)".
    [[nodiscard]] virtual const char* description() const = 0;
    /// By content first; the name is a hint. Never throws for what a file contains.
    [[nodiscard]] virtual bool recognises(const FileHead& head, const ImportOptions& options) const = 0;

    /// Allocates no voxels. The result is validated: grid, at least one field, sizes against the files and
    /// `limits`. Throws InvalidInput (damaged, inconsistent), Unsupported (well formed, but not readable
    /// here), LimitExceeded, NotFound or IoError (a data file beside it).
    [[nodiscard]] virtual SourceHeader readHeader(const std::filesystem::path& path,
                                                  const ImportOptions& options,
                                                  const ImportLimits& limits) const = 0;
    /// Reads what `header` (from this reader's readHeader) describes. Returns further notes for
    /// DatasetMeta::notes: what only the data could tell. Throws as readHeader; arrays that went to the sink
    /// before a throw are to be thrown away.
    [[nodiscard]] virtual std::vector<std::string> readData(const SourceHeader& header, const ArraySink& sink,
                                                            const ReadProgress& progress) const = 0;
};

} // namespace voxsheet::import
