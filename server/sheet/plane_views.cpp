#include "sheet/plane_views.h"

#include "base/errors.h"

#include <algorithm>
#include <set>

namespace voxsheet::sheet {

namespace {

const std::vector<std::string> kAxes{"axial", "coronal", "sagittal"};
constexpr int kViews = 3;

Address beside(const Address& cell, Axis direction, int step) {
    return direction == Axis::Columns ? Address{cell.column + step, cell.row}
                                      : Address{cell.column, cell.row + step};
}

bool isFree(const Sheet& sheet, const Address& cell) {
    const Cell* found = sheet.find(cell);
    return found == nullptr || found->source.empty();
}

/// Every view of every cell has a place of its own that nothing stands in.
bool areFree(const Sheet& sheet, const std::vector<Address>& cells, Axis direction) {
    std::set<Address> taken(cells.begin(), cells.end());
    for (const Address& cell : cells)
        for (int step = 1; step <= kViews; ++step) {
            const Address place = beside(cell, direction, step);
            if (!isFree(sheet, place) || !taken.insert(place).second) return false;
        }
    return true;
}

/// Applies each edit at once, so that the next one sees what it left.
class Edits {
public:
    Edits(const Workbook& workbook, const KeyTable& keys, const std::string& sheet)
        : workbook_(workbook), keys_(keys), name_(sheetNamed(workbook, sheet).name) {}

    [[nodiscard]] const Sheet& sheet() const { return sheetNamed(workbook_, name_); }
    [[nodiscard]] const std::string& name() const { return name_; }
    [[nodiscard]] ResolvedStyle style(const Address& cell) const {
        return resolveStyle(keys_, sheet(), cell);
    }
    void add(Command command) {
        workbook_ = apply(workbook_, command, keys_);
        commands_.push_back(std::move(command));
    }
    [[nodiscard]] std::vector<Command> take() { return std::move(commands_); }

private:
    Workbook workbook_;
    const KeyTable& keys_;
    std::string name_;
    std::vector<Command> commands_;
};

void growTo(Edits& edits, const Address& last) {
    const int columns = edits.sheet().columns;
    const int rows = edits.sheet().rows;
    if (last.column >= columns)
        edits.add(InsertLines{edits.name(), Axis::Columns, columns, last.column + 1 - columns});
    if (last.row >= rows) edits.add(InsertLines{edits.name(), Axis::Rows, rows, last.row + 1 - rows});
}

/// Rows for the views below every row that holds one of the cells. Returns where the cells are then.
std::vector<Address> makeRoomBelow(Edits& edits, std::vector<Address> cells) {
    std::set<int> rows;
    for (const Address& cell : cells)
        rows.insert(cell.row);
    int inserted = 0;
    for (const int row : rows) {
        const int now = row + inserted;
        edits.add(InsertLines{edits.name(), Axis::Rows, now + 1, kViews});
        for (Address& cell : cells)
            if (cell.row > now) cell.row += kViews;
        inserted += kViews;
    }
    return cells;
}

void addView(Edits& edits, const Address& from, const Address& to, const std::string& axis) {
    const Cell source = *edits.sheet().find(from);
    growTo(edits, to);
    edits.add(SetSource{edits.name(), to, source.source});
    edits.add(SetTitle{edits.name(), Layer::ofCell(to), cellTitle(source) + ", " + axis});
    StylePatch patch;
    for (const auto& [key, value] : source.style)
        patch[key] = value;
    for (const char* own : {"plane.normal", "plane.position", "plane.interpolation"})
        patch.erase(own);
    patch["technique"] = std::string("plane");
    patch["plane.axis"] = axis;
    edits.add(SetStyle{edits.name(), Layer::ofCell(to), std::move(patch)});
}

} // namespace

std::vector<Command> planesBeside(const Workbook& workbook, const KeyTable& keys, const std::string& sheet,
                                  const std::vector<Address>& cells) {
    if (cells.empty())
        throw InvalidInput("planes", "no cell is named", "name at least one that shows a volume")
            .withField("cells");
    Edits edits(workbook, keys, sheet);
    bool crosshair = false;
    for (const Address& cell : cells) {
        crosshair = crosshair || edits.style(cell).style.plane.crosshair.has_value();
        if (isFree(edits.sheet(), cell))
            throw InvalidInput("planes beside " + addressName(cell), "the cell shows nothing",
                               "choose one with a dataset or a formula")
                .withField("cells");
    }
    std::vector<Address> places = cells;
    Axis direction = Axis::Columns;
    if (!areFree(edits.sheet(), places, direction)) {
        direction = Axis::Rows;
        if (!areFree(edits.sheet(), places, direction)) places = makeRoomBelow(edits, std::move(places));
    }
    for (const Address& cell : places) {
        for (int step = 1; step <= kViews; ++step)
            addView(edits, cell, beside(cell, direction, step), kAxes[static_cast<std::size_t>(step - 1)]);
        if (edits.style(cell).style.technique == Technique::Plane)
            edits.add(SetStyle{edits.name(), Layer::ofCell(cell), {{"technique", std::string("raycast")}}});
    }
    if (!crosshair) edits.add(SetStyle{edits.name(), Layer::sheet(), {{"plane.crosshair", glm::dvec3(0.5)}}});
    return edits.take();
}

} // namespace voxsheet::sheet
