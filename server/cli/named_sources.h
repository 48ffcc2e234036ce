// What the words of a command line put into a sheet: data files and formulas.
#pragma once

#include "sheet/style_keys.h"
#include "sheet/workbook.h"

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace voxsheet::cli {

/// True for a word that is a formula, not a file: it begins with '='. (A file of such a name: "./=name".)
[[nodiscard]] bool isFormula(const std::string& word);

/// The files of each series in their order, by the word that stands for it: its first file.
using SeriesFiles = std::map<std::string, std::vector<std::string>>;

/// Series of three and more files whose names differ in one number; the other files of each leave `words`.
[[nodiscard]] SeriesFiles takeSeries(std::vector<std::string>& words);

struct SheetShape {
    std::optional<int> columns; ///< not set: near-square
    std::string layout;         ///< pattern of layout_pattern.h that places the files; empty: none
    bool series = false;        ///< three and more files whose names differ in one number are one dataset
};

/// One sheet whose cells hold the words in reading order: a file as a dataset, a formula as it is. Files
/// alone are sorted naturally; beside a formula, which names cells by their places, every word stays where it
/// was written; a series stands in the place of its first file. With a layout the files stand where their
/// names say, and formulas in the cells left free. Relative paths start from `folder`. Throws InvalidInput or
/// LimitExceeded if columns or layout do not fit. Formulas are not read: what is wrong with one is the error
/// value of its cell.
[[nodiscard]] sheet::Workbook workbookOfWords(std::vector<std::string> words, const SheetShape& shape,
                                              const std::filesystem::path& folder,
                                              const sheet::KeyTable& keys);

} // namespace voxsheet::cli
