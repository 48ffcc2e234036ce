#include "cli/named_sources.h"

#include "http/resource/folder_listing.h"
#include "sheet/commands.h"
#include "sheet/dataset_names.h"
#include "sheet/layout.h"
#include "sheet/layout_pattern.h"

#include <algorithm>
#include <iterator>
#include <set>

namespace voxsheet::cli {

namespace {

/// Names, places and titles by the same rules as any other import.
sheet::AddDatasets datasetsOf(const std::vector<std::string>& paths, const SeriesFiles& series,
                              const std::filesystem::path& folder) {
    const auto names = sheet::distinguishingNames(paths);
    sheet::AddDatasets add;
    for (std::size_t i = 0; i < paths.size(); ++i) {
        sheet::NamedDataset dataset;
        dataset.name = names[i];
        const auto found = series.find(paths[i]);
        for (const auto& file : found == series.end() ? std::vector{paths[i]} : found->second)
            dataset.source.files.push_back((folder / file).lexically_normal().string());
        add.datasets.push_back(std::move(dataset));
    }
    return add;
}

void placeByNames(sheet::AddDatasets& add, sheet::Sheet& page, const std::string& pattern,
                  const std::vector<std::string>& paths) {
    const auto placement = sheet::placeByPattern(pattern, paths);
    add.columnTitles = placement.columnTitles;
    add.rowTitles = placement.rowTitles;
    page.columns = placement.layout.columns;
    page.rows = placement.layout.rows;
    for (std::size_t i = 0; i < paths.size(); ++i)
        add.datasets[i].place = placement.places[i];
}

/// The formulas in their places among the words; the files then fill the cells between.
void placeFormulas(sheet::Sheet& page, const std::vector<std::string>& words) {
    for (std::size_t i = 0; i < words.size(); ++i) {
        const auto columns = static_cast<std::size_t>(page.columns);
        const sheet::Address place{static_cast<int>(i % columns), static_cast<int>(i / columns)};
        if (isFormula(words[i])) page.cells[place].source = words[i];
    }
}

void placeInFreeCells(sheet::Sheet& page, const std::vector<std::string>& formulas) {
    const auto free = sheet::freeCells(page, formulas.size());
    page.columns = free.grown.columns;
    page.rows = free.grown.rows;
    for (std::size_t i = 0; i < formulas.size(); ++i)
        page.cells[free.cells[i]].source = formulas[i];
}

} // namespace

bool isFormula(const std::string& word) { return word.starts_with('='); }

SeriesFiles takeSeries(std::vector<std::string>& words) {
    auto files = words;
    std::erase_if(files, isFormula);
    sheet::sortNaturally(files);
    SeriesFiles found;
    std::set<std::string> others;
    for (const auto& series : http::findSeries(files)) {
        auto& members = found[files[series.members.front()]];
        for (const auto member : series.members)
            members.push_back(files[member]);
        others.insert(members.begin() + 1, members.end());
    }
    std::erase_if(words, [&](const std::string& word) { return others.contains(word); });
    return found;
}

sheet::Workbook workbookOfWords(std::vector<std::string> words, const SheetShape& shape,
                                const std::filesystem::path& folder, const sheet::KeyTable& keys) {
    const auto series = shape.series ? takeSeries(words) : SeriesFiles{};
    std::vector<std::string> formulas;
    std::copy_if(words.begin(), words.end(), std::back_inserter(formulas), isFormula);
    if (formulas.empty()) sheet::sortNaturally(words);
    std::vector<std::string> paths;
    std::copy_if(words.begin(), words.end(), std::back_inserter(paths),
                 [](const std::string& word) { return !isFormula(word); });

    sheet::Workbook workbook;
    sheet::Sheet& page = workbook.sheets.front();
    auto add = datasetsOf(paths, series, folder);
    add.sheet = page.name;
    add.columns = shape.columns;
    if (!shape.layout.empty()) {
        placeByNames(add, page, shape.layout, paths);
    } else if (!formulas.empty()) {
        const auto layout = shape.columns ? sheet::layoutWithColumns(words.size(), *shape.columns)
                                          : sheet::chooseLayout(words.size());
        page.columns = layout.columns;
        page.rows = layout.rows;
        placeFormulas(page, words);
    }
    workbook = sheet::apply(workbook, add, keys);
    if (!shape.layout.empty()) placeInFreeCells(workbook.sheets.front(), formulas);
    return workbook;
}

} // namespace voxsheet::cli
