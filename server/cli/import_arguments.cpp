#include "cli/import_arguments.h"

#include "base/errors.h"
#include "import/client/import_options_json.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <filesystem>
#include <fnmatch.h>

namespace voxsheet::cli {

namespace {

using nlohmann::json;

constexpr const char* kImport = "--import";

enum class Kind { Words, Numbers, Number, Axes, Truth };

struct Key {
    const char* name; ///< of import_options_json.h
    Kind kind;
    const char* flag; ///< its short form; nullptr: none
    const char* doc;
};

constexpr std::array<Key, 14> kKeys{{
    {"dims", Kind::Numbers, "--dims", "Samples along x, y, z of files without a header, e.g. 256x256x94"},
    {"type", Kind::Words, "--type", "Their numbers: u8 i8 u16 i16 u32 i32 u64 i64 f32 f64"},
    {"endian", Kind::Words, "--endian", "Their byte order: little or big (default: little)"},
    {"skip_bytes", Kind::Number, "--skip-bytes", "Bytes before their first voxel"},
    {"components", Kind::Number, "--components",
     "Their interleaved values at each voxel; each becomes a field"},
    {"spacing", Kind::Numbers, "--spacing", "Lengths of the voxel edges, e.g. 0.5,0.5,2, or one for all"},
    {"origin", Kind::Numbers, "--origin", "Position of the first sample in the world, e.g. 0,0,-100"},
    {"orientation", Kind::Words, "--orientation",
     "Sides of the patient to which the file's x, y and z lead, where it does not say so, e.g. LPS"},
    {"flip", Kind::Axes, "--flip", "Index axes to mirror, e.g. z or xy"},
    {"periodic", Kind::Axes, "--periodic",
     "Axes that repeat, e.g. xyz; none: not even where the file says so"},
    {"bit_mask", Kind::Words, "--bit-mask",
     "The bits of whole numbers that are values, the others being flags, e.g. 0x7fff"},
    {"no_data", Kind::Number, "--no-data", "The number that stands for no value, e.g. -9999"},
    {"resolution", Kind::Number, nullptr, ""},
    {"divide_by_cell_volume", Kind::Truth, nullptr, ""},
}};

const Key* keyNamed(const std::string& name) {
    const auto found =
        std::find_if(kKeys.begin(), kKeys.end(), [&](const Key& key) { return name == key.name; });
    return found == kKeys.end() ? nullptr : &*found;
}

std::string optionOf(const Key& key) { return key.flag ? key.flag : kImport; }

[[noreturn]] void refuse(const std::string& option, const std::string& value, const std::string& why,
                         const std::string& toDo = {}) {
    throw InvalidInput(option + " '" + value + "'", why, toDo).withField(option);
}

json numberOf(const Key& key, const std::string& word, const std::string& value) {
    std::int64_t whole = 0;
    const auto* const end = word.data() + word.size();
    if (const auto read = std::from_chars(word.data(), end, whole); read.ec == std::errc{} && read.ptr == end)
        return whole;
    double number = 0.0;
    const auto read = std::from_chars(word.data(), end, number);
    if (read.ec != std::errc{} || read.ptr != end) refuse(optionOf(key), value, "it is no number");
    return number;
}

/// "64,64,32" and "64x64x32"; one number stands for all three.
json numbersOf(const Key& key, const std::string& value) {
    json list = json::array();
    std::size_t begin = 0;
    while (true) {
        const auto end = std::min(value.find_first_of(",x", begin), value.size());
        list.push_back(numberOf(key, value.substr(begin, end - begin), value));
        if (end == value.size()) break;
        begin = end + 1;
    }
    if (list.size() == 1) return json::array({list[0], list[0], list[0]});
    if (list.size() != 3) refuse(optionOf(key), value, "it is not one number or three");
    return list;
}

json axesOf(const Key& key, const std::string& value) {
    json axes = json::array({false, false, false});
    if (value == "none") return axes;
    for (const char letter : value) {
        if (letter < 'x' || letter > 'z')
            refuse(optionOf(key), value, "it is no list of axes", "write x, yz, xyz or none");
        axes[static_cast<std::size_t>(letter - 'x')] = true;
    }
    return axes;
}

json truthOf(const Key& key, const std::string& value) {
    if (value != "true" && value != "false") refuse(optionOf(key), value, "it is neither true nor false");
    return value == "true";
}

json valueOf(const Key& key, const std::string& value) {
    if (value.empty()) refuse(optionOf(key), value, "it is empty");
    switch (key.kind) {
    case Kind::Numbers:
        return numbersOf(key, value);
    case Kind::Number:
        return numberOf(key, value, value);
    case Kind::Axes:
        return axesOf(key, value);
    case Kind::Truth:
        return truthOf(key, value);
    case Kind::Words:
        break;
    }
    return value;
}

struct Setting {
    std::string pattern; ///< empty: every file
    const Key* key = nullptr;
    json value;
};

Setting parseSetting(const std::string& text) {
    const auto equals = text.find('=');
    if (equals == std::string::npos)
        refuse(kImport, text, "it has no '='", "write KEY=VALUE or PATTERN:KEY=VALUE");
    const auto left = text.substr(0, equals);
    const auto colon = left.rfind(':');
    const auto name = colon == std::string::npos ? left : left.substr(colon + 1);
    Setting setting;
    if (colon != std::string::npos) setting.pattern = left.substr(0, colon);
    setting.key = keyNamed(name);
    if (!setting.key) {
        std::string known;
        for (const auto& key : kKeys)
            known += (known.empty() ? "" : ", ") + std::string(key.name);
        refuse(kImport, text, "there is no such key", "use one of " + known);
    }
    setting.value = valueOf(*setting.key, text.substr(equals + 1));
    try { // alone, so that the error names the option
        (void)import::importOptionsFromJson({{setting.key->name, setting.value}});
    } catch (const InvalidInput& error) {
        refuse(optionOf(*setting.key), text.substr(equals + 1), error.what());
    }
    return setting;
}

bool fits(const std::string& pattern, const std::string& file) {
    return pattern.empty() || ::fnmatch(pattern.c_str(), file.c_str(), 0) == 0 ||
           ::fnmatch(pattern.c_str(), std::filesystem::path(file).filename().c_str(), 0) == 0;
}

} // namespace

void addImportArguments(CLI::App& app, ImportArguments& arguments) {
    const char* const group = "How data files are read";
    for (const auto& key : kKeys) {
        if (!key.flag) continue;
        app.add_option_function<std::string>(
               key.flag,
               [&arguments, name = std::string(key.name)](const std::string& value) {
                   arguments.settings.push_back(name + "=" + value);
               },
               key.doc)
            ->group(group);
    }
    app.add_option_function<std::vector<std::string>>(
           kImport,
           [&arguments](const std::vector<std::string>& settings) {
               arguments.settings.insert(arguments.settings.end(), settings.begin(), settings.end());
           },
           "The same for some files only: PATTERN:KEY=VALUE, e.g. 'after*.raw:dims=64,64,64'; keys are those "
           "of the "
           "API (skip_bytes, no_data, …); repeatable")
        ->take_all()
        ->allow_extra_args(false)
        ->group(group);
}

json importOptionsFor(const ImportArguments& arguments, const std::string& file) {
    json options = json::object();
    for (const auto& text : arguments.settings)
        if (const auto setting = parseSetting(text); fits(setting.pattern, file))
            options[setting.key->name] = setting.value;
    return options;
}

void setImportOptions(sheet::Workbook& workbook, const ImportArguments& arguments) {
    for (const auto& text : arguments.settings) {
        const auto pattern = parseSetting(text).pattern;
        const bool used =
            std::any_of(workbook.datasets.begin(), workbook.datasets.end(),
                        [&](const auto& dataset) { return fits(pattern, dataset.second.files.front()); });
        if (!used) refuse(kImport, text, "no file has such a name");
    }
    for (auto& [name, source] : workbook.datasets)
        if (const auto options = importOptionsFor(arguments, source.files.front()); !options.empty())
            source.options = options.dump();
}

} // namespace voxsheet::cli
