#include "import/vtk_xml/amr_header.h"

#include "base/errors.h"
#include "import/formats/number_text.h"
#include "import/formats/xml_walk.h"

#include <algorithm>
#include <array>

namespace voxsheet::import {

namespace {

constexpr std::size_t kMostPatches = 10'000;
constexpr std::int64_t kMostLevels = 64;

class AmrParser {
public:
    explicit AmrParser(const InputFile& file)
        : file_(file),
          walk_(file.name(),
                {[this](auto& element, auto& attributes) { start(element, attributes); }, {}, {}}) {}

    std::vector<AmrPatch> parse() {
        constexpr std::size_t chunk = 256 * 1024;
        bool last = false;
        for (std::uint64_t at = 0; !last; at += chunk) {
            const auto piece = file_.textAt(at, chunk);
            last = piece.size() < chunk;
            walk_.feed(piece, last);
        }
        if (patches_.empty()) damaged("it names no patches");
        std::stable_sort(patches_.begin(), patches_.end(),
                         [](auto& a, auto& b) { return a.level < b.level; });
        return std::move(patches_);
    }

private:
    [[noreturn]] void damaged(const std::string& why) const {
        throw InvalidInput(file_.name(), why, "the file is damaged or incomplete: copy or write it again");
    }

    void start(const std::string& element, const XmlWalk::Attributes& attributes) {
        if (element == "VTKFile") multiBlock_ = isMultiBlockType(valueOf(attributes, "type"));
        if (element == "Block" && !multiBlock_) level_ = levelOf(attributes, "level");
        if (element != "DataSet") return;
        // The older kind says the level with each patch.
        const auto level = multiBlock_                    ? 0
                           : attributes.contains("group") ? levelOf(attributes, "group")
                                                          : level_;
        auto file = valueOf(attributes, "file");
        if (file.empty()) return; // an empty place
        if (level < 0) damaged("a patch has no level");
        if (patches_.size() >= kMostPatches)
            throw LimitExceeded(file_.name(),
                                "it has more than " + std::to_string(kMostPatches) + " patches");
        patches_.push_back({level, std::move(file)});
    }

    [[nodiscard]] int levelOf(const XmlWalk::Attributes& attributes, const std::string& name) const {
        const auto level = parseInteger(valueOf(attributes, name));
        if (!level || *level < 0 || *level >= kMostLevels)
            damaged("the level '" + printable(valueOf(attributes, name)) + "' is none");
        return static_cast<int>(*level);
    }

    const InputFile& file_;
    XmlWalk walk_;
    int level_ = -1;
    bool multiBlock_ = false;
    std::vector<AmrPatch> patches_;
};

} // namespace

std::vector<AmrPatch> parseAmrHeader(const InputFile& file) { return AmrParser(file).parse(); }

bool isMultiBlockType(std::string_view type) { return type == "vtkMultiBlockDataSet"; }

bool isAmrType(std::string_view type) {
    constexpr std::array<std::string_view, 4> types{"vtkOverlappingAMR", "vtkNonOverlappingAMR",
                                                    "vtkHierarchicalBoxDataSet", "vtkUniformGridAMR"};
    return std::find(types.begin(), types.end(), type) != types.end();
}

} // namespace voxsheet::import
