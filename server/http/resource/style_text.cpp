#include "http/resource/style_text.h"

#include "base/errors.h"

#include <algorithm>

namespace voxsheet::http {

sheet::StyleMap styleFromQuery(const Query& query, const sheet::KeyTable& keys,
                               std::initializer_list<const char*> others) {
    sheet::StyleMap style;
    for (const auto& [key, value] : query.pairs()) {
        const auto isOther = [&name = key](const char* other) { return name == other; };
        if (std::any_of(others.begin(), others.end(), isOther)) continue;
        style[key] = sheet::parseStyleText(keys.at(key), value);
    }
    return style;
}

engine::View viewFromJson(const nlohmann::json& object, const sheet::KeyTable& keys) {
    engine::View view;
    if (const auto style = object.find("style"); style != object.end() && !style->is_null())
        view.all = sheet::parseStyleMap(keys, *style);
    const auto cells = object.find("cells");
    if (cells == object.end() || cells->is_null()) return view;
    if (!cells->is_object()) throw InvalidInput("member 'cells'", "it must be an object").withField("cells");
    for (const auto& item : cells->items())
        view.cells[sheet::parseAddress(item.key())] = sheet::parseStyleMap(keys, item.value());
    return view;
}

} // namespace voxsheet::http
