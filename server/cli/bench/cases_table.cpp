#include "cli/bench/cases_table.h"

#include <algorithm>
#include <cstdio>
#include <vector>

namespace voxsheet::cli {
namespace {

struct Column {
    std::string name;
    bool toTheLeft = true;
    bool hasFractions = false;
    std::size_t width = 0;
    std::vector<std::string> cells;
};

std::vector<Column> columnsOf(const nlohmann::json& cases) {
    std::vector<Column> columns;
    for (const auto& one : cases)
        for (const auto& [name, value] : one.items()) {
            auto found = std::find_if(columns.begin(), columns.end(),
                                      [&](const Column& column) { return column.name == name; });
            if (found == columns.end())
                found = columns.insert(columns.end(), Column{name, true, false, 0, {}});
            if (value.is_number()) found->toTheLeft = false;
            if (value.is_number_float()) found->hasFractions = true;
        }
    std::stable_partition(columns.begin(), columns.end(),
                          [](const Column& column) { return column.toTheLeft; });
    return columns;
}

std::string cellText(const Column& column, const nlohmann::json& one) {
    const auto value = one.find(column.name);
    if (value == one.end() || value->is_null()) return "-";
    if (value->is_string()) return value->get<std::string>();
    if (value->is_boolean()) return value->get<bool>() ? "yes" : "no";
    if (!value->is_number() || !column.hasFractions) return value->dump();
    char text[64];
    std::snprintf(text, sizeof text, "%.2f", value->get<double>());
    return text;
}

std::string padded(const Column& column, const std::string& text) {
    const std::string space(column.width - std::min(column.width, text.size()), ' ');
    return column.toTheLeft ? text + space : space + text;
}

} // namespace

std::string casesTable(const nlohmann::json& cases) {
    if (cases.empty()) return {};
    auto columns = columnsOf(cases);
    for (auto& column : columns) {
        column.width = column.name.size();
        for (const auto& one : cases) {
            column.cells.push_back(cellText(column, one));
            column.width = std::max(column.width, column.cells.back().size());
        }
    }
    std::string table;
    const auto addLine = [&](const auto& textOf) {
        std::string line;
        for (const auto& column : columns)
            line += (line.empty() ? "" : "  ") + padded(column, textOf(column));
        table += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
    };
    addLine([](const Column& column) { return column.name; });
    for (std::size_t i = 0; i < cases.size(); ++i)
        addLine([&](const Column& column) { return column.cells[i]; });
    return table;
}

} // namespace voxsheet::cli
