// Grids of numbers in long text files, as the formats of the electronic structure programs hold them.
#pragma once

#include "import/formats/input_file.h"
#include "import/formats/number_batch.h"
#include "import/formats/text_scanner.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace voxsheet::import {

/// The text of a file, decompressed if it is compressed. The file must live as long as the scanner.
[[nodiscard]] TextScanner openText(const InputFile& file);

/// The first three words as finite numbers, in Fortran's forms too; what follows is free.
[[nodiscard]] std::optional<glm::dvec3> leadingVector(std::string_view line);

/// Throws InvalidInput if the file is too small for so many numbers, a digit and a blank each: to be asked
/// before anything is allocated.
void checkTextHolds(const InputFile& file, std::uint64_t values);

/// Passes over the values of a grid. Throws InvalidInput when there are too few; `grid` names it ("grid 2").
void skipGrid(const InputFile& file, TextScanner& text, std::uint64_t values, const std::string& grid);

/// The values of a grid, one after the other. The scanner must outlive it.
class GridValues {
public:
    /// `name` is the subject of errors, `count` the number of values that are promised.
    GridValues(TextScanner& text, std::string name, std::uint64_t count)
        : text_(text), name_(std::move(name)), count_(count) {}

    /// To be called at most `count` times. Throws InvalidInput at the end of the file, at a word that is no
    /// number, and when the file ends within the last value (which shows where all values are equally wide).
    [[nodiscard]] double next() {
        if (at_ == ready_.size()) fetch();
        ++done_;
        return ready_[at_++];
    }
    /// Part of the values that were read, 0..1.
    [[nodiscard]] double fraction() const { return static_cast<double>(done_) / static_cast<double>(count_); }

private:
    void fetch();
    void add(const NumberPiece<double>& piece, std::uint64_t wanted);
    void checkLastValue();

    TextScanner& text_;
    std::string name_;
    std::uint64_t count_;
    std::uint64_t done_ = 0;
    std::vector<double> ready_; ///< parsed, from at_ on not yet taken
    std::size_t at_ = 0;
    std::size_t width_ = 0;        ///< of the last word parsed, without its sign
    std::size_t earlierWidth_ = 0; ///< of the words before it; 0: there are none
    bool equallyWide_ = true;      ///< the words before the last have one width
};

} // namespace voxsheet::import
