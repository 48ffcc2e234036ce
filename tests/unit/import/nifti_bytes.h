// NIfTI headers made member by member, in either byte order.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace voxsheet::import::testing {

class NiftiBytes {
public:
    NiftiBytes(int version, bool bigEndian, const std::vector<std::int64_t>& dims, int datatype,
               bool single = true)
        : version_(version), big_(bigEndian), bytes_(version == 1 ? 348U : 540U, '\0') {
        set<std::int32_t>(0, version == 1 ? 348 : 540);
        const std::string magic = std::string(single ? "n+" : "ni") + (version == 1 ? '1' : '2') + '\0';
        bytes_.replace(version == 1 ? 344 : 4, 4, magic);
        for (std::size_t axis = 0; axis < 8; ++axis) {
            const std::int64_t size = axis == 0             ? static_cast<std::int64_t>(dims.size())
                                      : axis <= dims.size() ? dims[axis - 1]
                                                            : 1;
            if (version == 1)
                set<std::int16_t>(40 + 2 * axis, static_cast<std::int16_t>(size));
            else
                set<std::int64_t>(16 + 8 * axis, size);
            setReal(76 + 4 * axis, 104 + 8 * axis, 1.0);
        }
        set<std::int16_t>(version == 1 ? 70 : 12, static_cast<std::int16_t>(datatype));
        if (version == 1)
            set<float>(108, single ? 352.0F : 0.0F);
        else
            set<std::int64_t>(168, single ? 544 : 0);
    }

    /// At the offset of version 1 or 2, float or double.
    void setReal(std::size_t at1, std::size_t at2, double value) {
        if (version_ == 1)
            set<float>(at1, static_cast<float>(value));
        else
            set<double>(at2, value);
    }
    void setPixdim(std::size_t axis, double value) { setReal(76 + 4 * axis, 104 + 8 * axis, value); }
    void setScaling(double slope, double intercept) {
        setReal(112, 176, slope);
        setReal(116, 184, intercept);
    }
    void setSform(const std::vector<double>& rows) {
        if (version_ == 1)
            set<std::int16_t>(254, 1);
        else
            set<std::int32_t>(348, 1);
        for (std::size_t i = 0; i < 12; ++i)
            setReal(280 + 4 * i, 400 + 8 * i, rows[i]);
    }
    void setQform(double b, double c, double d, double x, double y, double z) {
        if (version_ == 1)
            set<std::int16_t>(252, 1);
        else
            set<std::int32_t>(344, 1);
        const double values[] = {b, c, d, x, y, z};
        for (std::size_t i = 0; i < 6; ++i)
            setReal(256 + 4 * i, 352 + 8 * i, values[i]);
    }
    void setUnits(int code) {
        if (version_ == 1)
            bytes_[123] = static_cast<char>(code);
        else
            set<std::int32_t>(500, code);
    }
    template <typename T>
    void set(std::size_t at, T value) {
        char raw[sizeof(T)];
        std::memcpy(raw, &value, sizeof(T));
        if (big_) std::reverse(raw, raw + sizeof(T));
        bytes_.replace(at, sizeof(T), raw, sizeof(T));
    }

    [[nodiscard]] std::string header() const { return bytes_; }
    /// A single file: header, no extensions, voxels.
    [[nodiscard]] std::string with(const std::string& voxels) const {
        return bytes_ + std::string(4, '\0') + voxels;
    }

private:
    int version_;
    bool big_;
    std::string bytes_;
};

} // namespace voxsheet::import::testing
