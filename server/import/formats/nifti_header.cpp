#include "import/formats/nifti_header.h"

#include "base/errors.h"
#include "import/formats/geometry.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace voxsheet::import {

namespace {

/// Numbers at byte offsets, of either byte order.
class Members {
public:
    Members(std::string_view bytes, bool swap) : bytes_(bytes), swap_(swap) {}

    template <typename T>
    [[nodiscard]] T at(std::size_t offset) const {
        std::array<char, sizeof(T)> raw{};
        std::memcpy(raw.data(), bytes_.data() + offset,
                    sizeof(T)); // callers checked the length of the header
        if (swap_) std::reverse(raw.begin(), raw.end());
        T value{};
        std::memcpy(&value, raw.data(), sizeof(T));
        return value;
    }
    template <typename T, typename Out, std::size_t N>
    void fill(std::array<Out, N>& out, std::size_t offset) const {
        for (std::size_t i = 0; i < N; ++i)
            out[i] = static_cast<Out>(at<T>(offset + i * sizeof(T)));
    }

private:
    std::string_view bytes_;
    bool swap_;
};

bool magicIs(std::string_view head, std::size_t offset, std::string_view word) {
    return head.size() >= offset + word.size() && head.substr(offset, word.size()) == word;
}

/// The size field in native (false) or swapped (true) order is `size`.
std::optional<bool> swappedFor(std::string_view head, std::int32_t size) {
    if (head.size() < 4) return std::nullopt;
    if (Members(head, false).at<std::int32_t>(0) == size) return false;
    if (Members(head, true).at<std::int32_t>(0) == size) return true;
    return std::nullopt;
}

NiftiHeader parseVersion1(std::string_view head, bool swap) {
    const Members members(head, swap);
    NiftiHeader header;
    header.singleFile = magicIs(head, 344, "n+1");
    members.fill<std::int16_t>(header.dim, 40);
    header.datatype = members.at<std::int16_t>(70);
    header.bitsPerVoxel = members.at<std::int16_t>(72);
    members.fill<float>(header.pixdim, 76);
    header.voxOffset = members.at<float>(108);
    header.slope = members.at<float>(112);
    header.intercept = members.at<float>(116);
    header.unitsCode = members.at<std::uint8_t>(123);
    header.timeOffset = members.at<float>(136);
    header.qformCode = members.at<std::int16_t>(252);
    header.sformCode = members.at<std::int16_t>(254);
    members.fill<float>(header.quaternion, 256);
    members.fill<float>(header.qOffset, 268);
    members.fill<float>(header.sform, 280);
    return header;
}

NiftiHeader parseVersion2(std::string_view head, bool swap) {
    const Members members(head, swap);
    NiftiHeader header;
    header.version = 2;
    header.singleFile = magicIs(head, 4, "n+2");
    header.datatype = members.at<std::int16_t>(12);
    header.bitsPerVoxel = members.at<std::int16_t>(14);
    members.fill<std::int64_t>(header.dim, 16);
    members.fill<double>(header.pixdim, 104);
    header.voxOffset = static_cast<double>(members.at<std::int64_t>(168));
    header.slope = members.at<double>(176);
    header.intercept = members.at<double>(184);
    header.timeOffset = members.at<double>(216);
    header.qformCode = members.at<std::int32_t>(344);
    header.sformCode = members.at<std::int32_t>(348);
    members.fill<double>(header.quaternion, 352);
    members.fill<double>(header.qOffset, 376);
    members.fill<double>(header.sform, 400);
    header.unitsCode = members.at<std::int32_t>(500);
    return header;
}

/// Method 2 of nifti1.h: rotation by a unit quaternion whose first component is implied.
glm::dmat4 fromQform(const std::string& name, const NiftiHeader& header) {
    double b = header.quaternion[0];
    double c = header.quaternion[1];
    double d = header.quaternion[2];
    if (!std::isfinite(b) || !std::isfinite(c) || !std::isfinite(d))
        throw InvalidInput(name, "the quaternion of its qform is not finite");
    double a = 1.0 - (b * b + c * c + d * d);
    if (a < 1e-7) { // a half turn, up to rounding
        const double scale = 1.0 / std::sqrt(b * b + c * c + d * d);
        b *= scale;
        c *= scale;
        d *= scale;
        a = 0.0;
    } else {
        a = std::sqrt(a);
    }
    const double third = header.pixdim[0] < 0.0 ? -1.0 : 1.0;
    const AxisColumns columns{
        std::abs(header.pixdim[1]) *
            glm::dvec3(a * a + b * b - c * c - d * d, 2 * (b * c + a * d), 2 * (b * d - a * c)),
        std::abs(header.pixdim[2]) *
            glm::dvec3(2 * (b * c - a * d), a * a + c * c - b * b - d * d, 2 * (c * d + a * b)),
        third * std::abs(header.pixdim[3]) *
            glm::dvec3(2 * (b * d + a * c), 2 * (c * d - a * b), a * a + d * d - b * b - c * c)};
    return affine(columns, {header.qOffset[0], header.qOffset[1], header.qOffset[2]});
}

glm::dmat4 fromSform(const NiftiHeader& header) {
    glm::dmat4 matrix(1.0);
    for (glm::length_t row = 0; row < 3; ++row)
        for (glm::length_t column = 0; column < 4; ++column)
            matrix[column][row] = header.sform[static_cast<std::size_t>(row * 4 + column)];
    return matrix;
}

bool isEmpty(const std::array<double, 12>& rows) {
    return std::all_of(rows.begin(), rows.end(), [](double value) { return value == 0.0; });
}

} // namespace

NiftiKind niftiKind(std::string_view head) {
    if (head.size() >= kNifti2Bytes && swappedFor(head, kNifti2Bytes) &&
        (magicIs(head, 4, std::string_view("n+2\0", 4)) || magicIs(head, 4, std::string_view("ni2\0", 4))))
        return NiftiKind::Nifti;
    if (head.size() < kNifti1Bytes || !swappedFor(head, kNifti1Bytes)) return NiftiKind::None;
    const bool named =
        magicIs(head, 344, std::string_view("n+1\0", 4)) || magicIs(head, 344, std::string_view("ni1\0", 4));
    return named ? NiftiKind::Nifti : NiftiKind::Analyze;
}

NiftiHeader parseNiftiHeader(const std::string& name, std::string_view head) {
    switch (niftiKind(head)) {
    case NiftiKind::None:
        throw InvalidInput(
            name,
            "it does not start with a NIfTI header (348 or 540 bytes with the words n+1, ni1, n+2 or ni2)",
            "copy or convert the file again");
    case NiftiKind::Analyze:
        throw Unsupported(name, "it is an Analyze 7.5 file, whose orientation is not defined",
                          "convert it to NIfTI");
    case NiftiKind::Nifti:
        break;
    }
    const auto swap2 = swappedFor(head, kNifti2Bytes);
    const bool swap = swap2 ? *swap2 : swappedFor(head, kNifti1Bytes).value_or(false);
    auto header = swap2 ? parseVersion2(head, swap) : parseVersion1(head, swap);
    header.bigEndian = swap; // this machine is little-endian
    return header;
}

NiftiPlacement niftiPlacement(const std::string& name, const NiftiHeader& header) {
    NiftiPlacement placement;
    if (header.sformCode > 0 && !isEmpty(header.sform)) {
        placement.worldFromIndex = fromSform(header);
        placement.anatomical = true;
        return placement;
    }
    if (header.sformCode > 0)
        placement.note = "The header announces an sform that is all zeros; it was left out.";
    for (std::size_t axis = 1; axis <= 3; ++axis) {
        const bool used = static_cast<std::int64_t>(axis) <= header.dim[0] && header.dim[axis] > 1;
        if (!std::isfinite(header.pixdim[axis]) || (used && header.pixdim[axis] == 0.0))
            throw InvalidInput(name,
                               "the spacing " + std::to_string(header.pixdim[axis]) + " is not possible",
                               "correct pixdim in the header");
    }
    auto corrected = header;
    for (std::size_t axis = 1; axis <= 3; ++axis)
        if (corrected.pixdim[axis] == 0.0)
            corrected.pixdim[axis] = 1.0; // an axis with one sample has no spacing
    if (header.qformCode > 0) {
        placement.worldFromIndex = fromQform(name, corrected);
        placement.anatomical = true;
        return placement;
    }
    AxisColumns columns{};
    for (std::size_t axis = 0; axis < 3; ++axis)
        columns[axis][static_cast<glm::length_t>(axis)] = std::abs(corrected.pixdim[axis + 1]);
    placement.worldFromIndex = affine(columns, glm::dvec3(0.0));
    if (placement.note.empty())
        placement.note = "The header gives spacing but no orientation (neither sform nor qform).";
    return placement;
}

} // namespace voxsheet::import
